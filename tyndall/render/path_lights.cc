#include "tyndall/render/path_lights.h"

#include <numbers>

namespace tyndall {
namespace {

double one_minus_cos(const SunLight& sun) {
  const double half = 0.25 * sun.angular_diameter * std::numbers::pi / 180.0;  // half of the disc's half angle
  return 2.0 * std::sin(half) * std::sin(half);
}

/// Whether air without end lets nothing in from infinitely far.
bool is_endless(const Medium& medium) {
  Spectrum extinction;
  for (const Species& species : medium.species) {
    if (species.profiles.empty()) extinction += species.extinction();
  }
  return std::min({extinction[0], extinction[1], extinction[2]}) > 0.0;
}

}  // namespace

double sun_solid_angle(const SunLight& sun) { return 2.0 * std::numbers::pi * one_minus_cos(sun); }

LightSample sample_sun(const SunLight& sun, double xi1, double xi2) {
  const Vector toward = -normalized(sun.direction);
  if (sun.angular_diameter == 0.0) return {toward, infinity, sun.irradiance, 1.0};
  return {normalized(sample_cone(Frame::around(toward), one_minus_cos(sun), xi1, xi2)), infinity, sun.irradiance, 1.0};
}

Spectrum sun_disc(const SunLight& sun, const Vector& direction) {
  const Vector toward = -normalized(sun.direction);
  if (sun.angular_diameter == 0.0 || 0.5 * length_squared(direction - toward) > one_minus_cos(sun)) return {};
  return sun.irradiance / sun_solid_angle(sun);
}

PathLights::PathLights(const Scene& scene)
    : suns(is_endless(scene.medium) ? std::vector<SunLight>{} : scene.suns),
      scene_(scene),
      surroundings_(scene.environment && !is_endless(scene.medium) ? &*scene.environment : nullptr),
      panorama_(surroundings_),
      emitters_(scene) {
  for (const PointLight& point : scene.points) lamps.push_back({point.position, point.intensity});
  for (const SpotLight& spot : scene.spots) {
    lamps.push_back({spot.position, spot.intensity, &spot, normalized(spot.direction)});
    // A beam concerns fewer places, but not as few as it fills: the root of its part of the sphere.
    lamps.back().reach *= std::sin(0.5 * std::min(90.0, spot.outer_angle) * std::numbers::pi / 180.0);
  }
  // Within a mean free path of a lamp its light is much the same; an extinction of the whole scene is good enough here.
  Spectrum extinction;
  for (const Species& species : scene.medium.species) extinction += species.extinction();
  if (largest(extinction) > 0.0) reach_ = 1.0 / largest(extinction);
  const double sphere = 4.0 * std::numbers::pi;
  for (const SunLight& sun : suns) everywhere_ += sum(sun.irradiance);
  if (!panorama_.empty()) {
    for (const Vector& d : {Vector{0, 1, 0}, {0, -1, 0}, {1, 0, 0}, {-1, 0, 0}, {0, 0, 1}, {0, 0, -1}}) {
      everywhere_ += sum(environment(d)) * sphere / 6.0;
    }
  }
  everywhere_ += sum(emitters_.power()) / (reach_ * reach_);
}

double PathLights::promise_at(const Vector& point) const {
  double promise = everywhere_ + 1e-300;
  for (const Lamp& lamp : lamps) {
    promise += sum(lamp.intensity) * lamp.solid_angle() / (reach_ * (reach_ + length(point - lamp.position)));
  }
  return promise;
}

LightSample PathLights::sample_environment(RandomStream& random) const {
  if (panorama_.empty()) return {};
  const double u = random.next();
  const DirectionSample sample = panorama_.sample(u, random.next());
  return {sample.direction, infinity, sample.radiance, sample.density};
}

LightSample PathLights::sample_emitter(const Vector& point, RandomStream& random) const {
  if (emitters_.empty()) return {};
  const double choice = random.next(), u = random.next();
  const EmitterSample sample = emitters_.sample(choice, u, random.next());
  const Vector way = sample.point - point;
  const double squared = length_squared(way), distance = std::sqrt(squared);
  if (squared == 0.0) return {};
  const Vector direction = way / distance;
  const Spectrum radiance = sample.radiance_toward(-direction);
  const double facing = std::fabs(dot(sample.emitter->normal, direction));
  if (is_zero(radiance) || facing == 0.0) return {};
  // Just short of the emitter, which must not shadow itself.
  return {direction, distance * (1.0 - 1e-6), radiance, sample.density * squared / facing};
}

Spectrum PathLights::environment(const Vector& direction) const {
  return surroundings_ == nullptr ? Spectrum{} : radiance(*surroundings_, direction);
}

double PathLights::environment_density(const Vector& direction) const {
  return panorama_.empty() ? 0.0 : panorama_.density(direction);
}

Spectrum PathLights::emission(const Hit& hit) const { return emitted(scene_, *hit.material, hit.at, hit.front); }

double PathLights::emitter_density(const Hit& hit, const Ray& ray) const {
  const double facing = std::fabs(dot(hit.geometric_normal, ray.direction));
  return facing > 0.0 ? emitters_.density(hit.at.mesh, hit.at.triangle) * hit.t * hit.t / facing : 0.0;
}

}  // namespace tyndall
