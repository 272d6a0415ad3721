#include <algorithm>
#include <cmath>
#include <limits>

#include "tyndall/plot/curve.h"
#include "tyndall/plot/frame.h"
#include "tyndall/plot/panels.h"
#include "tyndall/plot/style.h"

namespace tyndall {
namespace {

constexpr double shared_linear = 15.0;  // visibilities further apart than this do not share a linear axis
constexpr double contrast = 0.05;
constexpr double shortest_drawn = 1e-9, longest_drawn = 1e15;  // [m], a nanometre and a tenth of a light year

struct VisibilityRange {
  double shortest = std::numeric_limits<double>::infinity(), longest = 0.0;
};

/// Visibilities [m] of all channels that lose anything.
VisibilityRange visibilities(const PanelContent& content) {
  VisibilityRange range;
  for (const Subject& subject : content.subjects) {
    if (!subject.is_medium) continue;
    for (const double extinction : subject.extinction.value) {
      const double visibility = visibility_of(extinction, contrast);
      if (!std::isfinite(visibility)) continue;
      range.shortest = std::min(range.shortest, visibility);
      range.longest = std::max(range.longest, visibility);
    }
  }
  return range;
}

Axis distances(const PanelContent& content, bool logarithmic, LengthUnit& unit) {
  VisibilityRange range = visibilities(content);
  if (range.longest == 0.0) range = {1000.0, 1000.0};  // a vacuum: any distance will do
  range.shortest = std::clamp(range.shortest, shortest_drawn, longest_drawn);
  range.longest = std::clamp(range.longest, shortest_drawn, longest_drawn);
  logarithmic = logarithmic || range.longest > shared_linear * range.shortest;
  if (logarithmic) {  // in metres: each tick says its unit
    unit = {"", 1.0};
    const Limits limits = round_limits(range.shortest / 100.0, 1.5 * range.longest);
    return {true, limits.low, limits.high, 0.0, 1.0};
  }
  unit = length_unit_for(range.longest);
  const double high = 1.2 * range.longest / unit.metres, step = std::pow(10.0, std::floor(std::log10(high))) / 5.0;
  return {false, 0.0, step * std::ceil(high / step), 0.0, 1.0};
}

std::vector<double> sampled(const Axis& axis) {
  std::vector<double> out;
  for (int i = 0; i <= 64; ++i) {
    const double share = i / 64.0;
    out.push_back(axis.logarithmic ? axis.low * std::pow(axis.high / axis.low, share)
                                   : axis.low + share * (axis.high - axis.low));
  }
  return out;
}

}  // namespace

void draw_transmittance_panel(Figure& figure, const Rectangle& cell, const std::string& title,
                              const PanelContent& content, bool log_distance) {
  LengthUnit unit;
  const Axis x = distances(content, log_distance, unit);
  const PanelFrame frame = frame_in(cell, x, Axis{false, 0.0, 100.0, 0.0, 1.0},
                                    x.logarithmic ? TickStyle::distances : TickStyle::numbers, 20.0);
  Group group =
      drawn(frame, cell, {title, unit.name.empty() ? "distance" : "distance [" + unit.name + "]", "transmittance [%]"});
  const double level = frame.y.at(100.0 * contrast);
  group.marks.emplace_back(Path{{{frame.plot.x, level}, {frame.plot.right(), level}},
                                Stroke{style::guide_ink, style::grid_width, {3.0, 2.0}},
                                {},
                                false,
                                {}});
  group.marks.emplace_back(Text{{frame.plot.right() + 3.0, level + 0.36 * style::small_size},
                                "5 %",
                                style::small_size,
                                Anchor::start,
                                false,
                                style::quiet_ink,
                                false});
  figure.groups.push_back(std::move(group));

  Group curves = curve_group(frame);
  const std::vector<double> places = sampled(x);
  const auto path = [&](double extinction) {
    return curve(places, [&](double distance) {
      return Point{frame.x.at(distance), frame.y.at(100.0 * std::exp(-extinction * distance * unit.metres))};
    });
  };
  if (content.subjects.size() > 1) {
    for (const Line& line : content.lines) {
      if (line.part != nullptr || !is_coloured(*line.subject, Quantity::transmittance)) continue;
      Path band{path(smallest(line.subject->extinction)),
                {},
                Fill{line.stroke.ink, 0.2},
                true,
                {{"class", "band"}, {"of", line.subject->name}}};
      const std::vector<Point> lower = path(largest(line.subject->extinction));
      band.points.insert(band.points.end(), lower.rbegin(), lower.rend());
      curves.marks.emplace_back(std::move(band));
    }
  }
  for (const Line& line : content.lines) {
    curves.marks.emplace_back(Path{path(extinction_of(line)), line.stroke, {}, false, attributes_of(line)});
  }
  for (const Line& line : content.lines) {
    const double visibility = visibility_of(extinction_of(line), contrast) / unit.metres;
    if (line.part != nullptr || !(visibility <= x.high)) continue;
    curves.marks.emplace_back(
        Circle{{frame.x.at(visibility), level}, 1.8, Stroke{{255, 255, 255}, 0.5, {}}, Fill{line.stroke.ink, 1.0}});
  }
  figure.groups.push_back(std::move(curves));
}

}  // namespace tyndall
