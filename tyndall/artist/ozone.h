#pragma once
// The ozone layer: it absorbs, and does not scatter.
#include <array>
#include <cstddef>

namespace tyndall {

/// Molecules per m^2 in one Dobson unit: 10 um of gas at 273.15 K and 1013.25 hPa.
inline constexpr double dobson_unit = 2.687e20;

/// Absorption cross section of an ozone molecule [m^2] at 233 K, averaged over 10 nm bins that begin at 360 nm: spectra
/// of the Institute of Environmental Physics, Bremen (Gorshelev et al. 2014; Serdyuchenko et al. 2014; file
/// "o3spectra2011"), as binned by Bruneton (2017, atmosphere/demo). The bins from 440, 550, 600 and 680 nm:
/// 1.582e-26, 3.50e-25, 5.019e-25 (the peak of the Chappuis band) and 1.209e-25.
inline constexpr std::array<double, 48> ozone_cross_sections{
    1.18e-27,  2.182e-28, 2.818e-28, 6.636e-28, 1.527e-27, 2.763e-27, 5.52e-27,  8.451e-27, 1.582e-26, 2.316e-26,
    3.669e-26, 4.924e-26, 7.752e-26, 9.016e-26, 1.48e-25,  1.602e-25, 2.139e-25, 2.755e-25, 3.091e-25, 3.5e-25,
    4.266e-25, 4.672e-25, 4.398e-25, 4.701e-25, 5.019e-25, 4.305e-25, 3.74e-25,  3.215e-25, 2.662e-25, 2.238e-25,
    1.852e-25, 1.473e-25, 1.209e-25, 9.423e-26, 7.455e-26, 6.566e-26, 5.105e-26, 4.15e-26,  4.228e-26, 3.237e-26,
    2.451e-26, 2.801e-26, 2.534e-26, 1.624e-26, 1.465e-26, 2.078e-26, 1.383e-26, 7.105e-27};
inline constexpr double ozone_from_nm = 360.0, ozone_to_nm = 840.0;
inline constexpr bool is_in_ozone_table(double wavelength_nm) {
  return wavelength_nm >= ozone_from_nm && wavelength_nm < ozone_to_nm;
}

/// The cross section [m^2] of the bin in which a wavelength lies; only where is_in_ozone_table().
inline constexpr double ozone_cross_section(double wavelength_nm) {
  return ozone_cross_sections[static_cast<std::size_t>((wavelength_nm - ozone_from_nm) / 10.0)];
}

/// The layer as a tent: nothing below 10 km, most at 25 km, nothing above 40 km [m above the sea]. (Bruneton & Neyret
/// 2008 as revised 2017; the measured mid-latitude profile of the U.S. Standard Atmosphere 1976 peaks at 22 km.)
inline constexpr double ozone_centre = 25000.0, ozone_half_width = 15000.0;

/// Absorption [1/m] in the middle of the layer, for a column in Dobson units: the tent's area is its half width.
inline constexpr double ozone_absorption(double wavelength_nm, double column_dobson) {
  return ozone_cross_section(wavelength_nm) * column_dobson * dobson_unit / ozone_half_width;
}

}  // namespace tyndall
