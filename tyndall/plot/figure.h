#pragma once
// A drawing as a list of simple marks, made once and then written as SVG (svg.h) or painted as pixels (raster.h).
// Lengths are points (1/72 inch), x to the right, y down, the page's top left corner is the origin.
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace tyndall {

struct Point {
  double x = 0.0, y = 0.0;
};

struct Rectangle {
  double x = 0.0, y = 0.0, width = 0.0, height = 0.0;
  double right() const { return x + width; }
  double bottom() const { return y + height; }
};

/// sRGB codes, 0 to 255.
struct Ink {
  int red = 0, green = 0, blue = 0;
  bool operator==(const Ink&) const = default;
};

/// `dash` alternates drawn and empty lengths; empty is a solid line.
struct Stroke {
  Ink ink;
  double width = 1.0;
  std::vector<double> dash;
  bool operator==(const Stroke&) const = default;
};

struct Fill {
  Ink ink;
  double opacity = 1.0;
};

/// What a mark or group stands for, for whoever reads the SVG: written as class="..." and data-...="...". Names are
/// ours; values may be anyone's.
using Attributes = std::vector<std::pair<std::string, std::string>>;

/// Straight lines from point to point.
struct Path {
  std::vector<Point> points;
  std::optional<Stroke> stroke;
  std::optional<Fill> fill;  // by the even-odd rule
  bool closed = false;
  Attributes attributes;
};

struct Circle {
  Point center;
  double radius = 1.0;
  std::optional<Stroke> stroke;
  std::optional<Fill> fill;
};

enum class Anchor { start, middle, end };

/// One line of text, its baseline at `at`. The text may be anything; what cannot be shown is shown escaped.
struct Text {
  Point at;
  std::string text;
  double size = 8.0;
  Anchor anchor = Anchor::start;
  bool upwards = false;  // turned by 90 degrees against the clock
  Ink ink{};
  bool halo = false;  // on a rim of paper, where it stands upon lines
};

using Mark = std::variant<Path, Circle, Text>;

/// Marks that belong together, drawn in order; nothing of them shows outside `clip`.
struct Group {
  Attributes attributes;
  std::vector<Mark> marks;
  std::optional<Rectangle> clip;
};

struct Figure {
  double width = 0.0, height = 0.0;
  std::string title;  // for those who do not see the picture
  std::vector<Group> groups;
};

/// The box that a text takes, measured in DejaVu Sans.
Rectangle bounds(const Text& text);

}  // namespace tyndall
