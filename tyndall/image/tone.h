#pragma once
// From linear radiance to what a screen shows: exposure, tone curve, sRGB.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>

#include "tyndall/color/spectrum.h"

namespace tyndall {

/// filmic: a film-like shoulder; bright colours go to white without turning into others. none: values above 1 are cut.
enum class Tone { filmic, none };
inline constexpr std::array<std::string_view, 2> tone_names{"filmic", "none"};  // in the order of Tone

/// Linear sRGB (ITU-R BT.709 primaries) of a scene to linear sRGB of a screen, in [0, 1]. Stephen Hill's fit (2016) to
/// the ACES reference rendering and sRGB output transforms: into a wider space whose channels overlap (so that a
/// saturated light that grows brighter turns pale, not another hue), per channel
///   f(v) = (v (v + 0.0245786) - 0.000090537) / (v (0.983729 v + 0.4329510) + 0.238081),
/// and back. Its input is scaled by 1.461926 so that middle grey stays where it is, f(0.18 x scale) = 0.18: both tones
/// then agree on the exposure of a picture. White is reached at 17.6, 6.6 stops above middle grey.
inline Spectrum filmic(const Spectrum& rgb) {
  constexpr double scale = 1.461926;
  const auto curve = [](double v) {
    v = std::max(v, 0.0);
    return (v * (v + 0.0245786) - 0.000090537) / (v * (0.983729 * v + 0.4329510) + 0.238081);
  };
  // Beyond this nothing changes any more, and infinity / infinity stays away.
  const Spectrum c = map(rgb, [](double x) { return std::clamp(x, 0.0, 1e6) * scale; });
  const double r = curve(0.59719 * c[0] + 0.35458 * c[1] + 0.04823 * c[2]);
  const double g = curve(0.07600 * c[0] + 0.90834 * c[1] + 0.01566 * c[2]);
  const double b = curve(0.02840 * c[0] + 0.13383 * c[1] + 0.83777 * c[2]);
  const Spectrum shown{{1.60475 * r - 0.53108 * g - 0.07367 * b, -0.10208 * r + 1.10813 * g - 0.00605 * b,
                        -0.00327 * r - 0.07276 * g + 1.07602 * b}};
  return map(shown, [](double x) { return std::clamp(x, 0.0, 1.0); });
}

/// The sRGB transfer function (IEC 61966-2-1) and its inverse, on [0, 1].
inline double srgb_from_linear(double x) { return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055; }
inline double linear_from_srgb(double x) { return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4); }

/// How a linear picture is shown: multiplied by 2^exposure, then the tone curve.
struct Development {
  double exposure = 0.0;  // [EV]
  Tone tone = Tone::filmic;
};

/// The 8-bit sRGB code of a linear colour; what is not a number is shown black.
inline std::array<std::uint8_t, 3> develop(const Spectrum& rgb, const Development& how) {
  Spectrum c = map(rgb, [&how](double x) { return std::isnan(x) ? 0.0 : x * std::exp2(how.exposure); });
  c = how.tone == Tone::filmic ? filmic(c) : map(c, [](double x) { return std::clamp(x, 0.0, 1.0); });
  std::array<std::uint8_t, 3> code{};
  for (std::size_t i = 0; i < 3; ++i) code[i] = static_cast<std::uint8_t>(std::lround(255.0 * srgb_from_linear(c[i])));
  return code;
}

}  // namespace tyndall
