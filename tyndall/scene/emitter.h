#pragma once
// Emissive triangles as one light: choosing points on them in proportion to power.
#include <cstddef>
#include <vector>

#include "tyndall/scene/surface.h"

namespace tyndall {

/// A triangle that emits.
struct EmissiveTriangle {
  Vector a, ab, ac;   // corner and edges [m]
  Vector normal;      // unit, of the front (counter-clockwise) side
  double area = 0.0;  // [m^2]
  Spectrum radiance;  // of every emitting side; the mean where it has a map
  bool double_sided = false;
  std::size_t mesh = 0, triangle = 0;
};

/// A point on an emitter.
struct EmitterSample {
  Vector point;
  double density = 0.0;  // [1/m^2], of choosing this point among all points of all emitters
  const EmissiveTriangle* emitter = nullptr;
  Spectrum radiance;  // there, of every emitting side

  /// Radiance that leaves the point in a direction (unit or not).
  Spectrum radiance_toward(const Vector& direction) const {
    return emitter->double_sided || dot(emitter->normal, direction) > 0.0 ? radiance : Spectrum{};
  }
};

/// All emissive triangles of a scene, which must outlive this. A triangle is chosen with a probability proportional to
/// area x mean radiance x number of emitting sides, a point on it uniformly. Where emission has a map, a triangle's
/// mean is that of 64 places: one that is black at all of them is never chosen.
class Emitters {
 public:
  explicit Emitters(const Scene& scene);
  explicit Emitters(Scene&&) = delete;

  bool empty() const { return triangles_.empty(); }
  const std::vector<EmissiveTriangle>& triangles() const { return triangles_; }
  /// Power of all emitters per channel [W].
  Spectrum power() const { return power_; }

  /// A point for numbers in [0, 1); the first chooses the triangle. There must be an emitter.
  EmitterSample sample(double choice, double u, double v) const;
  /// Density [1/m^2] with which sample() gives points of a triangle of the scene; 0 where it does not emit.
  double density(std::size_t mesh, std::size_t triangle) const;

 private:
  const Scene& scene_;
  std::vector<EmissiveTriangle> triangles_;  // with area and radiance only, in the scene's order
  std::vector<double> cumulative_;           // sums of weights up to and with each triangle
  std::vector<double> density_;              // per triangle [1/m^2]
  std::vector<std::size_t> first_of_mesh_;   // in triangles_, of the mesh's first; one more at the end
  Spectrum power_;
};

}  // namespace tyndall
