// tyndall blend: a medium between two.
#include <filesystem>
#include <iostream>
#include <string>

#include "tyndall/cli/arguments.h"
#include "tyndall/cli/commands.h"
#include "tyndall/cli/medium_arguments.h"
#include "tyndall/cli/warnings.h"
#include "tyndall/document/binding.h"
#include "tyndall/document/medium_blend.h"
#include "tyndall/document/preset.h"

namespace tyndall {
namespace {

struct BlendOptions {
  std::string a, b, out, how = "interpolate";
  double at = 0.0;
  MediumArguments media;
};

BlendHow how_of(const std::string& word) {
  constexpr auto words = words_of(BlendHow{});
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] == word) return static_cast<BlendHow>(i);
  }
  throw Fault("--how", in_quotes(word), one_of(word, {words.begin(), words.end()}));
}

/// A Fault where the new file would take the place of one that it is made of.
void check_not_an_input(const BlendOptions& options) {
  std::error_code error;
  for (const std::string& input : {options.a, options.b}) {
    if (preset_named(input) == nullptr && std::filesystem::equivalent(input, options.out, error)) {
      throw Fault("--output", "the file " + in_quotes(options.out) + ", one of the two media",
                  "another name: what is blended is not overwritten");
    }
  }
}

void blend(const BlendOptions& options) {
  check_output(options.out, ".json", "a name ending in .medium.json");
  const BlendHow how = how_of(options.how);
  check_not_an_input(options);
  auto [stated_a, a] = medium_of(options.a, options.media);
  auto [stated_b, b] = medium_of(options.b, options.media);
  move_schema(a, options.a, options.out);
  move_schema(b, options.b, options.out);
  if (channels_of(a) != channels_of(b)) {
    std::cerr << "tyndall: warning: the channels of " << printable(options.a) << " and " << printable(options.b)
              << " mean different things; they are blended one by one\n";
  }
  warn(stated_a, options.a);
  if (options.b != options.a) warn(stated_b, options.b);
  write_medium_file(options.out, blended(a, b, options.at, how, "blend of " + options.a + " and " + options.b));
}

}  // namespace

void add_blend(CLI::App& app) {
  auto options = std::make_shared<BlendOptions>();
  CLI::App* command = app.add_subcommand("blend", "Make a medium that stands between two");
  command->add_option("A", options->a, "Medium file or preset to start from")->required();
  command->add_option("B", options->b, "Medium file or preset to go to")->required();
  command->add_option("--at", options->at, "How far: 0 is A, 1 is B")->required()->check(number_within(0.0, 1.0));
  command->add_option("--how", options->how, "interpolate, mix or morph")->capture_default_str();
  command->add_option("-o,--output", options->out, "Medium file to write (*.medium.json)")->required();
  add_medium_arguments(*command, options->media);
  command->footer(
      "interpolate moves every dial (w, thickness, lobes, ...) in a straight line; both media must use the\n"
      "  same model.\n"
      "mix has both media present, each in its share; any two media will do.\n"
      "morph changes thickness by equal factors in equal steps, as the eye judges it; any two media will do.\n\n"
      "Example: tyndall blend haze.medium.json fog.medium.json --at 0.3 --how morph -o between.medium.json");
  command->callback([options] { blend(*options); });
}

}  // namespace tyndall
