#include "tyndall/render/single_ray.h"

#include <algorithm>
#include <numbers>

#include "tyndall/medium/free_flight.h"
#include "tyndall/render/bsdf.h"
#include "tyndall/scene/emitter.h"

namespace tyndall {
namespace {

Spectrum vanishing(const Spectrum& depth) {
  return map(depth, [](double x) { return std::exp(-x); });
}

}  // namespace

SingleContext::Prepared::Prepared(const Scene& scene_, const Geometry& geometry_, const SingleSettings& settings_)
    : scene(scene_),
      geometry(geometry_),
      settings(settings_),
      medium(scene.medium, scene.time),
      shadows(scene),
      lamps(lamps_of(scene)),
      glow(scene),
      sky(scene.environment ? &*scene.environment : nullptr, settings.sky_suns),
      suns(suns_of(scene, settings.sun_rings, settings.sun_azimuth)) {
  suns.insert(suns.end(), sky.suns().begin(), sky.suns().end());
}

void SingleRay::set(const Ray& ray, double distance) {
  ray_ = ray;
  hit_ = context_.geometry.intersect(ray, distance);
  end_ = hit_ ? hit_->t : distance;
  cut_short_ = !hit_ && distance < infinity;
  medium_.set(context_.medium, ray, end_);
}

/// Transmittance of the way between two points, 0 where a surface is in it.
Spectrum SingleRay::open_way(const Vector& from, const Vector& to) {
  if (context_.geometry.occluded(from, to)) return {};
  return vanishing(depth_between(context_.medium.lowered, from, to, scratch_));
}
Spectrum SingleRay::open_way(const Ray& ray) {
  if (context_.geometry.occluded(ray)) return {};
  stretches_along(context_.medium.lowered, ray, infinity, scratch_);
  return vanishing(optical_depth(scratch_, infinity));
}

Spectrum SingleRay::surface(bool sources) {
  if (cut_short_) return {};
  const Spectrum through = transmittance();
  if (is_zero(through)) return {};
  Spectrum seen;
  if (hit_) {
    seen = reflected(*hit_, -ray_.direction);
    if (sources) seen += emitted(context_.geometry.scene(), *hit_->material, hit_->at, hit_->front);
  } else if (!sources) {
    seen = context_.sky.smooth(ray_.direction);
  } else {
    seen = context_.sky.radiance(ray_.direction);
    for (const SunLight& sun : context_.scene.suns) {
      // The disc has its irradiance spread over its solid angle; a parallel sun cannot be seen.
      const double sine = std::sin(0.25 * sun.angular_diameter * std::numbers::pi / 180.0), v = 2.0 * sine * sine;
      const Vector toward = -normalized(sun.direction);
      if (v > 0.0 && 0.5 * length_squared(ray_.direction - toward) <= v) {
        seen += sun.irradiance / (2.0 * std::numbers::pi * v);
      }
    }
  }
  return seen * through;
}

Spectrum SingleRay::reflected(const Hit& hit, const Vector& out) {
  const SurfacePoint surface = surface_point(context_.geometry, hit);
  const Vector start = context_.geometry.leave(hit.point, hit.geometric_normal);
  Spectrum sum;
  for (const SingleLamp& lamp : context_.lamps) {
    const Vector way = lamp.position - start;
    const double squared = length_squared(way);
    if (!(squared > 0.0)) continue;
    const Vector in = way / std::sqrt(squared);
    const Spectrum light = lamp.intensity * evaluate(surface, out, in) * (lamp.falloff(-in) / squared);
    if (!is_zero(light)) sum += light * open_way(start, lamp.position);
  }
  for (const SingleSun& sun : context_.suns) {
    const Spectrum light = sun.irradiance * evaluate(surface, out, sun.toward);
    if (!is_zero(light)) sum += light * open_way({start, sun.toward});
  }
  sum += reflected_glow(surface, start, out, sum);
  return sum + reflected_sky(surface, start, out);
}

Spectrum SingleRay::from_lamp(std::size_t index) { return from(context_.lamps[index], context_.settings.tolerance); }

Spectrum SingleRay::from(const SingleLamp& lamp, double tolerance) {
  if (medium_.empty()) return {};
  Interval range{0.0, medium_.reach()};
  if (lamp.shape == SingleLamp::Shape::spot || lamp.shape == SingleLamp::Shape::one_sided) {
    const bool spot = lamp.shape == SingleLamp::Shape::spot;
    range = intersection(
        range, cone_stretch(LampView::of(ray_, lamp.position), lamp.axis, spot ? lamp.spot.outer_angle : 90.0));
  }
  if (range.empty()) return {};
  const Wedge wedge = Wedge::toward_lamp(ray_, range, lamp.position);
  context_.shadows.lit(wedge, lit_);
  if (!wedge.flat && !context_.shadows.empty()) {
    // The lamp stands on the ray's line: no surface is on the ray itself, but there may be some between it and the
    // lamp.
    const bool behind_surface = hit_ && wedge.along >= end_;
    const Vector nearest = ray_.at(std::clamp(wedge.along, range.begin, range.end));
    if (behind_surface || context_.geometry.occluded(nearest, lamp.position)) lit_.clear();
  }
  return lamp_airlight(medium_, lamp, lit_, tolerance);
}

Spectrum SingleRay::from_direction(const Vector& toward, double tolerance) {
  const Wedge wedge = Wedge::toward_direction(ray_, {0.0, medium_.reach()}, toward);
  context_.shadows.lit(wedge, lit_);
  if (!wedge.flat && !context_.shadows.empty()) {
    const bool ahead = dot(toward, ray_.direction) > 0.0;
    const bool dark =
        ahead ? hit_.has_value() || context_.geometry.occluded(Ray{ray_.at(std::min(end_, medium_.reach())), toward})
              : context_.geometry.occluded(Ray{ray_.origin, toward});
    if (dark) lit_.clear();
  }
  return sun_airlight(medium_, toward, lit_, tolerance);
}

Spectrum SingleRay::from_sun(std::size_t index) {
  if (medium_.empty()) return {};
  const SingleSun& sun = context_.suns[index];
  return sun.irradiance * from_direction(sun.toward, context_.settings.tolerance);
}

Spectrum SingleRay::from_the_rest() {
  Spectrum sum = from_glow() + from_sky();
  for (std::size_t i = 0; i < context_.suns.size(); ++i) sum += from_sun(i);
  return sum;
}

}  // namespace tyndall
