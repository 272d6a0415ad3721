#pragma once
// A scene as loaded: everything in metres and world space, nothing left of the files it came from.
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "tyndall/light/light.h"
#include "tyndall/medium/medium.h"
#include "tyndall/number/field.h"

namespace tyndall {

/// What a texture shows beyond its edges.
enum class Wrap { repeat, mirror, clamp };

/// Linear numbers, row-major, top row first; values in [0, 1].
struct Texture {
  int width = 0, height = 0;
  std::vector<std::array<float, 3>> color;
  Wrap wrap_u = Wrap::repeat, wrap_v = Wrap::repeat;
  std::vector<float> alpha;  // empty: 1 everywhere
};

/// A texture on a surface.
struct Map {
  int texture = -1;  // in Scene::textures, -1 for none
  int uv_set = 0;    // in Mesh::uvs
};

/// glTF's: whether alpha counts as 1, is cut at a threshold, or is the part of the surface that is there.
enum class AlphaMode { opaque, mask, blend };

/// glTF's metallic-roughness material. emission is radiance [W/(m^2 sr)], strength included. Maps multiply: color_map
/// the base colour and alpha, roughness_map by its second and third number roughness and metalness.
struct Material {
  std::string name;
  Spectrum base_color = Spectrum::grey(1.0);
  double alpha = 1.0, alpha_cutoff = 0.5;
  AlphaMode alpha_mode = AlphaMode::opaque;
  double metallic = 1.0, roughness = 1.0;
  double ior = 1.5;  // refractive index of what is no metal, for its reflection
  Spectrum emission;
  double normal_scale = 1.0;
  Map color_map, roughness_map, emission_map, normal_map;
  bool double_sided = false;  // emission leaves a single-sided material on its front (counter-clockwise) face only
};

/// Triangles of one material; normals, tangents and each set of uvs are empty or one per position.
struct Mesh {
  std::string name;
  std::vector<std::array<float, 3>> positions, normals;
  std::vector<std::array<float, 4>> tangents;  // and the sign of normal x tangent, by which it points up the normal map
  std::vector<std::vector<std::array<float, 2>>> uvs;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  int material = -1;  // in Scene::materials, -1 for the default: white, metallic 0, roughness 1
};

/// A pinhole at `position` looking at `look_at`; vertical_fov in degrees.
struct Camera {
  static constexpr std::string_view text = "A pinhole camera.";
  Vector position{0.0, 0.0, 5.0}, look_at, up{0.0, 1.0, 0.0};
  double vertical_fov = 40.0;
  static constexpr auto fields() {
    return std::tuple{
        Field{"position", &Camera::position, any_number, "m", "Where the camera stands.", Scaling::length, true},
        Field{"look_at", &Camera::look_at, any_number, "m", "A point in the middle of the picture.", Scaling::length,
              true},
        Field{"up", &Camera::up, any_number, "1", "The direction that is up in the picture."},
        Field{"vertical_fov", &Camera::vertical_fov, Range{0.0, 180.0, true, true}, "degrees",
              "Angle from the lower to the upper edge of the picture."}};
  }
};

struct Film {
  static constexpr std::string_view text = "The size of the picture.";
  int width = 640, height = 360;
  static constexpr auto fields() {
    return std::tuple{Field{"width", &Film::width, Range{1.0, 16384.0}, "1", "Pixels from left to right."},
                      Field{"height", &Film::height, Range{1.0, 16384.0}, "1", "Pixels from top to bottom."}};
  }
};

/// The closed list of integrators.
inline constexpr std::array<std::string_view, 2> integrator_names{"path", "single"};

/// What the scene file asks of the renderer; the command line may say otherwise.
struct IntegratorSettings {
  static constexpr std::string_view text = "How the picture is computed.";
  std::string name = "path";
  int spp = 64;
  int max_depth = 0;  // 0: no limit
  static constexpr auto fields() {
    return std::tuple{Field{"name", &IntegratorSettings::name, any_number, "",
                            "path: all orders of scattering, with noise; single: one scattering, without."},
                      Field{"spp", &IntegratorSettings::spp, Range{1.0, 1e9}, "1", "Samples per pixel."},
                      Field{"max_depth", &IntegratorSettings::max_depth, Range{0.0, 1e9}, "1",
                            "The most scatterings and bounces of a path; 0 is no limit."}};
  }
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
  double time = 0.0;  // [s] of the picture: what the wind has done to noise
  IntegratorSettings integrator;
  std::vector<std::string> warnings;  // what the files ask for that is not done or not in nature
};

}  // namespace tyndall
