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
  double alpha = 1.0;                    // squared roughness, clamped away from a mirror
  double dielectric_reflectance = 0.04;  // of what is no metal, at normal incidence
};

inline SurfacePoint surface_point(const Geometry& geometry, const Hit& hit) {
  const Material& material = *hit.material;
  const Spectrum map = map_color(geometry.scene(), material.roughness_map, hit.at);
  const double roughness = std::clamp(material.roughness * map[1], 0.03, 1.0);
  const double ratio = (material.ior - 1.0) / (material.ior + 1.0);
  return {hit.point,
          hit.geometric_normal,
          Frame::around(hit.shading_normal),
          base_color_at(geometry.scene(), material, hit.at),
          material.metallic * map[2],
          roughness * roughness,
          ratio * ratio};
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

/// Reflectance at normal incidence: Fresnel's for dielectrics, the base colour for metals.
inline Spectrum normal_reflectance(const SurfacePoint& s) {
  return Spectrum::grey(s.dielectric_reflectance * (1.0 - s.metallic)) + s.base_color * s.metallic;
}
/// Schlick's Fresnel factor for normal reflectance f0.
inline Spectrum fresnel(const Spectrum& f0, double cosine) {
  const double m = 1.0 - std::clamp(cosine, 0.0, 1.0), m5 = m * m * m * m * m;
  return f0 + (Spectrum::grey(1.0) - f0) * m5;
}
inline Spectrum fresnel(const SurfacePoint& s, double cosine) { return fresnel(normal_reflectance(s), cosine); }

/// A surface point seen from one direction: what depends on that direction is computed once for all lights.
class Reflection {
 public:
  /// out: unit vector that leaves the surface toward the viewer.
  Reflection(const SurfacePoint& surface, const Vector& out)
      : s_(surface), out_(surface.frame.to_local(out)), visible_(dot(s_.geometric_normal, out) > 0.0 && out_.z > 0.0) {
    if (out_.z <= 0.0) return;
    f0_ = normal_reflectance(s_);
    lambda_ = smith_lambda(s_.alpha, out_.z);
    const Spectrum mirrored = fresnel(f0_, out_.z);
    diffuse_ = (Spectrum::grey(1.0) - mirrored) * s_.base_color * ((1.0 - s_.metallic) / std::numbers::pi);
    const double glossy = mean(mirrored), matte = mean(s_.base_color) * (1.0 - s_.metallic) * (1.0 - glossy);
    glossy_ = glossy + matte > 0.0 ? std::clamp(glossy / (glossy + matte), 0.1, 1.0) : 1.0;
  }

  /// Reflected radiance per irradiance, times the cosine: f(out, in) |cos(in)| [1/sr], for a unit vector that leaves
  /// the surface toward the light; 0 when the directions are on different sides.
  Spectrum evaluate(const Vector& in) const {
    if (!visible_ || dot(s_.geometric_normal, in) <= 0.0) return {};
    const Vector i = s_.frame.to_local(in);
    if (i.z <= 0.0) return {};
    const Vector half = normalized(out_ + i);
    const double shadowing = 1.0 / (1.0 + lambda_ + smith_lambda(s_.alpha, i.z));
    const double specular = facet_density(s_.alpha, half.z) * shadowing / (4.0 * out_.z);
    // What enters and leaves the body passes the surface twice. (The specification's example weighs with 1 - F(out .
    // half) alone, which at grazing angles makes up to half again as much light as arrives.)
    return fresnel(f0_, dot(out_, half)) * specular + (Spectrum::grey(1.0) - fresnel(f0_, i.z)) * diffuse_ * i.z;
  }

  /// Density [1/sr] with which sample returns `in`.
  double density(const Vector& in) const {
    const Vector i = s_.frame.to_local(in);
    if (out_.z <= 0.0 || i.z <= 0.0) return 0.0;
    const Vector half = normalized(out_ + i);
    // Visible normals (Heitz 2018): D(h) / (4 cos(out) (1 + Lambda(out))).
    const double facets = facet_density(s_.alpha, half.z) / (4.0 * out_.z * (1.0 + lambda_));
    return glossy_ * facets + (1.0 - glossy_) * i.z / std::numbers::pi;
  }

  /// Chance of the glossy lobe in sample.
  double glossy_chance() const { return glossy_; }

  /// A direction for light to come from, given three random numbers: the glossy lobe or the diffuse one, by their
  /// estimated albedos. It may point below the surface: evaluate is then 0.
  Vector sample(double choice, double xi1, double xi2) const {
    if (out_.z <= 0.0 || choice >= glossy_) return sample_cosine(s_.frame, xi1, xi2);
    // Visible normals of the stretched hemisphere (Heitz 2018, section 3).
    const Vector stretched = normalized({s_.alpha * out_.x, s_.alpha * out_.y, out_.z});
    const double across = stretched.x * stretched.x + stretched.y * stretched.y;
    const Vector t1 = across > 0.0 ? Vector{-stretched.y, stretched.x, 0.0} / std::sqrt(across) : Vector{1.0, 0.0, 0.0};
    const Vector t2 = cross(stretched, t1);
    const double radius = std::sqrt(xi1), azimuth = 2.0 * std::numbers::pi * xi2;
    const double p1 = radius * std::cos(azimuth), lift = 0.5 * (1.0 + stretched.z);
    const double p2 = (1.0 - lift) * std::sqrt(1.0 - p1 * p1) + lift * radius * std::sin(azimuth);
    const Vector n = t1 * p1 + t2 * p2 + stretched * std::sqrt(std::max(0.0, 1.0 - p1 * p1 - p2 * p2));
    const Vector half = normalized({s_.alpha * n.x, s_.alpha * n.y, std::max(1e-9, n.z)});
    return s_.frame.to_world(half * (2.0 * dot(out_, half)) - out_);
  }

 private:
  SurfacePoint s_;
  Vector out_;  // in the surface's frame
  bool visible_;
  Spectrum f0_, diffuse_;  // diffuse_: of a body seen through the surface, per cosine and sr
  double lambda_ = 0.0, glossy_ = 1.0;
};

/// Reflection(s, out).evaluate(in), for a single light.
inline Spectrum evaluate(const SurfacePoint& s, const Vector& out, const Vector& in) {
  return Reflection(s, out).evaluate(in);
}
inline double direction_density(const SurfacePoint& s, const Vector& out, const Vector& in) {
  return Reflection(s, out).density(in);
}
inline Vector sample_direction(const SurfacePoint& s, const Vector& out, double choice, double xi1, double xi2) {
  return Reflection(s, out).sample(choice, xi1, xi2);
}
inline double glossy_chance(const SurfacePoint& s, double out_cosine) {
  return Reflection(s, s.frame.to_world({std::sqrt(std::max(0.0, 1.0 - out_cosine * out_cosine)), 0.0, out_cosine}))
      .glossy_chance();
}

}  // namespace tyndall
