#pragma once
// glTF 2.0 files, .gltf and .glb, through tinygltf.
#include <filesystem>
#include <optional>

#include "tyndall/scene/scene.h"

namespace tyndall {

/// The camera of a file and the width / height it was made for.
struct GltfCamera {
  Camera camera;
  std::optional<double> aspect;
};

struct GltfOptions {
  double meters_per_unit = 1.0;  // other than 1 where the file disobeys glTF
  bool allow_path = false;       // files that this one refers to may lie outside its folder
  double time = 0.0;             // [s], of its animations
};

/// What a file has besides what goes into a scene.
struct GltfContent {
  std::optional<GltfCamera> camera;  // the first that a node uses
  bool moves = false;                // at another time it is another scene
};

/// Adds a file's meshes, materials, base-colour textures and lights to `scene`, in world space and metres, as they are
/// at a time.
///
/// Done: node trees by matrix or translation, rotation, scale; triangle lists, strips and fans; sparse and quantised
/// accessors; KHR_lights_punctual with candela, lux read 1:1 as W/sr, W/m^2 (`range` is ignored: light does not end);
/// emission with KHR_materials_emissive_strength, nit read 1:1 as W/(m^2 sr); metallic-roughness materials with PNG or
/// JPEG textures of base colour and alpha, roughness and metalness, emission, normals, KHR_texture_transform and
/// KHR_materials_ior; alpha modes (see Geometry); animations of nodes (poses_at()). Not done, and said in
/// scene.warnings: skins, morphs, refraction, occlusion maps, vertex colours, points and lines, orthographic cameras,
/// optional extensions. A required extension that is not supported is a Fault.
///
/// Everything is first parsed in a child process with limits. Throws Fault; `scene` may then hold part of the file.
GltfContent add_gltf(Scene& scene, const std::filesystem::path& file, const GltfOptions& options = {});

}  // namespace tyndall
