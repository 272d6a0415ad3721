// tyndall show: a medium in numbers.
#include <algorithm>
#include <cmath>
#include <iostream>
#include <string>

#include "tyndall/cli/arguments.h"
#include "tyndall/cli/commands.h"
#include "tyndall/cli/medium_arguments.h"
#include "tyndall/cli/table.h"
#include "tyndall/cli/warnings.h"
#include "tyndall/document/medium_file.h"
#include "tyndall/document/medium_summary.h"
#include "tyndall/document/spelling.h"

namespace tyndall {
namespace {

struct ProfileWords {
  std::string operator()(const ConstantProfile&) const { return "constant"; }
  std::string operator()(const ExponentialProfile& e) const {
    return "exponential in height, by e every " + length_text(e.scale_height);
  }
  std::string operator()(const LayerProfile& l) const {
    return "layer from " + length_text(l.bottom) + " to " + length_text(l.top);
  }
  std::string operator()(const TentProfile& t) const {
    return "tent around " + length_text(t.centre) + ", \u00B1 " + length_text(t.half_width);
  }
  std::string operator()(const SphereProfile& s) const { return "sphere of radius " + length_text(s.radius); }
  std::string operator()(const BoxProfile& b) const {
    const Vector size = b.max - b.min;
    return "box of " + length_text(size.x) + " x " + length_text(size.y) + " x " + length_text(size.z);
  }
  std::string operator()(const NoiseProfile& n) const {
    return "noise of " + length_text(n.scale) + ", \u00B1 " + std::to_string(std::lround(100.0 * n.contrast)) + " %";
  }
  std::string operator()(const GridProfile& g) const {
    return "grid " + printable(g.grid_name.empty() ? g.file.name : g.grid_name);
  }
};

std::string profile_text(const std::vector<Profile>& profiles) {
  std::string text;
  for (const Profile& profile : profiles) {
    text += (text.empty() ? "" : " x ") + std::visit(ProfileWords{}, profile);
  }
  return text;
}

/// The first row of a table of channels.
std::vector<std::string> heading(const std::string& what, const MediumFile& file) {
  if (std::holds_alternative<ChannelSpace>(channels_of(file))) return {what, "red", "green", "blue"};
  const Spectrum nm = wavelengths_of(file.channels);
  return {what, value_text(nm[0]) + " nm", value_text(nm[1]) + " nm", value_text(nm[2]) + " nm"};
}

/// A row of a table: what, and one text per channel.
void add_row(Table& table, const std::string& name, const Spectrum& values, std::string (*text_of)(double)) {
  table.add({name, text_of(values[0]), text_of(values[1]), text_of(values[2])});
}

/// The extinction in the other ways in which people and programs state it.
void print_densities(const Spectrum& extinction, const MediumFile& file) {
  Table table;
  const double distance = telling_distance(extinction);
  table.add(heading("the same extinction, said otherwise", file));
  add_row(table, "half of the light is gone after", Spectrum::grey(std::log(2.0)) / extinction, length_text);
  add_row(table, "90 % of the light is gone after", Spectrum::grey(std::log(10.0)) / extinction, length_text);
  add_row(table, "transmittance of " + length_text(distance), exp(-distance * extinction), value_text);
  add_row(table, "optical depth of " + length_text(distance), distance * extinction, value_text);
  add_row(table, "mass, if a gram blocks 1 m^2 [g/m^3]", extinction, value_text);
  if (const double unit = file.meters_per_unit; unit != 1.0) {
    add_row(table, "extinction per unit of " + length_text(unit), extinction * unit, value_text);
  }
  std::cout << '\n' << table.text();
}

std::string seconds_text(double time) { return value_text(time) + " s"; }

/// When a medium with keyframes is shown, and where that is among its keys.
std::string time_text(const Keyframes& keys, double time) {
  const auto [from, to, share] = interval_at(keys, time);
  const BlendHow how = keys[to].transition;
  std::string text = "At " + seconds_text(time);
  if (share > 0.0) {
    text += ", on the way from the key at " + seconds_text(keys[from].time) + " to that at " +
            seconds_text(keys[to].time) + " (" + std::string(words_of(how)[static_cast<std::size_t>(how)]) + ")";
  } else if (time == keys[from].time) {
    text += ", a key";
  } else {
    text += time < keys[from].time ? ", as until the first key" : ", as since the last key";
  }
  constexpr std::size_t most_listed = 12;
  text += keys.size() == 1 ? ". Key at " : ". Keys at ";
  for (std::size_t i = 0; i < std::min(keys.size(), most_listed); ++i) {
    text += (i > 0 ? ", " : "") + seconds_text(keys[i].time);
  }
  if (keys.size() > most_listed) {
    text += ", ... " + seconds_text(keys.back().time) + " (" + std::to_string(keys.size()) + " keys)";
  }
  return text + '.';
}

void print_table(const MediumSummary& medium, const MediumInTime& from) {
  const MediumFile& file = from.now;
  std::cout << (medium.name.empty() ? "(no name)" : printable(medium.name)) << '\n';
  if (medium.time) std::cout << time_text(*from.stated.keyframes, *medium.time) << '\n';
  std::cout << '\n';
  Table table;
  const auto row = [&](const std::string& name, const ChannelList& values, std::string (*text_of)(double)) {
    add_row(table, name, Spectrum{values}, text_of);
  };
  table.add(heading("at the origin", file));
  row("visibility, 5 % contrast", medium.visibility_5, length_text);
  row("visibility, 2 % contrast", medium.visibility_2, length_text);
  row("mean free path", medium.mean_free_path, length_text);
  row("albedo", medium.albedo, value_text);
  row("mean cosine", medium.mean_cosine, value_text);
  row("extinction [1/m]", medium.extinction, value_text);
  row("scattering [1/m]", medium.scattering, value_text);
  row("absorption [1/m]", medium.absorption, value_text);
  std::cout << table.text();
  if (largest(Spectrum{medium.extinction}) > 0.0) print_densities(Spectrum{medium.extinction}, file);
  if (medium.exaggeration != 1.0) {
    std::cout << "\nThe background is exaggerated by a factor of " << value_text(medium.exaggeration) << ".\n";
  }
  Table species;
  species.add({"made of", "law", "scattering [1/m]", "absorption [1/m]", "mean cosine", "profile"});
  for (const SpeciesSummary& s : medium.species) {
    species.add({printable(s.name, 30), s.law, channels_text(s.scattering), channels_text(s.absorption),
                 channels_text(s.mean_cosine.value), profile_text(s.profiles)});
  }
  if (!medium.species.empty() && largest(Spectrum{medium.extinction}) == 0.0) {
    std::cout << "\nNothing of it is at the origin; its species have their own places.\n";
  }
  std::cout << '\n' << (medium.species.empty() ? "Made of nothing: a vacuum.\n" : species.text());
  for (std::size_t i = 0; i < medium.sources.size(); ++i) {
    std::cout << (i == 0 ? "\n" : "") << "  " << medium.sources[i] << ".\n";
  }
}

struct ShowOptions {
  std::string medium;
  bool json = false;
  MediumArguments media;
};

void show(const ShowOptions& options) {
  const MediumInTime medium = medium_of(options.medium, options.media);
  const auto& [stated, file] = medium;
  MediumSummary summary = summary_of(compile(file, options.medium));
  const MediumDials dials = dials_in_metres(file);
  summary.name = file.name;
  summary.exaggeration = file.background ? file.background->exaggeration : 1.0;
  summary.sources = statements_on(dials);
  summary.warnings = remarks_on(stated);
  if (stated.keyframes) {
    summary.time = options.media.time;
    for (const Keyframe& key : *stated.keyframes) summary.keyframes.push_back(key.time);
  }
  warn(stated, options.medium);
  if (options.json) {
    std::cout << pretty(written(summary));
  } else {
    print_table(summary, medium);
  }
}

}  // namespace

void add_show(CLI::App& app) {
  auto options = std::make_shared<ShowOptions>();
  CLI::App* command = app.add_subcommand("show", "Print a medium in numbers: how far one sees, what it is made of");
  command->add_option("MEDIUM", options->medium, "Medium file (*.medium.json), or the name of a preset")->required();
  command->add_flag("--json", options->json, "Print one JSON object, in SI units; infinite or undefined is null");
  add_medium_arguments(*command, options->media);
  command->footer(
      "Everything is stated at the origin of the scene. Visibility is the distance at which a black\n"
      "object against the horizon keeps 5 % (or 2 %) of its contrast.\n\n"
      "Example: tyndall show examples/media/harbour_fog.medium.json");
  command->callback([options] { show(*options); });
}

}  // namespace tyndall
