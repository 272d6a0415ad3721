#include "tyndall/document/grid_sequence.h"

#include <cmath>

#include "tyndall/document/fault.h"
#include "tyndall/document/grid_reader.h"
#include "tyndall/document/reference.h"
#include "tyndall/document/spelling.h"

namespace tyndall {

bool is_sequence(const std::string& name) {
  const std::size_t last = name.rfind('#'), slash = name.rfind('/');
  return last != std::string::npos && (slash == std::string::npos || last > slash);
}

std::string numbered_file(const std::string& name, int number) {
  const std::size_t end = name.rfind('#') + 1;
  std::size_t begin = end;
  while (begin > 0 && name[begin - 1] == '#') --begin;
  std::string digits = std::to_string(number);
  if (digits.size() < end - begin) digits.insert(0, end - begin - digits.size(), '0');
  return name.substr(0, begin) + digits + name.substr(end);
}

int frame_of(const GridProfile& profile, double time) {
  const double frame = profile.first_frame + std::floor(time * profile.fps + 0.5);
  if (!(frame >= 0.0 && frame <= 1e9)) {
    throw Fault(place(profile.file.naming),
                "no picture of " + in_quotes(profile.file.name, 100) + " at " + std::to_string(time) + " s",
                "a time from which its numbers are 0 to 1000000000");
  }
  return static_cast<int>(frame);
}

void set_time(GridProfile& profile, double time, Grids grids) {
  GridFile& file = profile.file;
  if (!is_sequence(file.name) || file.naming.empty()) return;
  const int number = frame_of(profile, time);
  if (number == file.number && file.grid) return;
  const auto path = referenced_file(file.naming, numbered_file(file.name, number), file.anywhere, place(file.naming));
  if (grids == Grids::found) return;
  const GridFile now = read_grid(path, profile.grid_name);
  file.grid = now.grid;
  file.content = now.content;
  file.number = number;
}

}  // namespace tyndall
