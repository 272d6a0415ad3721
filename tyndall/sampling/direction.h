#pragma once
// Random directions.
#include <cmath>
#include <numbers>

#include "tyndall/geometry/vector.h"

namespace tyndall {

/// The unit vector at cosine `cosine` and sine `sine` from the frame's normal, at azimuth 2 pi xi.
inline Vector around(const Frame& frame, double cosine, double sine, double xi) {
  const double azimuth = 2.0 * std::numbers::pi * xi;
  return frame.to_world({sine * std::cos(azimuth), sine * std::sin(azimuth), cosine});
}

/// Uniform over the sphere; density 1/(4 pi).
inline Vector sample_sphere(double xi1, double xi2) {
  const double z = 1.0 - 2.0 * xi1;
  return around(Frame{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, z, 2.0 * std::sqrt(xi1 * (1.0 - xi1)), xi2);
}

/// Proportional to the cosine over the hemisphere around the frame's normal; density cos / pi.
inline Vector sample_cosine(const Frame& frame, double xi1, double xi2) {
  return around(frame, std::sqrt(1.0 - xi1), std::sqrt(xi1), xi2);
}

/// Uniform in the cone of half angle given by 1 - cos; density 1 / (2 pi one_minus_cos).
inline Vector sample_cone(const Frame& frame, double one_minus_cos, double xi1, double xi2) {
  const double v = one_minus_cos * xi1;
  return around(frame, 1.0 - v, std::sqrt(v * (2.0 - v)), xi2);
}

}  // namespace tyndall
