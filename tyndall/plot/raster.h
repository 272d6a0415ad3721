#pragma once
// A figure as pixels. Needs cairo, which paints, and a font, which the program carries inside: the same bytes on every
// machine, whatever fonts it has.
#include <cstdint>
#include <vector>

#include "tyndall/plot/figure.h"

namespace tyndall {

/// The largest picture that is painted [pixels].
inline constexpr int most_pixels = 64 << 20;

/// A PNG file of width x height pixels (>= 1; at most most_pixels), onto which the page is stretched. Text is set in
/// DejaVu Sans, letter by letter: scripts that join letters or run from the right are better served by SVG. Throws
/// std::runtime_error when cairo cannot.
std::vector<std::uint8_t> png_bytes(const Figure& figure, int width, int height);

}  // namespace tyndall
