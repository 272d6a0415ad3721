#pragma once
// The frame of a panel with two axes: grid, ticks, labels, titles.
#include <string>
#include <vector>

#include "tyndall/plot/axis.h"
#include "tyndall/plot/figure.h"

namespace tyndall {

/// A panel with its place on the page.
struct PanelFrame {
  Rectangle plot;  // what the axes enclose
  Axis x, y;
  std::vector<Tick> x_ticks, y_ticks;
};

/// What is written around it.
struct FrameText {
  std::string panel, x, y;
};

/// Room for the panel's title above its drawing.
inline constexpr double panel_title_height = 14.0;

/// Room for half of the last label of the horizontal axis.
inline constexpr double usual_right_margin = 10.0;

/// What the horizontal axis shows: degrees, metres with their unit, or numbers.
enum class TickStyle { angles, distances, numbers };

/// Lays axes of given limits into a cell of the page.
PanelFrame frame_in(const Rectangle& cell, Axis x, Axis y, TickStyle ticks, double right_margin = usual_right_margin);

/// Draws it. The SVG's group tells the axes, so that curves can be read back: "linear LOW HIGH BEGIN END".
Group drawn(const PanelFrame& frame, const Rectangle& cell, const FrameText& text);

/// An empty group for the panel's curves, clipped to the frame.
Group curve_group(const PanelFrame& frame);

/// The axis in words: "log 0.001 180 40 240".
std::string axis_words(const Axis& axis);

/// The panel's title in its place.
Text panel_title(const Rectangle& cell, const std::string& text);

}  // namespace tyndall
