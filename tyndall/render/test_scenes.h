#pragma once
// Small scenes for tests, made in code.
#include "tyndall/scene/scene.h"

namespace tyndall::tests {

inline Medium medium_of(const Spectrum& scattering, const Spectrum& absorption, const Law<double>& law,
                        std::vector<Profile> profiles = {}) {
  return {{{"", scattering, absorption, law, std::move(profiles)}}};
}

/// Adds a parallelogram with corner a and edges u, v; its front is on the side of u x v.
inline void add_quad(Scene& scene, const Vector& a, const Vector& u, const Vector& v, int material = -1) {
  const auto corner = [](const Vector& p) {
    return std::array<float, 3>{static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
  };
  Mesh mesh;
  mesh.positions = {corner(a), corner(a + u), corner(a + u + v), corner(a + v)};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.material = material;
  scene.meshes.push_back(std::move(mesh));
}

inline int add_material(Scene& scene, const Spectrum& base_color, const Spectrum& emission = {}, double roughness = 1.0,
                        double metallic = 0.0) {
  Material material;
  material.base_color = base_color;
  material.emission = emission;
  material.metallic = metallic;
  material.roughness = roughness;
  scene.materials.push_back(material);
  return static_cast<int>(scene.materials.size()) - 1;
}

/// Everything at once: a floor and a wall, an emissive panel, a lamp, a spot, a sun, a sky, a thin chromatic global
/// haze that thins with height, a box and a sphere of fog that overlap.
inline Scene busy_scene() {
  Scene scene;
  const int matte = add_material(scene, {{0.6, 0.5, 0.4}}), glossy = add_material(scene, {{0.3, 0.4, 0.5}}, {}, 0.4);
  const int panel = add_material(scene, Spectrum::grey(0.0), {{4.0, 3.0, 2.0}});
  add_quad(scene, {-5, 0, 5}, {10, 0, 0}, {0, 0, -10}, matte);
  add_quad(scene, {-5, 0, -5}, {10, 0, 0}, {0, 5, 0}, glossy);
  add_quad(scene, {-1, 3, -2}, {1, 0, 0}, {0, 0, 1}, panel);
  scene.points.push_back({{2, 2, -1}, {{3.0, 2.0, 1.0}}});
  scene.spots.push_back({{-3, 4, 0}, {0.5, -1, -0.2}, Spectrum::grey(8.0), 10, 25});
  scene.suns.push_back({{0.3, -1, -0.5}, Spectrum::grey(0.5), 0.5});
  scene.environment = EnvironmentLight{};
  scene.environment->radiance = {{0.1, 0.15, 0.25}};
  const auto add = [&](const Medium& m) {
    scene.medium.species.insert(scene.medium.species.end(), m.species.begin(), m.species.end());
  };
  add(medium_of({{0.01, 0.02, 0.05}}, {}, Rayleigh<double>{}, {ExponentialProfile{2.0, 0.0}}));
  add(medium_of(Spectrum::grey(0.4), Spectrum::grey(0.02), HenyeyGreenstein<double>{0.8},
                {BoxProfile{{-2, 0, -3}, {1, 2, 1}}}));
  add(medium_of({{0.2, 0.3, 0.6}}, {}, MieMurky<double>{}, {SphereProfile{{0.5, 1, -1}, 1.2}}));
  scene.camera = {{0, 1.5, 6}, {0, 1.2, 0}, {0, 1, 0}, 45.0};
  scene.film = {48, 32};
  return scene;
}

/// A closed box 4 m wide, with air, that a sun shines into through a small window: nearly all of what a path sees there
/// is sunlight it meets by luck.
inline Scene dark_room() {
  Scene scene;
  const int wall = add_material(scene, {{0.7, 0.6, 0.5}}), floor = add_material(scene, {{0.5, 0.5, 0.6}}, {}, 0.3);
  add_quad(scene, {-2, 0, 2}, {4, 0, 0}, {0, 0, -4}, floor);
  add_quad(scene, {-2, 3, 2}, {4, 0, 0}, {0, 0, -4}, wall);
  add_quad(scene, {-2, 0, -2}, {4, 0, 0}, {0, 3, 0}, wall);
  add_quad(scene, {-2, 0, 2}, {4, 0, 0}, {0, 3, 0}, wall);
  add_quad(scene, {2, 0, -2}, {0, 3, 0}, {0, 0, 4}, wall);
  for (const double z : {-2.0, 0.3}) add_quad(scene, {-2, 0, z}, {0, 3, 0}, {0, 0, 1.7}, wall);
  add_quad(scene, {-2, 0, -0.3}, {0, 1.5, 0}, {0, 0, 0.6}, wall);
  add_quad(scene, {-2, 2.1, -0.3}, {0, 0.9, 0}, {0, 0, 0.6}, wall);
  scene.suns.push_back({{1.0, -0.7, 0.2}, {{20.0, 18.0, 15.0}}, 0.5});
  scene.medium = medium_of({{0.1, 0.15, 0.2}}, Spectrum::grey(0.01), HenyeyGreenstein<double>{0.6},
                           {BoxProfile{{-2.5, -0.5, -2.5}, {2.5, 3.5, 2.5}}});
  scene.camera = {{1.8, 1.5, 1.8}, {-1.0, 0.5, -2.0}, {0, 1, 0}, 60.0};
  scene.film = {24, 16};
  return scene;
}

}  // namespace tyndall::tests
