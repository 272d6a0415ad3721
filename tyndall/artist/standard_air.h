#pragma once
// Dry air: how strongly it scatters at any wavelength and height.
#include <array>
#include <cmath>

#include "tyndall/color/spectrum.h"

namespace tyndall {

/// Pressure, temperature and number density of air, relative to 288.15 K and 1013.25 hPa for the last.
struct AirState {
  double temperature;       // [K]
  double pressure;          // [Pa]
  double relative_density;  // 1
};

inline constexpr double lowest_altitude = -5000.0, highest_altitude = 86000.0;  // [m], what standard_air_at() covers

/// The U.S. Standard Atmosphere 1976 (NOAA-S/T 76-1562, table 4, eqs 18, 33 a and b) at a height above the sea
/// [m], lowest_altitude to highest_altitude. Within 2e-4 of its tables below 80 km; the molar mass is taken as
/// constant, which costs 4e-4 of the density at 86 km.
inline AirState standard_air_at(double altitude) {
  struct Layer {
    double base, temperature, lapse;  // [m] geopotential, [K], [K/m]
  };
  constexpr std::array<Layer, 7> layers{{{0.0, 288.15, -6.5e-3},
                                         {11e3, 216.65, 0.0},
                                         {20e3, 216.65, 1e-3},
                                         {32e3, 228.65, 2.8e-3},
                                         {47e3, 270.65, 0.0},
                                         {51e3, 270.65, -2.8e-3},
                                         {71e3, 214.65, -2e-3}}};
  constexpr double earth_radius = 6356766.0, hydrostatic = 34.163195e-3;  // [m]; g0 M / R [K/m]
  const double height = earth_radius * altitude / (earth_radius + altitude);
  double pressure = 101325.0;
  for (std::size_t i = 0;; ++i) {
    const Layer& layer = layers[i];
    const bool last = i + 1 == layers.size() || height < layers[i + 1].base;
    const double up = (last ? height : layers[i + 1].base) - layer.base;
    const double temperature = layer.temperature + layer.lapse * up;
    pressure *= layer.lapse == 0.0 ? std::exp(-hydrostatic * up / layer.temperature)
                                   : std::pow(layer.temperature / temperature, hydrostatic / layer.lapse);
    if (last) return {temperature, pressure, pressure / 101325.0 * (288.15 / temperature)};
  }
}

/// n - 1 of dry air at 288.15 K and 1013.25 hPa with 360 ppm of carbon dioxide: Peck & Reeder 1972, eq. 3 (300 ppm),
/// scaled by Bodhaine et al. 1999, eq. 19. Wavelengths 230 to 1690 nm.
inline double air_refractivity(double wavelength_nm) {
  const double s = 1e6 / (wavelength_nm * wavelength_nm);  // [1/um^2]
  const double at_300_ppm = 1e-8 * (8060.51 + 2480990.0 / (132.274 - s) + 17455.7 / (39.32957 - s));
  return at_300_ppm * (1.0 + 0.54 * (360e-6 - 300e-6));
}

/// The King factor (6 + 3 rho) / (6 - 7 rho) of dry air, from those of its gases weighted by volume (Bates 1984;
/// Bodhaine et al. 1999, eqs 5, 6 and 23).
inline double king_factor(double wavelength_nm) {
  const double s = 1e6 / (wavelength_nm * wavelength_nm);
  const double nitrogen = 1.034 + 3.17e-4 * s, oxygen = 1.096 + 1.385e-3 * s + 1.448e-4 * s * s;
  return (78.084 * nitrogen + 20.946 * oxygen + 0.934 * 1.0 + 0.036 * 1.15) / (78.084 + 20.946 + 0.934 + 0.036);
}

/// The depolarisation ratio rho that a King factor F means: rho = 6 (F - 1) / (3 + 7 F).
inline double depolarisation_of(double king) { return 6.0 * (king - 1.0) / (3.0 + 7.0 * king); }

/// Rayleigh scattering coefficient [1/m] of dry air at 288.15 K and 1013.25 hPa (Bodhaine et al. 1999, eq. 2):
/// 24 pi^3 (n^2 - 1)^2 F / (lambda^4 N (n^2 + 2)^2) with N = 2.546899e25 molecules per m^3. 1.149e-5 at 550 nm.
inline double standard_air_scattering(double wavelength_nm) {
  constexpr double pi = 3.14159265358979323846, molecules = 2.546899e25;
  const double n = 1.0 + air_refractivity(wavelength_nm), metres = wavelength_nm * 1e-9;
  const double ratio = (n * n - 1.0) / (n * n + 2.0);
  return 24.0 * pi * pi * pi * ratio * ratio * king_factor(wavelength_nm) / (std::pow(metres, 4.0) * molecules);
}

/// Optical depth of the whole atmosphere above a height at which the pressure is `pressure` [Pa], by scattering of air
/// alone: sigma p / (rho g), 0.097 at 550 nm from sea level.
inline double air_optical_depth_above(double wavelength_nm, double pressure) {
  constexpr double density_at_sea_level = 1.22500, gravity = 9.80665;  // [kg/m^3], [m/s^2]
  return standard_air_scattering(wavelength_nm) * pressure / (density_at_sea_level * gravity);
}

/// How far one can see through air at sea level alone, at 550 nm: 261 km at a contrast of 0.05. [m]
inline double farthest_visibility(double contrast) { return -std::log(contrast) / standard_air_scattering(550.0); }

}  // namespace tyndall
