#include "tyndall/cli/long_work.h"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdio>

#include "tyndall/cli/arguments.h"
#include "tyndall/document/spelling.h"
#include "tyndall/document/whole_file.h"

namespace tyndall {
namespace {

constexpr double first_preview = 2.0;  // [s]

/// 0.02 or 2%.
double noise_of(const std::string& text) {
  double x = 0.0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, x);
  const bool percent = rest + 1 == end && *rest == '%';
  if (percent) x /= 100.0;
  if (error != std::errc{} || (rest != end && !percent) || !(x > 0.0 && x <= 1.0))
    throw Fault("--until-noise", in_quotes(text), "a part of the picture's brightness above 0, such as 0.02 or 2%");
  return x;
}

}  // namespace

void add_long_work(CLI::App& command, LongWork& options) {
  command.add_option("--until-noise", options.until_noise,
                     "Stop when the noise that the progress shows is this: 0.02 or 2% (path only)");
  command.add_option("--seconds", options.seconds, "Stop after about so many seconds")->check(number_within(1e-3, 1e9));
  command.add_option("--checkpoint", options.checkpoint, "Save all samples to this file now and then, and at the end");
  command.add_option("--checkpoint-every", options.checkpoint_every, "Seconds between two (default 60)")
      ->check(number_within(0.01, 1e9));
  command.add_flag(
      "--resume", options.resume,
      "Go on with the checkpoint's samples if there is one; with a higher --spp, refine a finished picture");
  command.add_option("--preview", options.preview, "A .png to look at meanwhile, written anew now and then");
}

void apply(const LongWork& options, bool spp_given, RenderSettings& settings) {
  if (options.resume && options.checkpoint.empty())
    throw Fault("--resume", "no --checkpoint", "--checkpoint with the file to go on with");
  if (!options.preview.empty() && std::filesystem::path(options.preview).extension() != ".png")
    throw Fault("--preview", "the file name " + in_quotes(options.preview), "a name ending in .png");
  settings.seconds = options.seconds;
  if (!options.until_noise.empty()) {
    settings.until_noise = noise_of(options.until_noise);
    if (settings.integrator == "single")
      throw Fault("--until-noise", "the integrator single, which has no noise", "the integrator path");
  }
  // Another end than a number of samples: as many as it takes.
  if (!spp_given && settings.integrator != "single" && (settings.until_noise > 0.0 || settings.seconds > 0.0))
    settings.spp = 1 << 24;
}

FilmKeeper::FilmKeeper(const LongWork& options, const CheckpointSubject& subject,
                       std::function<void(const std::filesystem::path&, const SampleFilm&)> write_preview)
    : options_(options), subject_(subject), write_preview_(std::move(write_preview)) {
  const auto in = [](double seconds) {
    return Schedule{seconds,
                    Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds))};
  };
  if (!options.checkpoint.empty()) {
    if (!options.resume && std::filesystem::exists(options.checkpoint))
      throw Fault("--checkpoint", "the file " + in_quotes(options.checkpoint) + " already there",
                  "--resume to go on with its samples, or another name");
    check_writable(options.checkpoint);
    checkpoint_ = in(options.checkpoint_every);
  }
  if (!options.preview.empty()) {
    check_writable(options.preview);
    preview_ = in(first_preview);
  }
}

SampleFilm FilmKeeper::film() const {
  if (options_.resume && std::filesystem::exists(options_.checkpoint))
    return read_checkpoint(options_.checkpoint, subject_);
  return SampleFilm(subject_.width, subject_.height);
}

bool FilmKeeper::is_due() const {
  const auto now = Clock::now();
  return (checkpoint_ && now >= checkpoint_->next) || (preview_ && now >= preview_->next);
}

template <class Write>
void FilmKeeper::keep_up(Schedule& schedule, double least_interval, Write write) {
  const auto begun = Clock::now();
  if (begun < schedule.next) return;
  try {
    write();
  } catch (const std::exception& e) {
    std::fprintf(stderr, "warning: %s\n", e.what());
  }
  const auto now = Clock::now();
  // However slow the disk, writing takes at most a twentieth of the time.
  schedule.interval = std::max(least_interval, 20.0 * std::chrono::duration<double>(now - begun).count());
  schedule.next = now + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(schedule.interval));
}

void FilmKeeper::save(const SampleFilm& film) {
  if (checkpoint_)
    keep_up(*checkpoint_, options_.checkpoint_every, [&] { write_checkpoint(options_.checkpoint, subject_, film); });
  if (preview_)  // changes are worth looking at ever less often
    keep_up(*preview_, std::min(60.0, 1.5 * preview_->interval), [&] { write_preview_(options_.preview, film); });
}

void FilmKeeper::finish(const SampleFilm& film) {
  if (checkpoint_) write_checkpoint(options_.checkpoint, subject_, film);
  if (preview_) write_preview_(options_.preview, film);
}

}  // namespace tyndall
