#include "tyndall/cli/frames.h"

#include <charconv>
#include <cstdio>
#include <filesystem>

#include "tyndall/document/fault.h"
#include "tyndall/document/spelling.h"

namespace tyndall {

Frames frames_from(const std::string& text) {
  constexpr int most = 99999;
  Frames frames;
  const char* const end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, frames.first);
  if (first.ec == std::errc{} && first.ptr != end && *first.ptr == '-') {
    const auto last = std::from_chars(first.ptr + 1, end, frames.last);
    if (last.ec == std::errc{} && last.ptr == end && frames.first >= 0 && frames.first <= frames.last &&
        frames.last <= most) {
      return frames;
    }
  }
  throw Fault(
      "--frames", in_quotes(text),
      "FIRST-LAST, such as 0-47: whole numbers up to " + std::to_string(most) + ", the last not before the first");
}

std::string numbered(const std::string& output, int frame) {
  char digits[16];
  std::snprintf(digits, sizeof digits, ".%04d", frame);
  const std::filesystem::path path(output);
  return (path.parent_path() / (path.stem().string() + digits + path.extension().string())).string();
}

std::vector<std::string> outputs_of(const std::vector<std::string>& outputs, const std::optional<int>& frame) {
  std::vector<std::string> names;
  for (const std::string& output : outputs) names.push_back(frame ? numbered(output, *frame) : output);
  return names;
}

}  // namespace tyndall
