#pragma once
// How figures look: sizes for print, colours that the colour-blind can tell apart, and dashes besides.
#include <array>
#include <cstddef>
#include <vector>

#include "tyndall/plot/figure.h"

namespace tyndall::style {

// Points. Nothing is smaller than 7, which journals ask for at least.
inline constexpr double title_size = 9.0, label_size = 8.0, small_size = 7.0;
inline constexpr double line_width = 1.1, thin_width = 0.6, frame_width = 0.6, grid_width = 0.35;

inline constexpr Ink text_ink{0x22, 0x22, 0x22}, quiet_ink{0x55, 0x55, 0x55};
inline constexpr Ink frame_ink{0x44, 0x44, 0x44}, grid_ink{0xDD, 0xDD, 0xDD}, guide_ink{0x88, 0x88, 0x88};

using Dash = std::vector<double>;

/// All channels at once.
inline Stroke grey_line() { return {{0x22, 0x22, 0x22}, line_width, {}}; }

/// Channels: readable on white, told apart by lightness and by dash where red and green look alike.
inline Stroke channel_line(std::size_t channel) {
  static const std::array<Stroke, 3> lines{Stroke{{0xC4, 0x2B, 0x2B}, line_width, {5.0, 2.0}},
                                           Stroke{{0x2A, 0x8C, 0x3C}, line_width, {}},
                                           Stroke{{0x24, 0x4F, 0xB8}, line_width, {1.4, 1.6}}};
  return lines[channel % lines.size()];
}

/// Up to this many subjects are told apart.
inline constexpr std::size_t most_subjects = 8;

/// Subjects: the palette of Okabe and Ito (2002) with brown for its yellow, which white paper swallows.
inline Stroke subject_line(std::size_t index) {
  static const std::array<Stroke, most_subjects> lines{
      Stroke{{0x00, 0x72, 0xB2}, line_width, {}},
      Stroke{{0xD5, 0x5E, 0x00}, line_width, {5.0, 1.8}},
      Stroke{{0x00, 0x8F, 0x69}, line_width, {1.4, 1.5}},
      Stroke{{0xC0, 0x5A, 0x96}, line_width, {6.0, 1.6, 1.4, 1.6}},
      Stroke{{0x11, 0x11, 0x11}, line_width, {9.0, 2.2}},
      Stroke{{0xD8, 0x8E, 0x00}, line_width, {3.0, 1.4}},
      Stroke{{0x3D, 0xA5, 0xDC}, line_width, {6.0, 1.4, 1.4, 1.4, 1.4, 1.4}},
      Stroke{{0x7A, 0x4B, 0x1E}, line_width, {2.2, 2.6}}};
  return lines[index % lines.size()];
}

/// Parts of one subject: thin lines in colours that are no channel's.
inline Stroke part_line(std::size_t index) {
  static const std::array<Stroke, most_subjects> lines{
      Stroke{{0x8E, 0x44, 0xAD}, thin_width, {}},         Stroke{{0xC7, 0x7C, 0x02}, thin_width, {4.0, 1.5}},
      Stroke{{0x1A, 0x93, 0x9A}, thin_width, {1.2, 1.2}}, Stroke{{0x6B, 0x4A, 0x2B}, thin_width, {5.0, 1.3, 1.2, 1.3}},
      Stroke{{0x77, 0x77, 0x77}, thin_width, {}},         Stroke{{0xC7, 0x4B, 0x8A}, thin_width, {2.5, 1.2}},
      Stroke{{0x55, 0x7A, 0x1E}, thin_width, {7.0, 1.5}}, Stroke{{0x33, 0x55, 0x77}, thin_width, {1.8, 2.2}}};
  return lines[index % lines.size()];
}

}  // namespace tyndall::style
