#include "tyndall/plot/legend.h"

#include <algorithm>
#include <sstream>

#include "tyndall/plot/style.h"
#include "tyndall/plot/text_width.h"

namespace tyndall {
namespace {

constexpr double sample_length = 24.0, gap = 5.0, column_gap = 14.0;
constexpr double line_height = 1.4 * style::label_size;

}  // namespace

double draw_legend(Group& group, const std::vector<LegendEntry>& entries, double x, double y, double width) {
  if (entries.empty()) return 0.0;
  double widest = 0.0;
  for (const LegendEntry& entry : entries) widest = std::max(widest, text_width(entry.label, style::label_size));
  // Two columns of shortened labels read better than one of long ones.
  const double room = (entries.size() > 2 ? (width - column_gap) / 2.0 : width) - sample_length - gap;
  const double label_width = std::min(widest, room);
  const double column = sample_length + gap + label_width + column_gap;
  const auto count = entries.size();
  const std::size_t columns =
      std::clamp<std::size_t>(static_cast<std::size_t>((width + column_gap) / column), 1, count);
  const std::size_t rows = (count + columns - 1) / columns;
  for (std::size_t i = 0; i < count; ++i) {
    const double left = x + static_cast<double>(i / rows) * column;
    const double base = y + static_cast<double>(i % rows) * line_height + style::label_size;
    const double middle = base - 0.36 * style::label_size;
    group.marks.emplace_back(Path{{{left, middle}, {left + sample_length, middle}}, entries[i].stroke, {}, false, {}});
    group.marks.emplace_back(Text{{left + sample_length + gap, base},
                                  shortened(entries[i].label, style::label_size, label_width + 0.01),
                                  style::label_size,
                                  Anchor::start,
                                  false,
                                  style::text_ink,
                                  false});
  }
  return static_cast<double>(rows) * line_height;
}

double draw_paragraph(Group& group, const std::string& text, double x, double y, double width) {
  constexpr double height = 1.35 * style::small_size;
  double used = 0.0;
  std::string line, word;
  const auto write = [&] {
    if (line.empty()) return;
    group.marks.emplace_back(Text{{x, y + used + style::small_size},
                                  shortened(line, style::small_size, width),
                                  style::small_size,
                                  Anchor::start,
                                  false,
                                  style::quiet_ink,
                                  false});
    used += height;
    line.clear();
  };
  for (std::istringstream words(text); words >> word;) {
    const std::string longer = line.empty() ? word : line + ' ' + word;
    if (text_width(longer, style::small_size) > width) write();
    line = line.empty() ? word : line + ' ' + word;
  }
  write();
  return used;
}

}  // namespace tyndall
