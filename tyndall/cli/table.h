#pragma once
// Tables for the terminal.
#include <array>
#include <string>
#include <vector>

#include "tyndall/color/spectrum.h"

namespace tyndall {

/// Rows of cells, printed with columns lined up; the first row is the heading. Cells are valid UTF-8.
class Table {
 public:
  void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }
  std::string text() const;

 private:
  std::vector<std::vector<std::string>> rows_;
};

/// Four significant digits; "-" where undefined, "unlimited" where infinite.
std::string value_text(double x);
/// A length [m] as "12.3 cm", "600 m" or "12.4 km".
std::string length_text(double metres);
/// One value where all channels agree, else all of them.
std::string channels_text(const std::array<double, channel_count>& values);

}  // namespace tyndall
