#pragma once
// Drops of water in air, from fog to rain: what their size says about extinction, absorption and angular law.
#include <array>
#include <cmath>
#include <cstddef>

#include "tyndall/phase/law.h"

namespace tyndall {

/// Extinction efficiency of a drop that is large against the wavelength: 2 (1 + x^(-2/3)) with x = pi diameter /
/// lambda, the leading terms of Nussenzveig & Wiscombe 1980 (with 2 for their 1.9924). 0.4 % below Mie's value at x =
/// 100.
inline double drop_extinction_efficiency(double diameter_um, double wavelength_nm) {
  const double size = 3.14159265358979323846 * diameter_um * 1e3 / wavelength_nm;
  return 2.0 * (1.0 + std::pow(size, -2.0 / 3.0));
}

/// Imaginary part of the refractive index of water: Hale & Querry 1973, table 1, straight between its rows in the
/// logarithm, held outside 400 to 800 nm.
inline double water_absorption_index(double wavelength_nm) {
  struct Row {
    double nm, k;
  };
  constexpr std::array<Row, 9> rows{{{400.0, 1.86e-9},
                                     {450.0, 1.02e-9},
                                     {500.0, 1.00e-9},
                                     {550.0, 1.96e-9},
                                     {600.0, 1.09e-8},
                                     {650.0, 1.64e-8},
                                     {700.0, 3.35e-8},
                                     {750.0, 1.56e-7},
                                     {800.0, 1.25e-7}}};
  if (wavelength_nm <= rows.front().nm) return rows.front().k;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    if (wavelength_nm > rows[i].nm) continue;
    const double t = (wavelength_nm - rows[i - 1].nm) / (rows[i].nm - rows[i - 1].nm);
    return std::exp((1.0 - t) * std::log(rows[i - 1].k) + t * std::log(rows[i].k));
  }
  return rows.back().k;
}

/// 1 - albedo of a drop: the share of its extinction that is absorption, (2/3) a r n^2 [1 - (1 - 1/n^2)^(3/2)] with a =
/// 4 pi k / lambda, for weak absorption by rays (Bohren & Huffman 1983, section 7.1), half of it because diffraction
/// doubles the extinction. At 550 nm 3e-7 for a drop of 16 um, as in OPAC's fog (Hess et al. 1998).
inline double drop_absorbed_share(double diameter_um, double wavelength_nm) {
  constexpr double n2 = 1.333 * 1.333;
  const double per_metre =
      4.0 * 3.14159265358979323846 * water_absorption_index(wavelength_nm) / (wavelength_nm * 1e-9);
  const double path = n2 * (1.0 - std::pow(1.0 - 1.0 / n2, 1.5));
  return std::fmin(0.5, 2.0 / 3.0 * per_metre * diameter_um * 0.5e-6 * path);
}

/// Extinction coefficient [1/m] of liquid water [g/m^3] in drops of an effective diameter [um]: 3 Q LWC / (4 rho r).
inline double extinction_of_liquid_water(double grams_per_cubic_metre, double diameter_um, double wavelength_nm) {
  constexpr double water = 1e6;  // [g/m^3]
  return 3.0 * drop_extinction_efficiency(diameter_um, wavelength_nm) * grams_per_cubic_metre /
         (4.0 * water * diameter_um * 0.5e-6);
}

/// Diameters of fog's droplets [um] that are sized: the range in which phase/droplet.h follows Mie's theory closely.
inline constexpr double smallest_fog_drop = 1.5, largest_fog_drop = 50.0;

/// Mean cosine of raindrops: rays through a sphere of n = 1.333 (0.7685) and as much diffraction, which goes straight
/// on (van de Hulst 1957, chapter 12).
inline constexpr double rain_mean_cosine = 0.884;

/// The angular law of fog. The one place that chooses it.
inline Law<double> fog_law(double diameter_um) { return Droplet<double>{diameter_um}; }
/// The angular law of rain.
inline Law<double> rain_law() { return HenyeyGreenstein<double>{rain_mean_cosine}; }

}  // namespace tyndall
