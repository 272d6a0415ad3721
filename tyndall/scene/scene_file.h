#pragma once
// Reading scenes: *.scene.json, or a .glb / .gltf alone.
#include <filesystem>

#include "tyndall/document/fault.h"
#include "tyndall/scene/scene.h"

namespace tyndall {

struct SceneOptions {
  std::filesystem::path medium;  // replaces the scene's medium when not empty
  bool allow_path = false;       // follow references out of the folder of the file that names them
};

/// Loads a scene with everything it refers to. Throws Fault for anything wrong with the files; .gltf, .hdr, .exr and
/// textures are first parsed in a child process with limits, so that a library's crash becomes a Fault too.
Scene read_scene(const std::filesystem::path& file, const SceneOptions& options = {});

}  // namespace tyndall
