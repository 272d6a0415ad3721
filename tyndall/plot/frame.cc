#include "tyndall/plot/frame.h"

#include <algorithm>
#include <charconv>

#include "tyndall/plot/style.h"
#include "tyndall/plot/text_width.h"

namespace tyndall {
namespace {

constexpr double tick_length = 3.2, minor_length = 1.8, gap = 3.0;
constexpr double drop = 5.0;  // of labels below the axis: clear of the lowest one beside the other axis
constexpr double below = drop + style::small_size + gap + style::label_size + 2.0;

std::string round_trip(double x) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, x).ptr};
}

Path line(Point a, Point b, Ink ink, double width) { return {{a, b}, Stroke{ink, width, {}}, {}, false, {}}; }

}  // namespace

std::string axis_words(const Axis& axis) {
  std::string words = axis.logarithmic ? "log" : "linear";
  for (const double x : {axis.low, axis.high, axis.begin, axis.end}) words += ' ' + round_trip(x);
  return words;
}

Text panel_title(const Rectangle& cell, const std::string& text) {
  return {{cell.x, cell.y + style::label_size}, text, style::label_size, Anchor::start, false, style::text_ink, false};
}

PanelFrame frame_in(const Rectangle& cell, Axis x, Axis y, TickStyle ticks, double right_margin) {
  PanelFrame frame;
  const double top = cell.y + panel_title_height, bottom = cell.bottom() - below;
  y.begin = bottom;
  y.end = top;
  frame.y_ticks = ticks_of(y, (y.logarithmic ? 1.8 : 2.8) * style::small_size);
  double widest = 0.0;
  for (const Tick& tick : frame.y_ticks) widest = std::max(widest, text_width(tick.label, style::small_size));
  x.begin = cell.x + style::label_size + gap + widest + gap;
  x.end = cell.right() - right_margin;
  const double spacing = 4.6 * style::small_size;
  frame.x_ticks = ticks == TickStyle::angles      ? angle_ticks_of(x, spacing)
                  : ticks == TickStyle::distances ? distance_ticks_of(x, spacing)
                                                  : ticks_of(x, spacing);
  frame.plot = {x.begin, top, x.end - x.begin, bottom - top};
  frame.x = x;
  frame.y = y;
  return frame;
}

Group drawn(const PanelFrame& frame, const Rectangle& cell, const FrameText& text) {
  using namespace style;
  const Rectangle& plot = frame.plot;
  Group out{{{"class", "frame"}, {"x-axis", axis_words(frame.x)}, {"y-axis", axis_words(frame.y)}}, {}, {}};
  const auto add = [&](Mark mark) { out.marks.emplace_back(std::move(mark)); };
  for (const Tick& tick : frame.x_ticks) {
    const double x = frame.x.at(tick.value);
    if (!tick.label.empty()) add(line({x, plot.y}, {x, plot.bottom()}, grid_ink, grid_width));
  }
  for (const Tick& tick : frame.y_ticks) {
    const double y = frame.y.at(tick.value);
    if (!tick.label.empty()) add(line({plot.x, y}, {plot.right(), y}, grid_ink, grid_width));
  }
  for (const Tick& tick : frame.x_ticks) {
    const double x = frame.x.at(tick.value), length = tick.label.empty() ? minor_length : tick_length;
    add(line({x, plot.bottom()}, {x, plot.bottom() - length}, frame_ink, frame_width));
    if (tick.label.empty()) continue;
    add(Text{
        {x, plot.bottom() + drop + 0.76 * small_size}, tick.label, small_size, Anchor::middle, false, text_ink, false});
  }
  for (const Tick& tick : frame.y_ticks) {
    const double y = frame.y.at(tick.value), length = tick.label.empty() ? minor_length : tick_length;
    add(line({plot.x, y}, {plot.x + length, y}, frame_ink, frame_width));
    if (tick.label.empty()) continue;
    add(Text{{plot.x - gap, y + 0.36 * small_size}, tick.label, small_size, Anchor::end, false, text_ink, false});
  }
  add(Path{{{plot.x, plot.y}, {plot.right(), plot.y}, {plot.right(), plot.bottom()}, {plot.x, plot.bottom()}},
           Stroke{frame_ink, frame_width, {}},
           {},
           true,
           {}});
  add(panel_title(cell, text.panel));
  add(Text{{plot.x + plot.width / 2.0, cell.bottom() - 0.24 * label_size},
           text.x,
           label_size,
           Anchor::middle,
           false,
           text_ink,
           false});
  add(Text{{cell.x + 0.8 * label_size, plot.y + plot.height / 2.0},
           text.y,
           label_size,
           Anchor::middle,
           true,
           text_ink,
           false});
  return out;
}

Group curve_group(const PanelFrame& frame) {
  // Half a line's width more, so that a curve along the frame keeps its width.
  const Rectangle& p = frame.plot;
  const double rim = style::line_width / 2.0;
  return {{{"class", "curves"}}, {}, Rectangle{p.x - rim, p.y - rim, p.width + 2 * rim, p.height + 2 * rim}};
}

}  // namespace tyndall
