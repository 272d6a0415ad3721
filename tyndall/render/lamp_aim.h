#pragma once
// Directions toward lamps, for paths that scatter once more before they reach one.
#include <numbers>
#include <vector>

#include "tyndall/medium/scatter.h"
#include "tyndall/render/path_lights.h"

namespace tyndall {

/// From a point of a path: a lamp is chosen by how much light a segment from there could get of it, then a direction at
/// an angle from it that is uniform in [0, pi], whose density per steradian goes as 1/sin(angle) like the light itself.
class LampAim {
 public:
  LampAim() = default;
  /// extinction: roughly, at the point [1/m]. tries: how often, in the mean, such a direction is drawn at all.
  LampAim(double extinction, double tries) : extinction_(extinction), tries_(tries) {}
  double tries() const { return tries_; }

  std::size_t choose(const std::vector<Lamp>& lamps, const Vector& from, double xi) const {
    double rest = xi * total(lamps, from);
    std::size_t i = 0;
    for (; i + 1 < lamps.size(); ++i) {
      rest -= worth(lamps[i], from);
      if (rest < 0.0) break;
    }
    return i;
  }

  /// The chance with which choose takes the lamp.
  double chance(const std::vector<Lamp>& lamps, std::size_t lamp, const Vector& from) const {
    return worth(lamps[lamp], from) / total(lamps, from);
  }

  Vector direction(const Lamp& lamp, const Vector& from, double xi1, double xi2) const {
    const double angle = std::numbers::pi * xi1;
    const Vector way = lamp.position - from;
    const Vector axis = length_squared(way) > 0.0 ? normalized(way) : Vector{0.0, 1.0, 0.0};
    return normalized(around(Frame::around(axis), std::cos(angle), std::sin(angle), xi2));
  }

  /// Density [1/sr] of choosing `lamp` and then ray.direction at ray.origin.
  double density(const std::vector<Lamp>& lamps, std::size_t lamp, const Ray& ray) const {
    const Vector way = lamps[lamp].position - ray.origin;
    if (length_squared(way) == 0.0) return 0.0;
    const double sine = std::max(deflection_between(normalized(way), ray.direction).sine(), 1e-12);
    return chance(lamps, lamp, ray.origin) / (2.0 * std::numbers::pi * std::numbers::pi * sine);
  }

 private:
  /// Never zero, so that every lamp keeps a chance.
  double worth(const Lamp& lamp, const Vector& from) const {
    const double distance = length(lamp.position - from);
    double share = 1.0;  // a beam concerns fewer places, but not as few as it fills
    if (lamp.spot != nullptr) {
      share = std::sin(0.5 * std::min(90.0, lamp.spot->outer_angle) * std::numbers::pi /
                       180.0);  // root of its part of the sphere
    }
    return sum(lamp.intensity) * share * std::exp(-std::min(extinction_ * distance, 200.0)) / (distance + 1e-6) +
           1e-300;
  }
  double total(const std::vector<Lamp>& lamps, const Vector& from) const {
    double sum_of_all = 0.0;
    for (const Lamp& lamp : lamps) sum_of_all += worth(lamp, from);
    return sum_of_all;
  }

  double extinction_ = 0.0, tries_ = 1.0;
};

}  // namespace tyndall
