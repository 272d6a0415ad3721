#pragma once
// Light scattered once into a ray, through any medium: from a lamp or from a direction, over given lit stretches.
#include <span>

#include "tyndall/light/airlight_spot.h"
#include "tyndall/render/single_medium.h"

namespace tyndall {

/// A lamp of some shape: intensity [W/sr] times the falloff. Points, spots, and small pieces of glowing surfaces, whose
/// 1/r^2 is softened to 1/(r^2 + softening) [m^2] (exact on the axis of a disc of area pi softening).
struct SingleLamp {
  enum class Shape { point, spot, one_sided };
  Shape shape = Shape::point;
  Vector position;
  Spectrum intensity;  // on the axis
  Vector axis;         // unit; unless a point
  SpotLight spot;      // angles, of a spot
  double softening = 0.0;

  /// Relative intensity in the unit direction `away` from the lamp.
  double falloff(const Vector& away) const;
};

/// Radiance [W/(m^2 sr)] arriving at the ray's origin that the lamp has scattered into it from the `lit` stretches
/// (rising, within [0, end]). Closed forms and fixed panels where the medium around is homogeneous, else adaptive
/// panels, to `tolerance` of each stretch. Infinite where the lamp stands on a lit stretch inside scattering medium.
Spectrum lamp_airlight(const RayMedium& along, const SingleLamp& lamp, std::span<const Interval> lit, double tolerance);

/// The same for parallel light of irradiance 1 W/m^2 coming from the unit direction `toward`.
Spectrum sun_airlight(const RayMedium& along, const Vector& toward, std::span<const Interval> lit, double tolerance);

}  // namespace tyndall
