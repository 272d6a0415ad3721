#pragma once
// What renders of hours need: ends other than a number of samples, checkpoints, a picture to look at meanwhile.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "tyndall/render/checkpoint.h"
#include "tyndall/render/render.h"

namespace tyndall {

/// --until-noise, --seconds, --checkpoint, --checkpoint-every, --resume, --preview.
struct LongWork {
  std::string until_noise;
  double seconds = 0.0, checkpoint_every = 60.0;
  std::string checkpoint, preview;
  bool resume = false;
};

void add_long_work(CLI::App& command, LongWork& options);

/// What of it is for the renderer; spp: whether the user asked for a number of samples. Throws Fault.
void apply(const LongWork& options, bool spp_given, RenderSettings& settings);

/// Keeps a film's checkpoint and preview up to date.
class FilmKeeper {
 public:
  /// develop_preview: what makes the preview of a film. Throws Fault where a file cannot be written, or where there is
  /// a checkpoint already and nobody asked to resume.
  FilmKeeper(const LongWork& options, const CheckpointSubject& subject,
             std::function<void(const std::filesystem::path&, const SampleFilm&)> write_preview);

  /// The film to go on with: that of the checkpoint, or an empty one. Throws Fault.
  SampleFilm film() const;

  /// For RenderHooks: when a file is due, and writing it. A write that fails while rendering is told on stderr and
  /// tried again; what was rendered is worth more.
  bool is_due() const;
  void save(const SampleFilm& film);
  /// Writes both as they are in the end. Throws Fault, WriteFailure.
  void finish(const SampleFilm& film);

 private:
  using Clock = std::chrono::steady_clock;
  struct Schedule {
    double interval;  // [s]
    Clock::time_point next;
  };
  template <class Write>
  void keep_up(Schedule& schedule, double least_interval, Write write);

  const LongWork& options_;
  CheckpointSubject subject_;
  std::function<void(const std::filesystem::path&, const SampleFilm&)> write_preview_;
  std::optional<Schedule> checkpoint_, preview_;
};

}  // namespace tyndall
