#pragma once
// The panels of a picture, each drawn into a cell of the page.
#include <span>
#include <string>
#include <vector>

#include "tyndall/plot/figure.h"
#include "tyndall/plot/lines.h"

namespace tyndall {

/// What panels draw: the subjects and their lines of one quantity.
struct PanelContent {
  std::span<const Subject> subjects;
  std::vector<Line> lines;
};

/// The phase function against angle, its axis logarithmic where `log_angle`; the density's axis always is.
void draw_phase_panel(Figure& figure, const Rectangle& cell, const std::string& title, const PanelContent& content,
                      bool log_angle);

/// The phase function around the place of scattering: light comes from the left, straight on is to the right.
void draw_polar_panel(Figure& figure, const Rectangle& cell, const std::string& title, const PanelContent& content,
                      bool log_radius);

/// Transmittance against distance, a mark where 5 % are left. Logarithmic where asked for or where the subjects' scales
/// are too far apart to share a linear axis.
void draw_transmittance_panel(Figure& figure, const Rectangle& cell, const std::string& title,
                              const PanelContent& content, bool log_distance);

/// A line of text in the middle of an empty cell.
void draw_empty_panel(Figure& figure, const Rectangle& cell, const std::string& title, const std::string& why);

/// Smallest and largest density > 0 that is worth drawing; {0, 0} where there is none.
struct DensityRange {
  double low, high;
};
DensityRange density_range(const PanelContent& content);

}  // namespace tyndall
