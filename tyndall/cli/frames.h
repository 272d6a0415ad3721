#pragma once
// Which pictures of an animation are made, and what their files are called.
#include <optional>
#include <string>
#include <vector>

namespace tyndall {

/// The pictures of an animation: from the first to the last, both included.
struct Frames {
  int first = 0, last = 0;
  int count() const { return last - first + 1; }
};

/// FIRST-LAST. Throws Fault.
Frames frames_from(const std::string& text);

/// A file of one picture: fog.exr as fog.0012.exr.
std::string numbered(const std::string& output, int frame);

/// The files of one picture; of what is no animation, the outputs themselves.
std::vector<std::string> outputs_of(const std::vector<std::string>& outputs, const std::optional<int>& frame);

}  // namespace tyndall
