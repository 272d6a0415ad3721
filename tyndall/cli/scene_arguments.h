#pragma once
// How commands are told of a scene.
#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "tyndall/scene/scene.h"

namespace tyndall {

/// SCENE, --medium and --allow-path.
struct SceneArguments {
  std::string scene;
  std::optional<std::string> medium;
  bool allow_path = false;
};

void add_scene_arguments(CLI::App& command, SceneArguments& arguments);

/// The scene that they name; its warnings go to stderr unless `quiet`. Throws Fault.
Scene scene_of(const SceneArguments& arguments, bool quiet = false);

}  // namespace tyndall
