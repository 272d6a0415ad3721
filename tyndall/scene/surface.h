#pragma once
// What a material is like at one place of a surface: its numbers times its maps.
#include "tyndall/scene/scene.h"

namespace tyndall {

/// A place on a triangle.
struct SurfacePlace {
  std::size_t mesh = 0, triangle = 0;
  double u = 0.0, v = 0.0;  // barycentric weights of the triangle's second and third vertex, in [0, 1]
};

/// A map's colour; white where there is no map or no coordinates. Bilinear, by glTF's convention: (0, 0) is the outer
/// corner of the first texel of the top row.
Spectrum map_color(const Scene& scene, const Map& map, const SurfacePlace& at);

/// Base colour, linear.
inline Spectrum base_color_at(const Scene& scene, const Material& material, const SurfacePlace& at) {
  return material.base_color * map_color(scene, material.color_map, at);
}
/// Radiance of an emitting side [W/(m^2 sr)].
inline Spectrum emission_at(const Scene& scene, const Material& material, const SurfacePlace& at) {
  return material.emission * map_color(scene, material.emission_map, at);
}
/// Radiance that leaves the front or the back.
inline Spectrum emitted(const Scene& scene, const Material& material, const SurfacePlace& at, bool front) {
  return front || material.double_sided ? emission_at(scene, material, at) : Spectrum{};
}
/// Alpha in [0, 1], whatever the mode makes of it.
double alpha_at(const Scene& scene, const Material& material, const SurfacePlace& at);

/// The unit normal that a material's normal map makes of a unit normal on the front side. Tangents are the mesh's or
/// follow the map's coordinates; the normal stays as it is where there are neither.
Vector mapped_normal(const Scene& scene, const Material& material, const SurfacePlace& at, const Vector& normal);

}  // namespace tyndall
