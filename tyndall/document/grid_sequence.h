#pragma once
// Sequences of grids: one name for many files, a file for each moment.
#include <string>

#include "tyndall/medium/profile.h"

namespace tyndall {

/// Whether a name stands for a sequence: #s in its last part.
bool is_sequence(const std::string& name);

/// The file's name for a number: the last #s become its digits, filled up with zeros, or more if it takes more.
std::string numbered_file(const std::string& name, int number);

/// Which file of a sequence shows a time [s]: the nearest. Throws Fault where that has no number.
int frame_of(const GridProfile& profile, double time);

/// What is wanted of the grids of a time: that they are read, or that their files are there.
enum class Grids { read, found };

/// Makes a sequence's profile that of a time, reading its file unless that was read last. Others stay as they are.
/// Throws Fault.
void set_time(GridProfile& profile, double time, Grids grids = Grids::read);

}  // namespace tyndall
