#pragma once
// Airlight of spot lights: where a ray crosses the cones, and how bright the beam is there.
#include <vector>

#include "tyndall/light/airlight_closed.h"
#include "tyndall/light/light.h"

namespace tyndall {

/// A lamp beside a ray, with the plane they span: `normal` is the unit vector from the ray to the lamp, any
/// perpendicular one when the lamp stands on the ray.
struct LampView {
  LampAside place;
  Vector direction, normal;  // of the ray; across it

  static LampView of(const Ray& ray, const Vector& lamp) {
    const Vector offset = lamp - ray.origin;
    const double along = dot(offset, ray.direction);
    Vector across = offset - ray.direction * along;
    across = across - ray.direction * dot(across, ray.direction);  // once more: perpendicular even if tiny
    const double aside = length(across);
    return {{along, aside}, ray.direction, aside > 0.0 ? across / aside : Frame::around(ray.direction).tangent};
  }
  /// From the lamp toward the point of the ray whose scattering deflects by d: -mu direction - sine normal.
  Vector toward(const Deflection<double>& d) const { return direction * -d.mu - normal * d.sine(); }
};

/// The t at which the ray is inside the cone of half angle `half_angle` (degrees, 0 to 90) around `axis` (unit) with
/// its apex at the lamp: one stretch at most, since a cone is convex; it may reach to -+infinity. Empty is begin >=
/// end. The plane of ray and lamp goes through the apex and so cuts the cone in two straight edges: no quadratic to
/// solve, and far, narrow cones keep their digits.
inline Interval cone_stretch(const LampView& lamp, const Vector& axis, double half_angle) {
  const double angle = half_angle * std::numbers::pi / 180.0;
  const double cosine = half_angle < 90.0 ? std::cos(angle) : 0.0, sine = half_angle < 90.0 ? std::sin(angle) : 1.0;
  const double across = dot(axis, cross(lamp.direction, lamp.normal));
  const Interval nothing{0.0, 0.0};
  if (std::fabs(across) > sine) return nothing;  // the plane passes beside the cone
  // The axis in the plane, forward along the ray and down to it, turned by the sector's half angle either way: its
  // tangent is root / cosine.
  const double root = std::sqrt((sine - across) * (sine + across));
  const double forward = dot(axis, lamp.direction), down = -dot(axis, lamp.normal);
  const double upper_forward = forward * cosine + down * root, upper_down = down * cosine - forward * root;
  const double lower_forward = forward * cosine - down * root, lower_down = down * cosine + forward * root;
  const double h = lamp.place.aside, a = lamp.place.along;
  if (lower_down > 0.0 && upper_down > 0.0) {
    return {a + h * (lower_forward / lower_down), a + h * (upper_forward / upper_down)};
  }
  if (lower_down > 0.0) return {a + h * (lower_forward / lower_down), infinity};
  if (upper_down > 0.0) return {-infinity, a + h * (upper_forward / upper_down)};
  const bool half_space = lower_down == 0.0 && upper_down == 0.0 && down > 0.0;
  return half_space ? Interval{-infinity, infinity} : nothing;
}

/// A spot's falloff along a ray, as a function of the deflection (see AirlightStretch).
struct SpotFalloff {
  double axis_along, axis_aside;  // of the spot's axis, in the plane of ray and lamp
  double inner, outer;            // cosines

  SpotFalloff(const LampView& lamp, const SpotLight& spot, const Vector& axis)
      : axis_along(dot(axis, lamp.direction)),
        axis_aside(dot(axis, lamp.normal)),
        inner(std::cos(spot.inner_angle * std::numbers::pi / 180.0)),
        outer(std::cos(spot.outer_angle * std::numbers::pi / 180.0)) {}

  double operator()(const Deflection<double>& d) const {
    const double cosine = -d.mu * axis_along - d.sine() * axis_aside;
    if (cosine >= inner) return 1.0;
    if (cosine <= outer) return 0.0;
    const double ramp = (cosine - outer) / (inner - outer);
    return ramp * ramp;
  }
};

/// A stretch of a ray with one smooth text of the falloff.
struct BeamPart {
  Interval stretch;
  bool full = true;  // inside the inner cone: falloff 1
};

/// Appends what `lit` has in common with a spot's beam: up to three parts, broken at inner and outer cone.
inline void beam_parts(const LampView& lamp, const SpotLight& spot, const Vector& axis, const Interval& lit,
                       std::vector<BeamPart>& parts) {
  const auto add = [&](const Interval& part, bool full) {
    if (part.begin < part.end) parts.push_back({part, full});
  };
  const Interval outer = intersection(lit, cone_stretch(lamp, axis, spot.outer_angle));
  if (!(outer.begin < outer.end)) return;
  if (spot.inner_angle >= spot.outer_angle) {
    add(outer, true);
    return;
  }
  const Interval inner = intersection(outer, cone_stretch(lamp, axis, spot.inner_angle));
  if (!(inner.begin < inner.end)) {
    add(outer, false);
    return;
  }
  add({outer.begin, inner.begin}, false);
  add(inner, true);
  add({inner.end, outer.end}, false);
}

/// airlight() of a point light: radiance [W/(m^2 sr)] scattered into the origin of the ray from the stretch `lit`.
inline Spectrum airlight(std::span<const ScatteringLobe> lobes, const Spectrum& extinction, const Ray& ray,
                         const PointLight& light, const Interval& lit) {
  return light.intensity * airlight(lobes, extinction, LampAside::of(ray, light.position), lit);
}

/// airlight() of a spot light, hard-edged or smooth.
inline Spectrum airlight(std::span<const ScatteringLobe> lobes, const Spectrum& extinction, const Ray& ray,
                         const SpotLight& spot, const Interval& lit) {
  const LampView lamp = LampView::of(ray, spot.position);
  const Vector axis = normalized(spot.direction);
  std::vector<BeamPart> parts;
  beam_parts(lamp, spot, axis, lit, parts);
  Spectrum sum;
  for (const BeamPart& part : parts) {
    sum += part.full ? airlight(lobes, extinction, lamp.place, part.stretch)
                     : airlight_by_panels(lobes, extinction, AirlightStretch::of(lamp.place, part.stretch),
                                          SpotFalloff(lamp, spot, axis));
  }
  return spot.intensity * sum;
}

}  // namespace tyndall
