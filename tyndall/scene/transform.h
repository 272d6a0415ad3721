#pragma once
// Affine maps of space: what the nodes of a scene graph do to what hangs below them.
#include <array>

#include "tyndall/geometry/vector.h"

namespace tyndall {

/// p -> x p.x + y p.y + z p.z + origin: columns are the images of the axes.
struct Transform {
  Vector x{1.0, 0.0, 0.0}, y{0.0, 1.0, 0.0}, z{0.0, 0.0, 1.0}, origin;

  Vector point(const Vector& p) const { return vector(p) + origin; }
  Vector vector(const Vector& v) const { return x * v.x + y * v.y + z * v.z; }
  /// Volume factor; negative for a mirroring.
  double determinant() const { return dot(x, cross(y, z)); }
  /// A normal as it is after the map, not of unit length: n -> det M^-T n, turned so that a mirroring keeps it on its
  /// side of the surface. Works for flattening maps too, where M has no inverse.
  Vector normal(const Vector& n) const {
    const Vector mapped = cross(y, z) * n.x + cross(z, x) * n.y + cross(x, y) * n.z;
    return determinant() < 0.0 ? -mapped : mapped;
  }
};

/// First b, then a.
inline Transform operator*(const Transform& a, const Transform& b) {
  return {a.vector(b.x), a.vector(b.y), a.vector(b.z), a.point(b.origin)};
}

/// First scaled, then turned by the quaternion (x, y, z, w) (made unit; zero: no turn), then moved: glTF's order.
inline Transform placed(const Vector& translation, std::array<double, 4> q, const Vector& scale) {
  const double norm = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  if (!(norm > 0.0)) {
    q = {0.0, 0.0, 0.0, 1.0};
  } else {
    for (double& c : q) c /= norm;
  }
  const auto [i, j, k, w] = q;
  const Vector x{1.0 - 2.0 * (j * j + k * k), 2.0 * (i * j + k * w), 2.0 * (i * k - j * w)};
  const Vector y{2.0 * (i * j - k * w), 1.0 - 2.0 * (i * i + k * k), 2.0 * (j * k + i * w)};
  const Vector z{2.0 * (i * k + j * w), 2.0 * (j * k - i * w), 1.0 - 2.0 * (i * i + j * j)};
  return {x * scale.x, y * scale.y, z * scale.z, translation};
}

}  // namespace tyndall
