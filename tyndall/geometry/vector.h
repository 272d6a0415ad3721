#pragma once
// Points and directions in space: right-handed, +Y up, metres.
#include <algorithm>
#include <cmath>
#include <limits>

namespace tyndall {

struct Vector {
  double x = 0.0, y = 0.0, z = 0.0;

  constexpr double operator[](int i) const { return i == 0 ? x : i == 1 ? y : z; }
  constexpr bool operator==(const Vector&) const = default;
  constexpr Vector operator-() const { return {-x, -y, -z}; }
  constexpr Vector& operator+=(const Vector& b) { return *this = *this + b; }
  friend constexpr Vector operator+(const Vector& a, const Vector& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend constexpr Vector operator-(const Vector& a, const Vector& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend constexpr Vector operator*(const Vector& a, double s) { return {a.x * s, a.y * s, a.z * s}; }
  friend constexpr Vector operator*(double s, const Vector& a) { return a * s; }
  friend constexpr Vector operator/(const Vector& a, double s) { return {a.x / s, a.y / s, a.z / s}; }
};

constexpr double dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr Vector cross(const Vector& a, const Vector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
constexpr double length_squared(const Vector& a) { return dot(a, a); }
inline double length(const Vector& a) { return std::sqrt(dot(a, a)); }
/// a / |a|; a must not be zero.
inline Vector normalized(const Vector& a) { return a / length(a); }
inline bool is_finite(const Vector& a) { return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z); }

/// Two unit vectors that complete the unit vector n to a right-handed frame (Duff et al. 2017, listing 3).
struct Frame {
  Vector tangent, bitangent, normal;
  static Frame around(const Vector& n) {
    const double sign = std::copysign(1.0, n.z);
    const double a = -1.0 / (sign + n.z), b = n.x * n.y * a;
    return {{1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}, n};
  }
  Vector to_world(const Vector& local) const { return tangent * local.x + bitangent * local.y + normal * local.z; }
  Vector to_local(const Vector& world) const {
    return {dot(world, tangent), dot(world, bitangent), dot(world, normal)};
  }
};

/// origin + t direction for t in [0, inf); the direction is a unit vector unless said otherwise.
struct Ray {
  Vector origin, direction;
  Vector at(double t) const { return origin + direction * t; }
};

inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// A stretch of a ray, begin <= end; empty where begin >= end.
struct Interval {
  double begin = 0.0, end = infinity;
  bool empty() const { return !(begin < end); }
};
inline Interval intersection(const Interval& a, const Interval& b) {
  return {std::max(a.begin, b.begin), std::min(a.end, b.end)};
}

}  // namespace tyndall
