#include "tyndall/cli/scene_arguments.h"

#include <filesystem>
#include <iostream>

#include "tyndall/cli/arguments.h"
#include "tyndall/document/law_text.h"
#include "tyndall/document/preset.h"
#include "tyndall/document/spelling.h"
#include "tyndall/scene/scene_file.h"

namespace tyndall {

namespace {

/// Names that are no files but known otherwise; a file of that name is what is meant.
void refuse_words(const std::string& name) {
  constexpr const char* scene = "a scene: the name of a *.scene.json, .glb or .gltf";
  std::error_code error;
  if (name.empty()) throw Fault("SCENE", "an empty name", scene);
  if (std::filesystem::exists(name, error)) return;
  if (preset_named(name) != nullptr) {
    throw Fault("SCENE", in_quotes(name) + ", a preset of a medium",
                std::string(scene) + "; --medium " + name + " puts it into one");
  }
  if (is_law_text(name)) throw Fault("SCENE", in_quotes(name) + ", a law of scattering", scene);
}

}  // namespace

void add_scene_arguments(CLI::App& command, SceneArguments& arguments) {
  command.add_option("SCENE", arguments.scene, "A .scene.json, .glb or .gltf file")->required();
  command.add_option("--medium", arguments.medium, "The air: a medium file or preset, instead of the scene's own");
  add_allow_path(command, arguments.allow_path);
}

Scene scene_of(const SceneArguments& arguments, bool quiet) {
  if (arguments.medium && arguments.medium->empty()) {
    throw Fault("--medium", "an empty name", "the name of a file or preset");
  }
  refuse_words(arguments.scene);
  Scene scene = read_scene(arguments.scene, {arguments.medium.value_or(""), arguments.allow_path});
  if (!quiet) {
    for (const std::string& warning : scene.warnings) std::cerr << "warning: " << warning << '\n';
  }
  return scene;
}

}  // namespace tyndall
