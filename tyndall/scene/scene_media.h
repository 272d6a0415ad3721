#pragma once
// What a scene's air is made of, as files state it: for scenes at other times.
#include <string>
#include <vector>

#include "tyndall/document/medium_file.h"

namespace tyndall {

/// A medium that a scene names or holds, in the profiles of the volume that it fills (none: everywhere).
struct PlacedMedium {
  MediumFile file;
  std::string name_for_messages;
  std::vector<Profile> profiles;
};
using SceneMedia = std::vector<PlacedMedium>;

/// All of them together at a time [s]. Throws Fault where one is no medium then (at_time()), or a file of a sequence
/// cannot be read; Grids::found: or is not there.
Medium medium_at(const SceneMedia& media, double time, Grids grids = Grids::read);

/// The times of all keyframes.
std::vector<double> key_times(const SceneMedia& media);

}  // namespace tyndall
