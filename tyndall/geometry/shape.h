#pragma once
// Boxes, spheres and layers, and where a ray is inside them.
#include <optional>
#include <utility>

#include "tyndall/geometry/vector.h"

namespace tyndall {

/// Axis-aligned box between two corners [m].
struct Box {
  Vector low, high;
};
/// Ball around a centre; radius > 0 [m].
struct Sphere {
  Vector center;
  double radius = 1.0;
};

/// All between two heights [m].
struct HeightRange {
  double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
  bool bounded() const { return low > -infinity || high < infinity; }
};

/// Where the ray is inside, clipped to t >= 0; empty (begin = end = 0) when it misses. The slab method; a direction
/// parallel to a slab counts as inside while the origin is between its planes.
inline Interval inside(const Box& box, const Ray& ray) {
  Interval t{0.0, infinity};
  for (int axis = 0; axis < 3; ++axis) {
    const double o = ray.origin[axis], d = ray.direction[axis];
    if (d == 0.0) {
      if (o < box.low[axis] || o > box.high[axis]) return {0.0, 0.0};
      continue;
    }
    double near = (box.low[axis] - o) / d, far = (box.high[axis] - o) / d;
    if (near > far) std::swap(near, far);
    t = intersection(t, {near, far});
  }
  return t.empty() ? Interval{0.0, 0.0} : t;
}

/// As for boxes. The half chord comes from the distance of closest approach, computed as a vector so that far spheres
/// keep their digits (Haines and Akenine-Moeller, Ray Tracing Gems 2019, chapter 7).
inline Interval inside(const Sphere& sphere, const Ray& ray) {
  const Vector to_center = sphere.center - ray.origin;
  const double middle = dot(to_center, ray.direction);
  const Vector closest = to_center - ray.direction * middle;
  const double half_squared = sphere.radius * sphere.radius - dot(closest, closest);
  if (half_squared <= 0.0) return {0.0, 0.0};
  const double half = std::sqrt(half_squared);
  const Interval t = intersection({0.0, infinity}, {middle - half, middle + half});
  return t.empty() ? Interval{0.0, 0.0} : t;
}

/// As for boxes.
inline Interval inside(const HeightRange& range, const Ray& ray) {
  const double o = ray.origin.y, d = ray.direction.y;
  if (d == 0.0) return o >= range.low && o <= range.high ? Interval{0.0, infinity} : Interval{0.0, 0.0};
  const double low = (range.low - o) / d, high = (range.high - o) / d;
  const Interval t = intersection({0.0, infinity}, {std::min(low, high), std::max(low, high)});
  return t.empty() ? Interval{0.0, 0.0} : t;
}

inline bool contains(const HeightRange& range, const Vector& p) { return p.y >= range.low && p.y <= range.high; }
inline bool contains(const Box& box, const Vector& p) {
  return p.x >= box.low.x && p.x <= box.high.x && p.y >= box.low.y && p.y <= box.high.y && p.z >= box.low.z &&
         p.z <= box.high.z;
}
inline bool contains(const Sphere& sphere, const Vector& p) {
  return length_squared(p - sphere.center) <= sphere.radius * sphere.radius;
}

}  // namespace tyndall
