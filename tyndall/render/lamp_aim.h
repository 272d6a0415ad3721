#pragma once
// Directions toward lamps, for paths that scatter once more before they reach one.
#include <numbers>
#include <vector>

#include "tyndall/medium/scatter.h"
#include "tyndall/render/path_lights.h"
#include "tyndall/render/quick_exp.h"

namespace tyndall {

/// From a point of a path: a lamp is chosen by how much light a segment from there could get of it, then a direction at
/// an angle from it that is uniform in [0, pi], whose density per steradian goes as 1/sin(angle) like the light itself.
class LampAim {
 public:
  LampAim() = default;
  /// At `from`. extinction: roughly, there [1/m]. tries: how often, in the mean, such a direction is drawn at all.
  LampAim(const std::vector<Lamp>& lamps, const Vector& from, double extinction, double tries)
      : from_(from), extinction_(extinction), tries_(tries) {
    for (const Lamp& lamp : lamps) total_ += worth(lamp);
  }
  double tries() const { return tries_; }

  std::size_t choose(const std::vector<Lamp>& lamps, double xi) const {
    double rest = xi * total_;
    std::size_t i = 0;
    for (; i + 1 < lamps.size(); ++i) {
      rest -= worth(lamps[i]);
      if (rest < 0.0) break;
    }
    return i;
  }

  /// The chance with which choose takes the lamp.
  double chance(const Lamp& lamp) const { return worth(lamp) / total_; }

  Vector direction(const Lamp& lamp, double xi1, double xi2) const {
    const double angle = std::numbers::pi * xi1;
    const Vector way = lamp.position - from_;
    const Vector axis = length_squared(way) > 0.0 ? normalized(way) : Vector{0.0, 1.0, 0.0};
    return normalized(around(Frame::around(axis), std::cos(angle), std::sin(angle), xi2));
  }

  /// Density [1/sr] of choosing the lamp and then the direction.
  double density(const Lamp& lamp, const Vector& direction) const {
    const Vector way = lamp.position - from_;
    if (length_squared(way) == 0.0) return 0.0;
    const double sine = std::max(deflection_between(normalized(way), direction).sine(), 1e-12);
    return chance(lamp) / (2.0 * std::numbers::pi * std::numbers::pi * sine);
  }

  /// A direction [unit] for a ray of the lamp: evenly over all in which it shines, and half of them, where those have
  /// the point among them, at an angle from it that is uniform, as direction() at the other end.
  Vector beam(const Lamp& lamp, double choice, double xi1, double xi2) const {
    if (choice >= around_share(lamp)) return lamp.sample_direction(xi1, xi2);
    const double angle = widest(lamp) * xi1;
    return normalized(around(Frame::around(normalized(from_ - lamp.position)), std::cos(angle), std::sin(angle), xi2));
  }
  /// Its density [1/sr], given the lamp. Directions in which the lamp does not shine count too.
  double beam_density(const Lamp& lamp, const Vector& travel) const {
    const double share = around_share(lamp), even = 1.0 / lamp.solid_angle();
    // Rounding must not put a ray at the cone's edge out of it.
    const bool shines = lamp.spot == nullptr ||
                        dot(lamp.axis, travel) >= std::cos(lamp.spot->outer_angle * std::numbers::pi / 180.0) - 1e-9;
    double density = shines ? (1.0 - share) * even : 0.0;
    if (share > 0.0) {
      const double most = widest(lamp);
      const Deflection<double> d = deflection_between(normalized(from_ - lamp.position), travel);
      const double sine = std::max(d.sine(), 1e-12);
      if (std::atan2(sine, d.mu) <= most) density += share / (2.0 * std::numbers::pi * most * sine);
    }
    return density;
  }

 private:
  double around_share(const Lamp& lamp) const {
    const Vector way = from_ - lamp.position;
    if (lamp.spot == nullptr || length_squared(way) == 0.0) return 0.0;
    const double cosine = std::cos(lamp.spot->outer_angle * std::numbers::pi / 180.0);
    return dot(lamp.axis, way) >= cosine * length(way) ? 0.5 : 0.0;
  }
  /// The angle that half of the rays keep to.
  static double widest(const Lamp& lamp) {
    return std::min(std::numbers::pi, 2.0 * lamp.spot->outer_angle * std::numbers::pi / 180.0);
  }

  /// Never zero, so that every lamp keeps a chance.
  double worth(const Lamp& lamp) const {
    const double distance = length(lamp.position - from_);
    return lamp.reach * quick_exp(-std::min(extinction_ * distance, 200.0)) / (distance + 1e-6) + 1e-300;
  }

  Vector from_;
  double extinction_ = 0.0, tries_ = 1.0, total_ = 0.0;
};

}  // namespace tyndall
