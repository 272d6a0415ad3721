#include "tyndall/cli/table.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace tyndall {
namespace {

/// Columns that a text takes on a terminal, taking every code point as one.
std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

}  // namespace

std::string Table::text() const {
  std::vector<std::size_t> widths;
  for (const auto& row : rows_) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], width_of(row[i]));
  }
  std::string out;
  for (const auto& row : rows_) {
    std::string line = " ";
    for (std::size_t i = 0; i < row.size(); ++i) {
      line += ' ' + row[i];
      line += std::string(widths[i] - width_of(row[i]) + 2, ' ');
    }
    line.erase(line.find_last_not_of(' ') + 1);
    out += line + '\n';
  }
  return out;
}

std::string value_text(double x) {
  if (std::isnan(x)) return "-";
  if (std::isinf(x)) return "unlimited";
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", x);
  return text;
}

std::string length_text(double metres) {
  if (!std::isfinite(metres)) return value_text(metres);
  const double size = std::fabs(metres);
  if (size >= 1000.0) return value_text(metres / 1000.0) + " km";
  if (size > 0.0 && size < 1.0) return value_text(metres * 100.0) + " cm";
  return value_text(metres) + " m";
}

std::string channels_text(const std::array<double, channel_count>& values) {
  const bool grey = std::all_of(values.begin(), values.end(), [&](double x) { return x == values[0]; });
  if (grey) return value_text(values[0]);
  std::string text;
  for (const double x : values) text += (text.empty() ? "" : " ") + value_text(x);
  return text;
}

}  // namespace tyndall
