#pragma once
// The medium as `single` sees it: its lobes, and what of it lies along a ray or on the way of light to a ray.
#include <span>
#include <vector>

#include "tyndall/light/airlight.h"
#include "tyndall/medium/lowered_medium.h"
#include "tyndall/render/single_wedge.h"

namespace tyndall {

/// A medium's lobes as airlight wants them, and what kind of medium it is.
struct SingleMedium {
  /// The medium as it is at a time [s].
  explicit SingleMedium(const Medium& from, double time = 0.0);
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
  /// piece by piece: constant densities in boxes or layers, or exponentials of one scale height without shapes.
  bool linear = false;
  /// Some species is not everywhere, or has a form.
  bool shaped = false;
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

/// Optical depth between two points.
Spectrum depth_between(const LoweredMedium& medium, const Vector& a, const Vector& b, std::vector<Stretch>& scratch);

/// Appends the places on a wedge's ray where the light's way begins or ceases to meet a shape of the medium, or meets
/// another face of it: the projections of the corners that the wedge's plane cuts out of boxes, and of the tangents to
/// spheres. Between them the optical depth of that way is smooth.
void add_kinks(const LoweredMedium& medium, const Wedge& wedge, std::vector<double>& breaks);

/// value times e^-depth per channel. Depths may be infinite; the value is then 0, whatever it was.
inline void attenuate(Spectrum& value, const Spectrum& depth) {
  for (std::size_t c = 0; c < channel_count; ++c) value[c] = depth[c] < 740.0 ? value[c] * std::exp(-depth[c]) : 0.0;
}

}  // namespace tyndall
