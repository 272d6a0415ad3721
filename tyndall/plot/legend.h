#pragma once
// Which line is what.
#include <string>
#include <vector>

#include "tyndall/plot/figure.h"

namespace tyndall {

struct LegendEntry {
  std::string label;
  Stroke stroke;
  bool operator==(const LegendEntry&) const = default;
};

/// Draws the entries in as many columns as their labels allow, from (x, y) down within `width`, and returns the height
/// that they take [points]. A label too long for the width is shortened.
double draw_legend(Group& group, const std::vector<LegendEntry>& entries, double x, double y, double width);

/// Draws text in lines broken at spaces, and returns the height that they take [points].
double draw_paragraph(Group& group, const std::string& text, double x, double y, double width);

}  // namespace tyndall
