// tyndall show: a medium in numbers.
#include <cmath>
#include <iostream>
#include <string>

#include "tyndall/cli/commands.h"
#include "tyndall/cli/table.h"
#include "tyndall/document/medium_file.h"
#include "tyndall/document/medium_summary.h"
#include "tyndall/document/spelling.h"

namespace tyndall {
namespace {

std::string profile_text(const std::vector<Profile>& profiles) {
  std::string text;
  for (const Profile& profile : profiles) {
    text += text.empty() ? "" : ", ";
    text += std::visit([](const auto& p) { return std::string(p.name); }, profile);
    if (const auto* height = std::get_if<ExponentialProfile>(&profile)) {
      text += " in height, by e every " + length_text(height->scale_height);
    }
  }
  return text;
}

void print_table(const MediumSummary& medium) {
  std::cout << (medium.name.empty() ? "(no name)" : printable(medium.name)) << "\n\n";
  Table table;
  const auto row = [&](const std::string& name, const ChannelList& values, auto text_of) {
    table.add({name, text_of(values[0]), text_of(values[1]), text_of(values[2])});
  };
  table.add({"at the origin", "red", "green", "blue"});
  row("visibility, 5 % contrast", medium.visibility_5, length_text);
  row("visibility, 2 % contrast", medium.visibility_2, length_text);
  row("mean free path", medium.mean_free_path, length_text);
  row("albedo", medium.albedo, value_text);
  row("mean cosine", medium.mean_cosine, value_text);
  row("extinction [1/m]", medium.extinction, value_text);
  row("scattering [1/m]", medium.scattering, value_text);
  row("absorption [1/m]", medium.absorption, value_text);
  std::cout << table.text();
  if (medium.exaggeration != 1.0) {
    std::cout << "\nThe background is exaggerated by a factor of " << value_text(medium.exaggeration) << ".\n";
  }
  Table species;
  species.add({"made of", "law", "scattering [1/m]", "absorption [1/m]", "mean cosine", "profile"});
  for (const SpeciesSummary& s : medium.species) {
    species.add({printable(s.name, 30), s.law, channels_text(s.scattering), channels_text(s.absorption),
                 value_text(s.mean_cosine), profile_text(s.profiles)});
  }
  if (!medium.species.empty() && largest(Spectrum{medium.extinction}) == 0.0) {
    std::cout << "\nNothing of it is at the origin; its species have their own places.\n";
  }
  std::cout << '\n' << (medium.species.empty() ? "Made of nothing: a vacuum.\n" : species.text());
}

struct ShowOptions {
  std::string medium;
  bool json = false;
};

void show(const ShowOptions& options) {
  const MediumFile file = read_medium_file(options.medium);
  MediumSummary summary = summary_of(compile(file, options.medium));
  summary.name = file.name;
  summary.exaggeration = file.background ? file.background->exaggeration : 1.0;
  if (options.json) {
    std::cout << pretty(written(summary));
  } else {
    print_table(summary);
  }
}

}  // namespace

void add_show(CLI::App& app) {
  auto options = std::make_shared<ShowOptions>();
  CLI::App* command = app.add_subcommand("show", "Print a medium in numbers: how far one sees, what it is made of");
  command->add_option("MEDIUM", options->medium, "Medium file (*.medium.json)")->required();
  command->add_flag("--json", options->json, "Print one JSON object, in SI units; infinite or undefined is null");
  command->footer(
      "Everything is stated at the origin of the scene. Visibility is the distance at which a black\n"
      "object against the horizon keeps 5 % (or 2 %) of its contrast.\n\n"
      "Example: tyndall show examples/media/harbour_fog.medium.json");
  command->callback([options] { show(*options); });
}

}  // namespace tyndall
