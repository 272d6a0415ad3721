#pragma once
// Where a ray is inside the cone of a spot light.
#include "tyndall/light/light.h"

namespace tyndall {

/// The stretch of `range` inside the cone of half angle `half_angle` (degrees, below 90) around `axis` (unit) with its
/// apex at `apex`; empty when the ray misses. One nappe of a cone is convex, so there is one stretch at most.
inline Interval inside_cone(const Ray& ray, const Interval& range, const Vector& apex, const Vector& axis,
                            double half_angle) {
  // With w = o - apex: (axis.(w + t d))^2 >= c^2 |w + t d|^2 and axis.(w + t d) >= 0.
  const double c = std::cos(half_angle * std::numbers::pi / 180.0), c2 = c * c;
  const Vector w = ray.origin - apex;
  const double ad = dot(axis, ray.direction), aw = dot(axis, w), dw = dot(ray.direction, w);
  const double qa = ad * ad - c2, qb = ad * aw - c2 * dw, qc = aw * aw - c2 * dot(w, w);
  const auto clip = [&](double begin, double end) {
    const Interval t = intersection(range, {begin, end});
    return t.empty() ? Interval{0.0, 0.0} : t;
  };
  const double discriminant = qb * qb - qa * qc;
  if (std::fabs(qa) < 1e-14) {  // parallel to the cone's surface: one crossing
    if (qb == 0.0) return qc >= 0.0 && aw >= 0.0 ? clip(-infinity, infinity) : Interval{0.0, 0.0};
    const double t = -0.5 * qc / qb;
    return qb > 0.0 ? clip(t, infinity) : clip(-infinity, t);
  }
  if (discriminant < 0.0) {
    return {0.0, 0.0};  // never crosses the surface; qa > 0 without a crossing cannot happen for a double cone
  }
  const double root = std::sqrt(discriminant), q = -(qb + std::copysign(root, qb));
  double t0 = q / qa, t1 = q != 0.0 ? qc / q : t0;
  if (t0 > t1) std::swap(t0, t1);
  const bool lit0 = aw + t0 * ad >= 0.0, lit1 = aw + t1 * ad >= 0.0;
  if (qa < 0.0) {  // inside the double cone between the crossings, both on one nappe
    return lit0 && lit1 ? clip(t0, t1) : Interval{0.0, 0.0};
  }
  // Inside the double cone before t0 and after t1, on different nappes: the lit one is where axis.d leads.
  return ad > 0.0 ? clip(t1, infinity) : clip(-infinity, t0);
}

/// Where the ray receives light of the spot.
inline Interval lit_interval(const SpotLight& spot, const Ray& ray, const Interval& range) {
  if (spot.outer_angle >= 90.0) {
    const double ad = dot(normalized(spot.direction), ray.direction),
                 aw = dot(normalized(spot.direction), ray.origin - spot.position);
    if (ad == 0.0) return aw > 0.0 ? range : Interval{0.0, 0.0};
    const Interval t =
        ad > 0.0 ? intersection(range, {-aw / ad, infinity}) : intersection(range, {-infinity, -aw / ad});
    return t.empty() ? Interval{0.0, 0.0} : t;
  }
  return inside_cone(ray, range, spot.position, normalized(spot.direction), spot.outer_angle);
}

}  // namespace tyndall
