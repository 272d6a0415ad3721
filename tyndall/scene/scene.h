#pragma once
// A scene as loaded: everything in metres and world space, nothing left of the files it came from.
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tyndall/light/light.h"
#include "tyndall/medium/medium.h"

namespace tyndall {

/// What a texture shows beyond its edges.
enum class Wrap { repeat, mirror, clamp };

/// Linear base colours, row-major, top row first; values in [0, 1].
struct Texture {
  int width = 0, height = 0;
  std::vector<std::array<float, 3>> color;
  Wrap wrap_u = Wrap::repeat, wrap_v = Wrap::repeat;
};

/// glTF's metallic-roughness material. emission is radiance [W/(m^2 sr)], strength included.
struct Material {
  std::string name;
  Spectrum base_color = Spectrum::grey(1.0);
  int base_color_texture = -1;  // in Scene::textures, -1 for none
  double metallic = 1.0, roughness = 1.0;
  Spectrum emission;
  bool double_sided = false;  // emission leaves a single-sided material on its front (counter-clockwise) face only
};

/// Triangles of one material; normals and uvs are empty or one per position.
struct Mesh {
  std::string name;
  std::vector<std::array<float, 3>> positions, normals;
  std::vector<std::array<float, 2>> uvs;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  int material = -1;  // in Scene::materials, -1 for the default: white, metallic 0, roughness 1
};

/// A pinhole at `position` looking at `look_at`; vertical_fov in degrees.
struct Camera {
  Vector position{0.0, 0.0, 5.0}, look_at, up{0.0, 1.0, 0.0};
  double vertical_fov = 40.0;
};

struct Film {
  int width = 640, height = 360;
};

/// What the scene file asks of the renderer; the command line may say otherwise.
struct IntegratorSettings {
  std::string name = "path";
  int spp = 64;
  int max_depth = 0;  // 0: no limit
};

struct Scene {
  double meters_per_unit = 1.0;  // of the scene file: what --origin and --distance are in
  std::vector<Mesh> meshes;
  std::vector<Material> materials;
  std::vector<Texture> textures;
  std::vector<PointLight> points;
  std::vector<SpotLight> spots;
  std::vector<SunLight> suns;
  std::optional<EnvironmentLight> environment;
  Medium medium;  // the global medium and every volume's species, each with its profiles
  Camera camera;
  Film film;
  double fps = 24.0;
  IntegratorSettings integrator;
  std::vector<std::string> warnings;  // what the files ask for that is not done, one sentence each
};

}  // namespace tyndall
