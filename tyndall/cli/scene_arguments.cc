#include "tyndall/cli/scene_arguments.h"

#include <iostream>

namespace tyndall {

void add_scene_arguments(CLI::App& command, SceneArguments& arguments) {
  command.add_option("SCENE", arguments.scene, "A .scene.json, .glb or .gltf file")->required();
  command.add_option("--medium", arguments.medium, "The air: a medium file or preset, instead of the scene's own");
  add_medium_arguments(command, arguments.media);
}

SceneInTime scene_of(const SceneArguments& arguments, bool quiet) {
  if (arguments.medium && arguments.medium->empty())
    throw Fault("--medium", "an empty name", "the name of a file or preset");
  const MediumArguments& media = arguments.media;
  SceneInTime scene = read_scene_in_time(
      arguments.scene, {arguments.medium.value_or(""), media.allow_path, media.time, arguments.frame});
  if (!quiet) {
    for (const std::string& warning : scene.scene.warnings) std::cerr << "warning: " << warning << '\n';
  }
  return scene;
}

}  // namespace tyndall
