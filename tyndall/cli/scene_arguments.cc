#include "tyndall/cli/scene_arguments.h"

#include <iostream>

#include "tyndall/cli/arguments.h"
#include "tyndall/scene/scene_file.h"

namespace tyndall {

void add_scene_arguments(CLI::App& command, SceneArguments& arguments) {
  command.add_option("SCENE", arguments.scene, "A .scene.json, .glb or .gltf file")->required();
  command.add_option("--medium", arguments.medium, "The air: a medium file or preset, instead of the scene's own");
  add_allow_path(command, arguments.allow_path);
}

Scene scene_of(const SceneArguments& arguments, bool quiet) {
  if (arguments.medium && arguments.medium->empty())
    throw Fault("--medium", "an empty name", "the name of a file or preset");
  Scene scene = read_scene(arguments.scene, {arguments.medium.value_or(""), arguments.allow_path});
  if (!quiet) {
    for (const std::string& warning : scene.warnings) std::cerr << "warning: " << warning << '\n';
  }
  return scene;
}

}  // namespace tyndall
