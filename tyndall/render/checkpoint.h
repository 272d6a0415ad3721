#pragma once
// Samples on disk: what a render has so far, for going on with it later.
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <tuple>

#include "tyndall/number/field.h"
#include "tyndall/number/instruction_set.h"
#include "tyndall/render/film.h"
#include "tyndall/render/render.h"

namespace tyndall {

/// What samples are of. Two films may be joined only where all of it is the same.
struct CheckpointSubject {
  static constexpr std::string_view text = "What the samples of a checkpoint are of.";
  std::string format = "tyndall-checkpoint/1";
  std::string scene;  // fingerprint() in hexadecimal
  std::string seed;   // decimal; a JSON number would not hold it
  std::string integrator;
  int max_depth = 0;
  int spp = 0;                  // of `single`, whose pixels depend on it; 0 for path, whose samples are one by one
  std::string instruction_set;  // pictures are the same to the last bit on one only
  int width = 0, height = 0;
  static constexpr auto fields() {
    return std::tuple{
        Field{"format", &CheckpointSubject::format, any_number, "", "The version of this file.", Scaling::none, true},
        Field{"scene", &CheckpointSubject::scene, any_number, "", "A digest of the scene.", Scaling::none, true},
        Field{"seed", &CheckpointSubject::seed, any_number, "", "The seed of all random numbers.", Scaling::none, true},
        Field{"integrator", &CheckpointSubject::integrator, any_number, "", "How the picture is computed.",
              Scaling::none, true},
        Field{"max_depth", &CheckpointSubject::max_depth, not_negative, "1", "The most events of a path; 0: no limit.",
              Scaling::none, true},
        Field{"spp", &CheckpointSubject::spp, not_negative, "1", "Samples of each pixel of single; 0 for path.",
              Scaling::none, true},
        Field{"instruction_set", &CheckpointSubject::instruction_set, any_number, "", "The processor's.", Scaling::none,
              true},
        Field{"width", &CheckpointSubject::width, Range{1.0, 16384.0}, "1", "Pixels.", Scaling::none, true},
        Field{"height", &CheckpointSubject::height, Range{1.0, 16384.0}, "1", "Pixels.", Scaling::none, true}};
  }
};

CheckpointSubject subject_of(const Scene& scene, const RenderSettings& settings,
                             InstructionSet set = best_instruction_set());

/// Writes the film atomically: a line of JSON (the subject), the pixels' sums (little-endian, exact), a digest of both.
/// Throws Fault, WriteFailure (whole_file.h).
void write_checkpoint(const std::filesystem::path& file, const CheckpointSubject& subject, const SampleFilm& film);

/// The film that was written. Throws Fault where the file is none, is damaged, or is of another subject: its message
/// says in which point, and the film asked for would be another picture's.
SampleFilm read_checkpoint(const std::filesystem::path& file, const CheckpointSubject& subject);

}  // namespace tyndall
