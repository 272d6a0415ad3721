#pragma once
// Whether a flight will hardly leave the air: a guess from where it begins, for choosing between ways to the same mean.
#include <algorithm>

#include "tyndall/medium/lowered_medium.h"

namespace tyndall {

class DenseAir {
 public:
  explicit DenseAir(const LoweredMedium& medium) {
    for (const LoweredSpecies& s : medium.species) {
      Box box{{-infinity, -infinity, -infinity}, {infinity, infinity, infinity}};
      if (!s.boxes.empty()) box = s.boxes[0];
      for (const Sphere& ball : s.spheres) {
        const Vector r{ball.radius, ball.radius, ball.radius};
        if (s.boxes.empty()) box = {ball.center - r, ball.center + r};
      }
      bounds_ = {least(bounds_.low, box.low), greatest(bounds_.high, box.high)};
      if (s.form.only_a_grid() && s.decay == 0.0) grids_ += s.extinction * s.form.grids[0].typical;
      decay_ = std::max(decay_, s.decay);
    }
  }

  /// Whether the ray, which begins where the extinction is given, has more than a few mean free paths of such air, or
  /// one of such grids, before its `end`. Of the same ray always the same.
  bool lies_ahead(const Ray& ray, const Spectrum& extinction, double end) const {
    double way = std::min(end, inside(bounds_, ray).end);
    if (decay_ > 0.0) way = std::min(way, 1.0 / (decay_ * std::max(0.0, ray.direction.y)));
    const double least = std::min({extinction[0], extinction[1], extinction[2]});
    // Flights through grids cost least by null collisions, which only flights as they come can have.
    if (least > 0.0 && std::min({grids_[0], grids_[1], grids_[2]}) * way > 1.0) return true;
    return least * way > 6.0;
  }

 private:
  static Vector least(const Vector& a, const Vector& b) {
    return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
  }
  static Vector greatest(const Vector& a, const Vector& b) {
    return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
  }

  Box bounds_{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
  double decay_ = 0.0;
  Spectrum grids_;  // a typical extinction in them
};

}  // namespace tyndall
