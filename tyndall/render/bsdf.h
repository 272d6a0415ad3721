#pragma once
// How surfaces reflect: glTF 2.0's metallic-roughness model (specification, appendix B), for evaluation and sampling.
#include <algorithm>
#include <numbers>

#include "tyndall/sampling/direction.h"
#include "tyndall/scene/geometry.h"

namespace tyndall {

/// A surface point ready for shading; normals are unit vectors on the side of the viewer.
struct SurfacePoint {
  Vector position, geometric_normal;
  Frame frame;  // around the shading normal
  Spectrum base_color;
  double metallic = 0.0;
  double alpha = 1.0;  // squared roughness, clamped away from a mirror
};

inline SurfacePoint surface_point(const Geometry& geometry, const Hit& hit) {
  const double roughness = std::clamp(hit.material->roughness, 0.03, 1.0);
  return {hit.point,
          hit.geometric_normal,
          Frame::around(hit.shading_normal),
          geometry.base_color(hit),
          hit.material->metallic,
          roughness * roughness};
}

/// Schlick's Fresnel factor for normal reflectance f0 (0.04 for dielectrics, the base colour for metals).
inline Spectrum fresnel(const SurfacePoint& s, double cosine) {
  const double m = 1.0 - std::clamp(cosine, 0.0, 1.0), m5 = m * m * m * m * m;
  const Spectrum f0 = Spectrum::grey(0.04 * (1.0 - s.metallic)) + s.base_color * s.metallic;
  return f0 + (Spectrum::grey(1.0) - f0) * m5;
}

/// Trowbridge-Reitz distribution of microfacet normals for squared cosine c2 (Walter et al. 2007, eq. 33).
inline double facet_density(double alpha, double cosine) {
  const double a2 = alpha * alpha, d = cosine * cosine * (a2 - 1.0) + 1.0;
  return a2 / (std::numbers::pi * d * d);
}
/// Smith's Lambda of the same distribution (Heitz 2014, eq. 72).
inline double smith_lambda(double alpha, double cosine) {
  const double c2 = cosine * cosine, tangent2 = (1.0 - c2) / c2;
  return 0.5 * (std::sqrt(1.0 + alpha * alpha * tangent2) - 1.0);
}

/// Reflected radiance per irradiance, times the cosine: f(out, in) |cos(in)| [1/sr]. Both directions are unit vectors
/// that leave the surface; 0 when they are on different sides.
inline Spectrum evaluate(const SurfacePoint& s, const Vector& out, const Vector& in) {
  if (dot(s.geometric_normal, out) <= 0.0 || dot(s.geometric_normal, in) <= 0.0) return {};
  const Vector o = s.frame.to_local(out), i = s.frame.to_local(in);
  if (o.z <= 0.0 || i.z <= 0.0) return {};
  const Vector half = normalized(o + i);
  const Spectrum reflected = fresnel(s, dot(o, half));
  const double shadowing = 1.0 / (1.0 + smith_lambda(s.alpha, o.z) + smith_lambda(s.alpha, i.z));
  const double specular = facet_density(s.alpha, half.z) * shadowing / (4.0 * o.z);
  // What enters and leaves the body passes the surface twice. (The specification's example weighs with 1 - F(out .
  // half) alone, which at grazing angles makes up to half again as much light as arrives.)
  const Spectrum one = Spectrum::grey(1.0), passed = (one - fresnel(s, o.z)) * (one - fresnel(s, i.z));
  const Spectrum diffuse = s.base_color * ((1.0 - s.metallic) / std::numbers::pi * i.z);
  return reflected * specular + passed * diffuse;
}

/// Chance of sampling the glossy lobe rather than the diffuse one, from their estimated albedos.
inline double glossy_chance(const SurfacePoint& s, double out_cosine) {
  const double glossy = mean(fresnel(s, out_cosine)), matte = mean(s.base_color) * (1.0 - s.metallic) * (1.0 - glossy);
  return glossy + matte > 0.0 ? std::clamp(glossy / (glossy + matte), 0.1, 1.0) : 1.0;
}

/// Density [1/sr] with which sample_direction returns `in`.
inline double direction_density(const SurfacePoint& s, const Vector& out, const Vector& in) {
  const Vector o = s.frame.to_local(out), i = s.frame.to_local(in);
  if (o.z <= 0.0 || i.z <= 0.0) return 0.0;
  const double glossy = glossy_chance(s, o.z);
  const Vector half = normalized(o + i);
  // Visible normals (Heitz 2018): D(h) / (4 cos(out) (1 + Lambda(out))).
  const double facets = facet_density(s.alpha, half.z) / (4.0 * o.z * (1.0 + smith_lambda(s.alpha, o.z)));
  return glossy * facets + (1.0 - glossy) * i.z / std::numbers::pi;
}

/// A direction for light to come from, given three random numbers. It may point below the surface: evaluate is then 0.
inline Vector sample_direction(const SurfacePoint& s, const Vector& out, double choice, double xi1, double xi2) {
  const Vector o = s.frame.to_local(out);
  if (o.z <= 0.0 || choice >= glossy_chance(s, o.z)) return sample_cosine(s.frame, xi1, xi2);
  // Visible normals of the stretched hemisphere (Heitz 2018, section 3).
  const Vector stretched = normalized({s.alpha * o.x, s.alpha * o.y, o.z});
  const double across = stretched.x * stretched.x + stretched.y * stretched.y;
  const Vector t1 = across > 0.0 ? Vector{-stretched.y, stretched.x, 0.0} / std::sqrt(across) : Vector{1.0, 0.0, 0.0};
  const Vector t2 = cross(stretched, t1);
  const double radius = std::sqrt(xi1), azimuth = 2.0 * std::numbers::pi * xi2;
  const double p1 = radius * std::cos(azimuth), lift = 0.5 * (1.0 + stretched.z);
  const double p2 = (1.0 - lift) * std::sqrt(1.0 - p1 * p1) + lift * radius * std::sin(azimuth);
  const Vector n = t1 * p1 + t2 * p2 + stretched * std::sqrt(std::max(0.0, 1.0 - p1 * p1 - p2 * p2));
  const Vector half = normalized({s.alpha * n.x, s.alpha * n.y, std::max(1e-9, n.z)});
  return s.frame.to_world(half * (2.0 * dot(o, half)) - o);
}

}  // namespace tyndall
