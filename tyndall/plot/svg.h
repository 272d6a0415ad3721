#pragma once
// A figure as SVG 1.1: real text, which can be searched, edited and read out, and no scripts, links or ids, so that any
// number of them can stand in one page.
#include <string>

#include "tyndall/plot/figure.h"

namespace tyndall {

/// The picture's size as SVG writes it: "510pt", "800" (pixels of 1/96 inch).
struct SvgSize {
  std::string width, height;
};

/// The same bytes for the same figure. Coordinates are rounded to a thousandth of a point.
std::string svg_text(const Figure& figure, const SvgSize& size);

}  // namespace tyndall
