#pragma once
// Light scattered once into a ray, through any medium: from a lamp or from a direction, over given lit stretches.
#include <span>
#include <vector>

#include "tyndall/light/airlight_spot.h"
#include "tyndall/medium/lowered_medium.h"
#include "tyndall/render/single_wedge.h"

namespace tyndall {

/// A medium's lobes as airlight wants them, and what kind of medium it is.
struct SingleMedium {
  explicit SingleMedium(const Medium& from);
  SingleMedium(const SingleMedium&) = delete;
  SingleMedium& operator=(const SingleMedium&) = delete;

  /// Lobes of one species with its scattering coefficients (where its factor is 1).
  std::span<const ScatteringLobe> lobes_of(const LoweredSpecies& s) const {
    return std::span(lobes).subspan(s.first_lobe, s.lobe_count);
  }

  LoweredMedium lowered;
  std::vector<ScatteringLobe> lobes;  // parallel to lowered.lobes
  std::vector<std::size_t> kind;      // parallel: which of the distinct lobes it is
  std::vector<Lobe<double>> kinds;    // the distinct lobes
  /// Along any ray, the optical depth of a parallel beam's way to it is linear in the ray's own column of medium,
  /// piece by piece: constant densities in boxes, or exponentials of one scale height without shapes.
  bool linear = false;
};

/// A ray and the medium along it. Reusable: set() keeps the memory.
class RayMedium {
 public:
  /// The ray's direction is a unit vector; it ends at `end` (may be infinite).
  void set(const SingleMedium& medium, const Ray& ray, double end);

  const SingleMedium& medium() const { return *medium_; }
  const Ray& ray() const { return ray_; }
  /// Where the medium or the light that it lets through ends, <= end: nothing beyond scatters anything to the origin.
  double reach() const { return reach_; }
  bool empty() const { return !(reach_ > 0.0); }
  const std::vector<Stretch>& stretches() const { return stretches_; }
  Spectrum transmittance_to(double t) const { return transmittance(stretches_, t); }

  /// Rising, in (0, reach): where a species begins or ends; where a smooth medium asks for a new panel.
  const std::vector<double>& borders() const { return borders_; }
  const std::vector<double>& marks() const { return marks_; }

 private:
  const SingleMedium* medium_ = nullptr;
  Ray ray_;
  double reach_ = 0.0;
  std::vector<Stretch> stretches_;
  std::vector<double> borders_, marks_;
};

/// A lamp of some shape: intensity [W/sr] times the falloff. Points, spots, and small pieces of glowing surfaces, whose
/// 1/r^2 is softened to 1/(r^2 + softening) [m^2] (exact on the axis of a disc of area pi softening).
struct SingleLamp {
  enum class Shape { point, spot, one_sided, two_sided };
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

/// Optical depth between two points.
Spectrum depth_between(const LoweredMedium& medium, const Vector& a, const Vector& b, std::vector<Stretch>& scratch);

}  // namespace tyndall
