#pragma once
// How commands are told of a scene.
#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "tyndall/cli/medium_arguments.h"
#include "tyndall/scene/scene_file.h"

namespace tyndall {

/// SCENE, --medium, --time and --allow-path.
struct SceneArguments {
  std::string scene;
  std::optional<std::string> medium;
  MediumArguments media;
  std::optional<int> frame = std::nullopt;  // instead of --time
};

void add_scene_arguments(CLI::App& command, SceneArguments& arguments);

/// The scene that they name; its warnings go to stderr unless `quiet`. Throws Fault.
SceneInTime scene_of(const SceneArguments& arguments, bool quiet = false);

}  // namespace tyndall
