#pragma once
// The ways a person may say how dense something is; each means an extinction coefficient.
#include <cmath>
#include <string_view>
#include <tuple>
#include <variant>
#include <vector>

#include "tyndall/color/spectrum.h"
#include "tyndall/number/field.h"

namespace tyndall {

/// Extinction coefficient sigma_t per channel, as a number or triplet alone: 1e-3.
struct PlainExtinction {
  static constexpr bool bare = true;
  Spectrum extinction;
  static constexpr auto fields() {
    return std::tuple{Field{"extinction", &PlainExtinction::extinction, not_negative, "1/m",
                            "Share of light lost per length of path.", Scaling::inverse_length, true}};
  }
};

/// {"extinction": 1e-3}.
struct StatedExtinction {
  Spectrum extinction;
  static constexpr auto fields() {
    return std::tuple{Field{"extinction", &StatedExtinction::extinction, not_negative, "1/m",
                            "Share of light lost per length of path.", Scaling::inverse_length, true}};
  }
};

/// {"mean_free_path": 1000}: the mean distance light travels before it is scattered or absorbed, 1 / sigma_t.
struct MeanFreePath {
  Spectrum mean_free_path = Spectrum::grey(1.0);
  static constexpr auto fields() {
    return std::tuple{Field{"mean_free_path", &MeanFreePath::mean_free_path, positive, "m",
                            "Mean distance that light travels undisturbed.", Scaling::length, true}};
  }
};

/// {"visibility": 3000}: the distance at which the contrast of a black object has fallen to `contrast`, -ln(contrast) /
/// sigma_t (Koschmieder 1924). 0.05 gives the meteorological optical range, 0.02 Koschmieder's own.
struct Visibility {
  Spectrum visibility = Spectrum::grey(1.0);
  double contrast = 0.05;
  static constexpr auto fields() {
    return std::tuple{
        Field{"visibility", &Visibility::visibility, positive, "m", "How far one can see.", Scaling::length, true},
        Field{"contrast", &Visibility::contrast, Range{0.0, 1.0, true, true}, "1",
              "Contrast that is still seen: 0.05 or 0.02."}};
  }
};

/// {"transmittance": 0.9, "distance": 100}: the share of light, in (0, 1], that comes through `distance` unscattered
/// and unabsorbed, -ln(transmittance) / distance.
struct Transmittance {
  Spectrum transmittance = Spectrum::grey(1.0);
  double distance = 1.0;
  static constexpr auto fields() {
    return std::tuple{Field{"transmittance", &Transmittance::transmittance, Range{0.0, 1.0, true, false}, "1",
                            "Share of light that comes through the distance.", Scaling::none, true},
                      Field{"distance", &Transmittance::distance, positive, "m",
                            "The distance that the transmittance is for.", Scaling::length, true}};
  }
};

/// {"optical_depth": 1, "distance": 100}: the extinction's integral along `distance`, optical_depth / distance.
struct OpticalDepth {
  Spectrum optical_depth;
  double distance = 1.0;
  static constexpr auto fields() {
    return std::tuple{Field{"optical_depth", &OpticalDepth::optical_depth, not_negative, "1",
                            "Extinction times distance.", Scaling::none, true},
                      Field{"distance", &OpticalDepth::distance, positive, "m",
                            "The distance that the optical depth is for.", Scaling::length, true}};
  }
};

/// {"mass_concentration": 35e-6, "mass_extinction": 4}: grams of particles in a cubic metre of air, times what a gram
/// takes from a beam. Both are never scaled with the unit of length.
struct MassExtinction {
  Spectrum mass_concentration, mass_extinction;
  static constexpr auto fields() {
    return std::tuple{Field{"mass_concentration", &MassExtinction::mass_concentration, not_negative, "g/m^3",
                            "Mass of the particles per volume of air.", Scaling::none, true},
                      Field{"mass_extinction", &MassExtinction::mass_extinction, not_negative, "m^2/g",
                            "Extinction cross section of a gram of them.", Scaling::none, true}};
  }
};

/// The closed list, told apart by form (number/described.h).
using Density = std::variant<PlainExtinction, StatedExtinction, MeanFreePath, Visibility, Transmittance, OpticalDepth,
                             MassExtinction>;

/// Extinction coefficient [1/m] of a density in metres. With lengths in units of `meters_per_unit` metres it is per
/// unit; every form needs the unit's length then, because a mass states 1/m whatever the unit.
inline Spectrum extinction_of(const Density& density, double meters_per_unit = 1.0) {
  struct Of {
    double meters_per_unit;
    Spectrum operator()(const PlainExtinction& d) const { return d.extinction; }
    Spectrum operator()(const StatedExtinction& d) const { return d.extinction; }
    Spectrum operator()(const MeanFreePath& d) const { return Spectrum::grey(1.0) / d.mean_free_path; }
    Spectrum operator()(const Visibility& d) const { return Spectrum::grey(-std::log(d.contrast)) / d.visibility; }
    Spectrum operator()(const Transmittance& d) const {
      return map(d.transmittance, [](double x) { return 0.0 - std::log(x); }) / d.distance;
    }
    Spectrum operator()(const OpticalDepth& d) const { return d.optical_depth / d.distance; }
    Spectrum operator()(const MassExtinction& d) const {
      return d.mass_concentration * d.mass_extinction * meters_per_unit;
    }
  };
  return std::visit(Of{meters_per_unit}, density);
}

/// An extinction coefficient [1/m] in every form but the plain one, in SI: transmittance and optical depth for
/// `distance` [m], the mass for `mass_extinction` [m^2/g].
inline std::vector<Density> every_form_of(const Spectrum& extinction, double distance, double mass_extinction) {
  const auto visibility = [&](double contrast) {
    return Visibility{Spectrum::grey(-std::log(contrast)) / extinction, contrast};
  };
  return {StatedExtinction{extinction},
          MeanFreePath{Spectrum::grey(1.0) / extinction},
          visibility(0.05),
          visibility(0.02),
          Transmittance{exp(-distance * extinction), distance},
          OpticalDepth{distance * extinction, distance},
          MassExtinction{extinction / mass_extinction, Spectrum::grey(mass_extinction)}};
}

}  // namespace tyndall
