#pragma once
// Kinds of particles in the air, as measured: how their extinction, albedo and mean cosine go with the wavelength.
#include <array>
#include <cmath>
#include <optional>
#include <string_view>

#include "tyndall/artist/droplets.h"

namespace tyndall {

/// What is in the air besides air.
enum class Particles { clear, continental, polluted, urban, maritime, dust, fog, rain };
constexpr std::array<std::string_view, 8> words_of(Particles) {
  return {"clear", "continental", "polluted", "urban", "maritime", "dust", "fog", "rain"};
}
constexpr bool is_water(Particles kind) { return kind == Particles::fog || kind == Particles::rain; }
inline std::string_view word_of(Particles kind) { return words_of(kind)[static_cast<std::size_t>(kind)]; }

/// A dry kind. Hess, Koepke & Schult 1998 (OPAC 3.1), table 4, at 80 % relative humidity: Angstrom exponents from 350
/// to 500 nm and 500 to 800 nm, mean cosine at 550 nm. The albedos at 450, 550 and 700 nm are those of table 4's
/// mixtures, computed from OPAC's component files (at 550 nm they are table 4's own).
struct Aerosol {
  double exponent_below_500, exponent_above_500;
  std::array<double, 3> albedo;
  double mean_cosine;
};
inline constexpr std::array<double, 3> aerosol_albedo_nm{450.0, 550.0, 700.0};

inline constexpr Aerosol aerosol_of(Particles kind) {
  switch (kind) {
    case Particles::clear:  // "continental clean"
      return {1.10, 1.42, {0.977, 0.972, 0.965}, 0.709};
    case Particles::polluted:  // "continental polluted"
      return {1.13, 1.45, {0.898, 0.892, 0.882}, 0.698};
    case Particles::urban:  // "urban": soot makes it dark
      return {1.14, 1.43, {0.824, 0.817, 0.803}, 0.689};
    case Particles::maritime:  // "maritime clean": sea salt
      return {0.12, 0.08, {0.997, 0.997, 0.998}, 0.772};
    case Particles::dust:  // "desert"
      return {0.20, 0.17, {0.843, 0.888, 0.919}, 0.729};
    case Particles::continental:  // "continental average"
    case Particles::fog:
    case Particles::rain:
      break;
  }
  return {1.11, 1.42, {0.930, 0.925, 0.917}, 0.703};
}

/// Diameter of drops [um] where none is stated: fog, twice the effective radius of Shettle & Fenn's heavy radiation fog
/// (1979); rain, 3 / Lambda of Marshall & Palmer's law at 5 mm/h (1948), Lambda = 4.1 R^-0.21 per mm.
inline constexpr double usual_diameter(Particles kind) { return kind == Particles::rain ? 1025.0 : 12.0; }

/// Extinction at a wavelength relative to 550 nm. Dry kinds follow their two Angstrom exponents, or one that is stated.
inline double relative_extinction(Particles kind, double diameter_um, std::optional<double> angstrom_exponent,
                                  double wavelength_nm) {
  if (angstrom_exponent) return std::pow(wavelength_nm / 550.0, -*angstrom_exponent);
  if (is_water(kind)) {
    return drop_extinction_efficiency(diameter_um, wavelength_nm) / drop_extinction_efficiency(diameter_um, 550.0);
  }
  const Aerosol aerosol = aerosol_of(kind);
  if (wavelength_nm >= 500.0) return std::pow(wavelength_nm / 550.0, -aerosol.exponent_above_500);
  return std::pow(500.0 / 550.0, -aerosol.exponent_above_500) *
         std::pow(wavelength_nm / 500.0, -aerosol.exponent_below_500);
}

/// 1 - albedo at a wavelength: its own number, because 1 - 3e-7 keeps few digits. Dry kinds: straight between the
/// wavelengths of their table, held outside.
inline double absorbed_share(Particles kind, double diameter_um, double wavelength_nm) {
  if (is_water(kind)) return drop_absorbed_share(diameter_um, wavelength_nm);
  const auto& nm = aerosol_albedo_nm;
  const auto albedo = aerosol_of(kind).albedo;
  const std::size_t i = wavelength_nm < nm[1] ? 0 : 1;
  const double t = std::fmin(1.0, std::fmax(0.0, (wavelength_nm - nm[i]) / (nm[i + 1] - nm[i])));
  return 1.0 - ((1.0 - t) * albedo[i] + t * albedo[i + 1]);
}

inline Law<double> law_of(Particles kind, double diameter_um) {
  if (kind == Particles::fog) return fog_law(diameter_um);
  if (kind == Particles::rain) return rain_law();
  return HenyeyGreenstein<double>{aerosol_of(kind).mean_cosine};
}

}  // namespace tyndall
