// tyndall presets: the media that come with the program.
#include "tyndall/document/preset.h"

#include <iostream>
#include <string>

#include "tyndall/cli/commands.h"
#include "tyndall/cli/table.h"
#include "tyndall/document/medium_file.h"
#include "tyndall/document/medium_summary.h"
#include "tyndall/document/spelling.h"

namespace tyndall {
namespace {

struct Listed {
  std::string preset, name, description;
  ChannelList visibility_5{};  // [m]
  std::vector<Source> sources;
  static constexpr auto fields() {
    return std::tuple{
        Field{"preset", &Listed::preset, any_number, "", "What to type."},
        Field{"name", &Listed::name, any_number, "", "What it is called."},
        Field{"description", &Listed::description, any_number, "", "What it is."},
        Field{"visibility_5", &Listed::visibility_5, any_number, "m", "Distance at which 5 % contrast is left."},
        Field{"sources", &Listed::sources, any_number, "", "Where its numbers come from.", Scaling::none, true}};
  }
};

Listed listed(const Preset& preset) {
  const MediumFile file = medium_from_json(std::string(preset.text), title_of(preset));
  const MediumSummary summary = summary_of(compile(file, title_of(preset)));
  return {std::string(preset.name), file.name, file.description.value_or(""), summary.visibility_5, file.sources};
}

void list_presets(bool json) {
  OrderedJson all = OrderedJson::array();
  Table table;
  table.add({"preset", "visibility", "what"});
  for (const Preset& preset : presets()) {
    const Listed entry = listed(preset);
    if (json) {
      all.push_back(written(entry));
    } else {
      table.add({entry.preset, length_text(entry.visibility_5[visibility_channel]), entry.name});
    }
  }
  std::cout << (json ? pretty(OrderedJson{{"presets", all}}) : table.text());
}

void print_preset(const std::string& name) {
  const Preset* const preset = preset_named(name);
  if (preset == nullptr) throw Fault("presets", in_quotes(name), one_of(name, preset_names()));
  std::cout << preset->text;
}

}  // namespace

void add_presets(CLI::App& app) {
  struct Options {
    std::string name;
    bool json = false;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("presets", "List the media that come with the program, or print one");
  const CLI::Option* const name =
      command->add_option("NAME", options->name, "Print the file of this one, with the sources of its numbers");
  command->add_flag("--json", options->json, "Print one JSON object: with NAME the file itself, else the list, in SI");
  command->footer(
      "A preset's name stands for a medium wherever one is asked for. To change one, name it as the base of\n"
      "a file of your own: {\"format\": \"tyndall-medium/1\", \"base\": \"haze\", ...}, or print it to a file.\n"
      "Visibility: 5 % of contrast left, in green, at the origin.\n\n"
      "Example: tyndall presets radiation_fog\n"
      "Example: tyndall show radiation_fog");
  command->callback(
      [options, name] { name->count() == 0 ? list_presets(options->json) : print_preset(options->name); });
}

}  // namespace tyndall
