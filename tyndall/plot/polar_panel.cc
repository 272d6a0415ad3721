#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "tyndall/plot/curve.h"
#include "tyndall/plot/frame.h"
#include "tyndall/plot/panels.h"
#include "tyndall/plot/style.h"

namespace tyndall {
namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr double ring_label_angle = 105.0 * degree;  // up and a little back, where most laws have least

/// The largest value at the circle, and how far apart the rings are.
Axis linear_radius(double largest_density, double radius) {
  const double decade = std::pow(10.0, std::floor(std::log10(largest_density)));
  for (const double m : {0.25, 0.5, 1.0, 2.0, 2.5}) {
    const double rings = std::ceil(largest_density / (m * decade) - 1e-9);
    if (rings <= 4.0) return {false, 0.0, rings * m * decade, 0.0, radius};
  }
  return {false, 0.0, 10.0 * decade, 0.0, radius};
}

/// Rings at powers of ten (between them where there are hardly two), clear of each other, and the circle itself.
std::vector<Tick> logarithmic_rings(const Axis& axis) {
  constexpr double spacing = 1.6 * style::small_size;
  const double decades = std::log10(axis.high / axis.low);
  const bool plain = axis.low >= 0.999e-4 && axis.high <= 1.001e4;
  const int stride = std::max(1, static_cast<int>(std::ceil(decades * spacing / axis.end)));
  std::vector<Tick> rings{{axis.high, tick_text(axis.high)}};
  double last = axis.end;
  for (int k = static_cast<int>(std::floor(std::log10(axis.high) + 1e-9)); k > std::log10(axis.low) - 1.0; --k) {
    for (const int m : {5, 2, 1}) {
      const double value = m * std::pow(10.0, k), radius = axis.at(value);
      const bool wanted = m == 1 ? k % stride == 0 : decades < 1.8;
      if (!wanted || radius > last - spacing || radius < 0.8 * style::small_size) continue;
      rings.push_back({value, m == 1 ? decade_text(k, plain) : tick_text(value)});
      last = radius;
    }
  }
  return rings;
}

std::vector<Tick> rings_of(const Axis& axis) {
  if (axis.logarithmic) return logarithmic_rings(axis);
  std::vector<Tick> rings;
  const double decade = std::pow(10.0, std::floor(std::log10(axis.high) + 1e-9));
  for (const double m : {0.25, 0.5, 1.0, 2.0, 2.5}) {
    const double count = axis.high / (m * decade);
    if (count > 4.0 + 1e-9 || std::fabs(count - std::round(count)) > 1e-9) continue;
    for (int i = 1; i <= static_cast<int>(std::lround(count)); ++i) {
      rings.push_back({i * m * decade, tick_text(i * m * decade)});
    }
    break;
  }
  return rings;
}

Text small(Point at, std::string text, Anchor anchor, Ink ink, bool halo) {
  return {at, std::move(text), style::small_size, anchor, false, ink, halo};
}

/// Rings, spokes and the angles around them.
Group scaffold(const Point& center, double radius, const std::vector<Tick>& rings, const Axis& axis) {
  using namespace style;
  Group out{{{"class", "frame"}, {"radius-axis", axis_words(axis)}}, {}, {}};
  for (const Tick& ring : rings) {
    out.marks.emplace_back(Circle{center, axis.at(ring.value), Stroke{grid_ink, grid_width, {}}, {}});
  }
  for (int angle = 0; angle < 360; angle += 30) {
    const double c = std::cos(angle * degree), s = std::sin(angle * degree);
    const Point rim{center.x + radius * c, center.y - radius * s};
    out.marks.emplace_back(Path{{center, rim}, Stroke{grid_ink, grid_width, {}}, {}, false, {}});
    const Anchor anchor = c > 0.1 ? Anchor::start : c < -0.1 ? Anchor::end : Anchor::middle;
    const Point at{center.x + (radius + 4.0) * c,
                   center.y - (radius + 4.0) * s + small_size * (0.36 - 0.36 * s + (s < -0.9 ? 0.1 : 0.0))};
    out.marks.emplace_back(small(at, std::to_string(std::min(angle, 360 - angle)) + "\u00b0", anchor, text_ink, false));
  }
  out.marks.emplace_back(Circle{center, radius, Stroke{frame_ink, frame_width, {}}, {}});
  return out;
}

/// Which way the light goes: an arrow in the corner that the circle leaves free.
void add_arrow(Group& out, const Rectangle& cell) {
  const double y = cell.bottom() - 4.0, end = cell.x + 24.0;
  out.marks.emplace_back(Path{{{cell.x, y}, {end - 3.0, y}}, Stroke{style::quiet_ink, 0.8, {}}, {}, false, {}});
  out.marks.emplace_back(
      Path{{{end - 5.0, y - 2.2}, {end, y}, {end - 5.0, y + 2.2}}, {}, Fill{style::quiet_ink, 1.0}, true, {}});
  out.marks.emplace_back(small({cell.x, y - 5.0}, "light", Anchor::start, style::quiet_ink, false));
}

}  // namespace

void draw_polar_panel(Figure& figure, const Rectangle& cell, const std::string& title, const PanelContent& content,
                      bool log_radius) {
  const double label_width = 24.0, label_height = style::small_size + 4.0;
  const double radius =
      std::min(cell.width / 2.0 - label_width, (cell.height - panel_title_height) / 2.0 - label_height);
  const Point center{cell.x + cell.width / 2.0, cell.y + panel_title_height + (cell.height - panel_title_height) / 2.0};
  const DensityRange range = density_range(content);
  const Limits limits{decade_limits(range.low / 1.5, range.high).low, round_limits(range.low, 1.05 * range.high).high};
  const Axis axis =
      log_radius ? Axis{true, limits.low, limits.high, 0.0, radius} : linear_radius(1.02 * range.high, radius);
  const std::vector<Tick> rings = rings_of(axis);
  Group frame = scaffold(center, radius, rings, axis);
  frame.attributes.push_back({"center", axis_words({false, 0.0, 0.0, center.x, center.y})});
  frame.marks.emplace_back(panel_title(cell, title));
  add_arrow(frame, cell);
  figure.groups.push_back(std::move(frame));

  const double rim = radius + style::line_width / 2.0;
  Group curves{{{"class", "curves"}}, {}, Rectangle{center.x - rim, center.y - rim, 2.0 * rim, 2.0 * rim}};
  const std::vector<double> angles = angles_from(0.0);
  for (const Line& line : content.lines) {
    Path path{curve(angles,
                    [&](double angle) {
                      const double r = std::max(0.0, axis.at(density_of(line, angle)));
                      return Point{center.x + r * std::cos(angle), center.y - r * std::sin(angle)};
                    }),
              line.stroke,
              {},
              true,
              attributes_of(line)};
    for (std::size_t i = path.points.size() - 1; i-- > 1;) {  // the other half; both ends lie on the axis
      path.points.push_back({path.points[i].x, 2.0 * center.y - path.points[i].y});
    }
    curves.marks.emplace_back(std::move(path));
  }
  figure.groups.push_back(std::move(curves));

  Group labels{{{"class", "rings"}}, {}, {}};
  for (const Tick& ring : rings) {
    const double r = axis.at(ring.value);
    labels.marks.emplace_back(small({center.x + r * std::cos(ring_label_angle),
                                     center.y - r * std::sin(ring_label_angle) + 0.36 * style::small_size},
                                    ring.label, Anchor::middle, style::quiet_ink, true));
  }
  figure.groups.push_back(std::move(labels));
}

}  // namespace tyndall
