#pragma once
// How the path tracer samples light: lamps, the sun, the surroundings, emissive surfaces.
#include <numbers>
#include <vector>

#include "tyndall/sampling/direction.h"
#include "tyndall/sampling/random_stream.h"
#include "tyndall/scene/emitter.h"
#include "tyndall/scene/geometry.h"
#include "tyndall/scene/panorama_sampling.h"
#include "tyndall/scene/scene.h"

namespace tyndall {

/// A point or spot light.
struct Lamp {
  Vector position;
  Spectrum intensity;  // on the axis [W/sr]
  const SpotLight* spot = nullptr;
  Vector axis{0.0, -1.0, 0.0};    // unit; a point light's means nothing
  double reach = sum(intensity);  // how many places its light concerns, for comparison only

  /// Of all directions in which it shines [sr].
  double solid_angle() const {
    const double half = spot == nullptr ? 180.0 : spot->outer_angle;
    const double sine = std::sin(0.5 * half * std::numbers::pi / 180.0);
    return 4.0 * std::numbers::pi * sine * sine;
  }
  /// One of those directions; density 1 / solid_angle().
  Vector sample_direction(double xi1, double xi2) const {
    return normalized(sample_cone(Frame::around(axis), solid_angle() / (2.0 * std::numbers::pi), xi1, xi2));
  }
  /// Intensity of the light that travels in unit direction `travel`.
  Spectrum intensity_toward(const Vector& travel) const {
    return spot == nullptr ? intensity : intensity * spot_falloff(*spot, dot(axis, travel));
  }
};

/// A direction toward light. `density` [1/sr] is the chance of sampling it, 0 when there is nothing; for the sun
/// (sampled alone, never met by chance) radiance is already divided by it.
struct LightSample {
  Vector direction;
  double distance = infinity;
  Spectrum radiance;
  double density = 0.0;
};

/// A lamp chosen for a surface: what it reflects before visibility, and the chance of the choice (0: nothing to see).
struct LampSample {
  std::size_t lamp = 0;
  Spectrum reflected;
  double density = 0.0;
};

/// 2 pi (1 - cos) of a sun's disc [sr]; 0 for parallel light.
double sun_solid_angle(const SunLight& sun);
/// A direction toward the sun; radiance is the irradiance of a surface facing it.
LightSample sample_sun(const SunLight& sun, double xi1, double xi2);
/// Radiance of the sun's disc seen in `direction`; 0 beside it and for parallel light.
Spectrum sun_disc(const SunLight& sun, const Vector& direction);

class PathLights {
 public:
  explicit PathLights(const Scene& scene);

  std::vector<Lamp> lamps;
  std::vector<SunLight> suns;

  /// Chooses a lamp for a surface point, in proportion to what it reflects if nothing is in the way. reflect(direction)
  /// is radiance per irradiance for light from a unit direction.
  template <class Reflect>
  LampSample sample_lamp(const Vector& point, double xi, Reflect reflect) const {
    // One pass: each lamp replaces the chosen one with the chance of its share so far, which reuses one random number.
    LampSample chosen;
    double total = 0.0, share_of_chosen = 0.0;
    for (std::size_t i = 0; i < lamps.size(); ++i) {
      const Lamp& lamp = lamps[i];
      const Vector way = point - lamp.position;
      const double squared = length_squared(way);
      if (squared == 0.0) continue;
      const Vector travel = way / std::sqrt(squared);
      const Spectrum intensity = lamp.intensity_toward(travel);
      if (is_zero(intensity)) continue;
      const Spectrum reflected = reflect(-travel) * intensity / squared;
      const double share = sum(reflected);
      if (!(share > 0.0)) continue;
      total += share;
      const double chance = share / total;
      if (xi < chance) {
        chosen = {i, reflected, 0.0};
        share_of_chosen = share;
        xi = xi / chance;
      } else {
        xi = (xi - chance) / (1.0 - chance);
      }
    }
    if (total > 0.0) chosen.density = share_of_chosen / total;
    return chosen;
  }
  LightSample sample_environment(RandomStream& random) const;
  LightSample sample_emitter(const Vector& point, RandomStream& random) const;

  /// How much light there is to be had around a point, roughly and for comparison only: lamps as in a diffusing medium,
  /// power over distance; what shines everywhere is the same everywhere.
  double promise_at(const Vector& point) const;

  /// Whether the surroundings shine alike from all sides: no direction is then better than what a phase function likes.
  bool even_environment() const { return surroundings_ != nullptr && !surroundings_->panorama; }
  Spectrum environment(const Vector& direction) const;
  double environment_density(const Vector& direction) const;
  /// Radiance that a surface emits toward the side it was met from.
  Spectrum emission(const Hit& hit) const;
  /// Density [1/sr] with which sample_emitter, from ray.origin, gives the point that the ray has hit.
  double emitter_density(const Hit& hit, const Ray& ray) const;

 private:
  const Scene& scene_;
  const EnvironmentLight* surroundings_;
  PanoramaSampler panorama_;
  Emitters emitters_;
  double everywhere_ = 0.0;  // promise of sun, surroundings and emissive surfaces
  double reach_ = 1.0;       // distance within which a lamp's promise is even [m]
};

}  // namespace tyndall
