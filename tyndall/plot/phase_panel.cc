#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "tyndall/plot/curve.h"
#include "tyndall/plot/frame.h"
#include "tyndall/plot/panels.h"
#include "tyndall/plot/style.h"

namespace tyndall {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

/// Where the logarithmic axis of angles begins [degrees]: well inside the narrowest peak.
double least_angle(const PanelContent& content) {
  double least = 10.0;
  for (const Line& line : content.lines) {
    const double peak = density_of(line, 0.0);
    for (const double angle : angles_from(0.0)) {
      if (density_of(line, angle) < 0.5 * peak) {
        least = std::min(least, 0.1 * angle / degree);
        break;
      }
    }
  }
  return std::pow(10.0, std::floor(std::log10(std::clamp(least, 1e-13, 1.0))));
}

/// Round, with a little room, and at least a decade.
Limits limits_for(const DensityRange& range) {
  const double room = std::max(1.1, std::sqrt(10.0 * range.low / range.high));
  return round_limits(range.low / room, range.high * room);
}

/// Where the channels of one of several subjects differ, the space between the outermost two is tinted.
void add_bands(Group& out, const PanelFrame& frame, const PanelContent& content, const std::vector<double>& angles) {
  if (content.subjects.size() < 2) return;
  for (const Line& line : content.lines) {
    if (line.part != nullptr || !is_coloured(*line.subject, Quantity::phase)) continue;
    Path band{{}, {}, Fill{line.stroke.ink, 0.2}, true, {{"class", "band"}, {"of", line.subject->name}}};
    for (const bool upper : {true, false}) {
      const auto edge = curve(angles, [&](double angle) {
        const DensitySpan span = density_span(*line.subject, angle);
        return Point{frame.x.at(angle / degree), frame.y.at(upper ? span.high : span.low)};
      });
      if (upper) {
        band.points = edge;
      } else {
        band.points.insert(band.points.end(), edge.rbegin(), edge.rend());
      }
    }
    out.marks.emplace_back(std::move(band));
  }
}

}  // namespace

DensityRange density_range(const PanelContent& content) {
  double low = std::numeric_limits<double>::infinity(), low_of_parts = low, high = 0.0;
  std::vector<double> usual;
  const std::vector<double> angles = angles_from(0.0);
  for (const Line& line : content.lines) {
    // A law that is 0 somewhere would claim any number of decades: below its median, few are worth drawing.
    usual.clear();
    for (int i = 0; i <= 180; ++i) usual.push_back(density_of(line, i * degree));
    std::nth_element(usual.begin(), usual.begin() + 90, usual.end());
    const double least = usual[90] / 1000.0;
    for (const double angle : angles) {
      const double p = std::max(density_of(line, angle), least);
      if (!(p > 0.0)) continue;
      double& lowest = line.part != nullptr ? low_of_parts : low;
      lowest = std::min(lowest, p);
      high = std::max(high, p);
      if (line.part == nullptr && content.subjects.size() > 1) {  // room for its band
        const DensitySpan span = density_span(*line.subject, angle);
        low = std::min(low, std::max(span.low, least));
        high = std::max(high, span.high);
      }
    }
  }
  if (!(high > 0.0)) return {0.0, 0.0};
  // A part may be next to nothing: the subject is what the panel is about.
  low = std::min(low, std::max(low_of_parts, low / 100.0));
  return {low, high};
}

void draw_phase_panel(Figure& figure, const Rectangle& cell, const std::string& title, const PanelContent& content,
                      bool log_angle) {
  const DensityRange range = density_range(content);
  const Limits limits = limits_for(range);
  const Axis x{log_angle, log_angle ? least_angle(content) : 0.0, 180.0, 0.0, 1.0};
  const PanelFrame frame = frame_in(cell, x, Axis{true, limits.low, limits.high, 0.0, 1.0}, TickStyle::angles);
  figure.groups.push_back(drawn(frame, cell, {title, "scattering angle [\u00b0]", "phase function [sr\u207b\u00b9]"}));
  Group curves = curve_group(frame);
  const std::vector<double> angles = angles_from(x.low * degree);
  add_bands(curves, frame, content, angles);
  for (const Line& line : content.lines) {
    curves.marks.emplace_back(
        Path{curve(angles,
                   [&](double angle) {
                     return Point{frame.x.at(angle / degree), frame.y.at(density_of(line, angle))};
                   }),
             line.stroke,
             {},
             false,
             attributes_of(line)});
  }
  figure.groups.push_back(std::move(curves));
}

void draw_empty_panel(Figure& figure, const Rectangle& cell, const std::string& title, const std::string& why) {
  Group out{{{"class", "frame"}}, {}, {}};
  out.marks.emplace_back(panel_title(cell, title));
  out.marks.emplace_back(Text{{cell.x + cell.width / 2.0, cell.y + cell.height / 2.0},
                              why,
                              style::label_size,
                              Anchor::middle,
                              false,
                              style::quiet_ink,
                              false});
  figure.groups.push_back(std::move(out));
}

}  // namespace tyndall
