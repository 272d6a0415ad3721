#pragma once
// What the three channels of a medium stand for, and the wavelengths that this means where physics asks for one.
#include <array>
#include <cmath>
#include <optional>
#include <string_view>
#include <tuple>
#include <variant>

#include "tyndall/color/spectrum.h"
#include "tyndall/number/field.h"

namespace tyndall {

enum class ColorSpace { linear_srgb };
constexpr std::array<std::string_view, 1> words_of(ColorSpace) { return {"linear-srgb"}; }
struct ChannelSpace {
  ColorSpace space = ColorSpace::linear_srgb;
  bool operator==(const ChannelSpace&) const = default;
  static constexpr auto fields() {
    return std::tuple{Field{"space", &ChannelSpace::space, any_number, "", "The colour space.", Scaling::none, true}};
  }
};
struct ChannelWavelengths {
  std::array<double, channel_count> wavelengths_nm{680.0, 550.0, 440.0};
  bool operator==(const ChannelWavelengths&) const = default;
  static constexpr auto fields() {
    return std::tuple{Field{"wavelengths_nm", &ChannelWavelengths::wavelengths_nm, positive, "nm",
                            "The wavelengths that the channels stand for.", Scaling::none, true}};
  }
};
using ChannelTag = std::variant<ChannelSpace, ChannelWavelengths>;

/// The wavelength [nm] at which a channel takes a spectral law's value. Linear sRGB has no wavelengths; 680, 550 and
/// 440 nm stand for it, because the note's triplet is stated there (as are Bruneton & Neyret 2008 and Hillaire 2020):
/// air of either kind then means the same channels. What that costs: the sRGB colour of equal-energy light scattered
/// once by thin air, taken through the CIE 1931 matching functions, is that of 639, 549 and 441 nm; red is 22 % lower.
inline Spectrum wavelengths_of(const std::optional<ChannelTag>& tag) {
  ChannelWavelengths stated;
  if (tag && std::holds_alternative<ChannelWavelengths>(*tag)) stated = std::get<ChannelWavelengths>(*tag);
  return Spectrum{stated.wavelengths_nm};
}

/// A coefficient that is known at the channels' wavelengths, at another wavelength [nm]: along the power law through
/// the two channels that are nearest to it in wavelength (Angstrom 1929), straight where one of them is 0; never
/// negative. Exact at the channels themselves.
inline double at_wavelength(const Spectrum& coefficient, const Spectrum& wavelengths_nm, double nm) {
  std::size_t a = 0, b = 0;
  const auto apart = [&](std::size_t i) { return std::fabs(std::log(wavelengths_nm[i] / nm)); };
  for (std::size_t i = 1; i < channel_count; ++i) {
    if (apart(i) < apart(a)) a = i;
  }
  if (wavelengths_nm[a] == nm) return coefficient[a];
  b = a;
  for (std::size_t i = 0; i < channel_count; ++i) {
    if (wavelengths_nm[i] != wavelengths_nm[a] && (b == a || apart(i) < apart(b))) b = i;
  }
  if (b == a) return coefficient[a];
  const double t = std::log(nm / wavelengths_nm[a]) / std::log(wavelengths_nm[b] / wavelengths_nm[a]);
  if (coefficient[a] > 0.0 && coefficient[b] > 0.0) {
    return coefficient[a] * std::pow(coefficient[b] / coefficient[a], t);
  }
  return std::fmax(0.0, coefficient[a] + t * (coefficient[b] - coefficient[a]));
}

}  // namespace tyndall
