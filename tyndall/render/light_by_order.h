#pragma once
// Radiance by what happened to the light between its source and the eye.
#include <array>

#include "tyndall/color/spectrum.h"

namespace tyndall {

/// Parts [W/(m^2 sr)] that share no path and add up to all light.
struct LightByOrder {
  Spectrum surface;         // never scattered by a medium
  Spectrum single;          // scattered once, by a medium, and by no surface
  Spectrum once_reflected;  // once by a medium, and by surfaces
  Spectrum twice;           // twice by media, whatever surfaces did
  Spectrum more;            // three times and more

  Spectrum sum() const { return surface + single + multiple(); }
  /// What an integrator of single scattering leaves out.
  Spectrum multiple() const { return once_reflected + twice + more; }
  /// Scattered once by a medium.
  Spectrum once() const { return single + once_reflected; }

  /// The part of light that media scattered `scatterings` times and surfaces `bounces` times.
  Spectrum& of(int scatterings, int bounces) {
    if (scatterings == 0) return surface;
    if (scatterings == 1) return bounces == 0 ? single : once_reflected;
    return scatterings == 2 ? twice : more;
  }
  LightByOrder& operator+=(const LightByOrder& b) {
    for (Spectrum LightByOrder::*part : parts) this->*part += b.*part;
    return *this;
  }
  static constexpr std::array parts{&LightByOrder::surface, &LightByOrder::single, &LightByOrder::once_reflected,
                                    &LightByOrder::twice, &LightByOrder::more};
};

}  // namespace tyndall
