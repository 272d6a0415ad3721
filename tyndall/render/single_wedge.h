#pragma once
// The part of space between a stretch of a ray and a lamp.
#include <array>

#include "tyndall/geometry/shape.h"

namespace tyndall {

/// A flat wedge: the triangle between a stretch of a ray and a lamp, or the strip from the stretch toward a light
/// infinitely far away. Plane coordinates: x along the ray from its origin, y from the ray toward the lamp, z across.
struct Wedge {
  Vector origin, x, y, z;
  bool far = false;
  bool flat = true;    // false: the lamp is on the ray's line (within 1e-12 of its distance), there is no plane
  double along = 0.0;  // lamp at (along, aside); far: 0
  double aside = 0.0;  // far: 0
  double slope = 0.0;  // far: towards (slope, 1)
  Interval range;      // of the ray
  std::array<std::pair<Vector, double>, 4> halves;  // within the plane: inside is dot(normal, p) >= offset
  std::size_t half_count = 0;

  static Wedge toward_lamp(const Ray& ray, const Interval& range, const Vector& lamp) {
    Wedge w;
    const Vector offset = lamp - ray.origin;
    w.along = dot(offset, ray.direction);
    w.set_plane(ray, range, offset - ray.direction * w.along);
    w.flat = w.aside > 1e-12 * length(offset);
    w.set_halves();
    return w;
  }
  static Wedge toward_direction(const Ray& ray, const Interval& range, const Vector& toward) {
    Wedge w;
    const double forward = dot(toward, ray.direction);
    w.set_plane(ray, range, toward - ray.direction * forward);
    w.far = true;
    w.flat = w.aside > 1e-12;
    w.slope = forward / w.aside;
    w.aside = 0.0;
    w.set_halves();
    return w;
  }

  bool misses(const Box& box, double slack = 0.0) const {
    const Vector center = (box.low + box.high) * 0.5, half = (box.high - box.low) * 0.5;
    const auto reach = [&](const Vector& n) {
      return std::fabs(n.x) * half.x + std::fabs(n.y) * half.y + std::fabs(n.z) * half.z;
    };
    if (std::fabs(dot(center - origin, z)) > reach(z) + slack) return true;
    for (std::size_t i = 0; i < half_count; ++i) {
      const auto& [normal, offset] = halves[i];
      if (dot(normal, center) + reach(normal) < offset - slack) return true;
    }
    return false;
  }
  bool misses(const Sphere& sphere) const {
    if (std::fabs(dot(sphere.center - origin, z)) > sphere.radius) return true;
    for (std::size_t i = 0; i < half_count; ++i) {
      if (dot(halves[i].first, sphere.center) + sphere.radius < halves[i].second) return true;
    }
    return false;
  }

  /// Where the line from the lamp through the plane point (px, py), 0 <= py (< aside), meets the ray.
  double projected(double px, double py) const {
    return far ? px - py * slope : along + (px - along) * aside / (aside - py);
  }

 private:
  void set_plane(const Ray& ray, const Interval& r, Vector across) {
    across = across - ray.direction * dot(across, ray.direction);  // once more: perpendicular even if tiny
    aside = length(across);
    origin = ray.origin;
    range = r;
    x = ray.direction;
    y = aside > 0.0 ? across / aside : Frame::around(x).tangent;
    z = cross(x, y);
  }
  void set_halves() {
    const auto add = [&](double nx, double ny, double nz, double px, double py) {
      const Vector n = x * nx + y * ny + z * nz;
      halves[half_count++] = {n, dot(n, origin) + nx * px + ny * py};
    };
    if (!flat) return;
    add(0, 1, 0, 0, 0);
    if (!far) add(0, -1, 0, along, aside);
    // Right of the line from (begin, 0) to the lamp, left of that from (end, 0).
    const auto side = [&](double t, double sign) {
      const double lx = far ? slope : along - t, ly = far ? 1.0 : aside, scale = sign / std::sqrt(lx * lx + ly * ly);
      add(ly * scale, -lx * scale, 0, t, 0);
    };
    side(range.begin, 1.0);
    if (range.end < infinity) side(range.end, -1.0);
  }
};

}  // namespace tyndall
