// tyndall schema: what medium and scene files may hold, for editors and validators.
#include "tyndall/document/schema.h"

#include <iostream>
#include <string>

#include "tyndall/cli/commands.h"
#include "tyndall/document/fault.h"
#include "tyndall/document/spelling.h"
#include "tyndall/scene/scene_description.h"

namespace tyndall {
namespace {

OrderedJson scene_schema() {
  SchemaBook book;
  // A medium written in place need not repeat what the scene file says already (scene_file.cc).
  book.not_required<MediumFile>("format");
  return book.whole<SceneDescription>("Tyndall scene, format 1 (name.scene.json)");
}

void schema(const std::string& of) {
  if (of == "medium") {
    std::cout << pretty(medium_schema());
  } else if (of == "scene") {
    std::cout << pretty(scene_schema());
  } else {
    throw Fault("schema", in_quotes(of), one_of(of, {"medium", "scene"}));
  }
}

}  // namespace

void add_schema(CLI::App& app) {
  auto of = std::make_shared<std::string>("medium");
  CLI::App* command = app.add_subcommand("schema", "Print the JSON Schema of medium or scene files");
  command->add_option("FILES", *of, "medium or scene")->capture_default_str();
  command->footer(
      "Editors complete and check files with it, validators check them (JSON Schema draft-07). It follows from\n"
      "the same descriptions by which files are read; docs/files.md lists what only reading checks.\n\n"
      "Example: tyndall schema scene > tyndall-scene-1.schema.json");
  command->callback([of] { schema(*of); });
}

}  // namespace tyndall
