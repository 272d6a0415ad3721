// tyndall phase: how a law, or a medium's mixture, scatters.
#include <cmath>
#include <filesystem>
#include <iostream>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "tyndall/cli/arguments.h"
#include "tyndall/cli/commands.h"
#include "tyndall/cli/law_list.h"
#include "tyndall/cli/number_list.h"
#include "tyndall/cli/table.h"
#include "tyndall/cli/warnings.h"
#include "tyndall/document/law_text.h"
#include "tyndall/document/medium_summary.h"
#include "tyndall/document/named_medium.h"
#include "tyndall/document/spelling.h"
#include "tyndall/phase/merged_lobes.h"

namespace tyndall {
namespace {

constexpr int most_moments = 10000;

struct PhaseOptions {
  std::string subject, at_text, sample_text;
  std::vector<double> at, sample;
  std::optional<int> moments;
  bool json = false, allow_path = false;
};

/// What is asked of either subject: a law answers with one number, a medium with one per channel.
struct Subject {
  std::vector<LobeSum<double>> channels;  // one for a law that is the same in all channels, else one per channel; empty
                                          // where nothing scatters
  std::optional<Law<double>> law;         // the same in all channels: its own sampler is the better one
  std::string title;

  template <class Value>
  OrderedJson answer(Value value) const {
    OrderedJson out = OrderedJson::array();
    for (const auto& lobes : channels) {
      out.push_back(lobes.empty() ? OrderedJson(nullptr) : written_number(value(lobes)));
    }
    return law ? out.front() : out;
  }
  /// Legendre moments 0 to `last`, each an answer.
  OrderedJson moments(int last) const {
    std::vector<std::vector<double>> all;
    for (const auto& lobes : channels) all.push_back(tyndall::moments(lobes, last));
    OrderedJson out = OrderedJson::array();
    for (std::size_t l = 0; l < all.front().size(); ++l) {
      OrderedJson row = OrderedJson::array();
      for (std::size_t c = 0; c < channels.size(); ++c)
        row.push_back(channels[c].empty() ? OrderedJson(nullptr) : written_number(all[c][l]));
      out.push_back(law ? row.front() : row);
    }
    return out;
  }
};

Subject subject_of(const std::string& text, bool allow_path) {
  if (is_law_text(text)) {
    const Law<double> law = law_from_text(text);
    if (!is_chromatic(law)) return {{merged(lower(law))}, law, text};
    Subject out{{}, std::nullopt, text};
    for (auto& lobes : lower_channels(law)) out.channels.push_back(merged(std::move(lobes)));
    return out;
  }
  const MediumFile file = read_named_medium_beside_laws("phase", text, allow_path).file;
  warn(file, text);
  const auto mixture = mixture_at(compile(file, text));
  return {{mixture.begin(), mixture.end()}, std::nullopt, file.name};
}

OrderedJson answers(const Subject& subject, const PhaseOptions& options) {
  OrderedJson out = OrderedJson::object();
  const auto list = [&](const char* key, const auto& inputs, auto answer) {
    out[key] = OrderedJson::array();
    for (const auto& x : inputs) out[key].push_back(answer(x));
  };
  list("mu", options.at, written_number);
  list("density", options.at, [&](double mu) {
    const auto d = Deflection<double>::from_mu(mu);
    return subject.answer([&](const LobeSum<double>& lobes) { return density(lobes, d); });
  });
  out["mean_cosine"] = subject.answer([](const LobeSum<double>& lobes) { return mean_cosine(lobes); });
  out["legendre"] = options.moments ? subject.moments(*options.moments) : OrderedJson::array();
  list("sampled_mu", options.sample, [&](double u) {
    return subject.answer(
        [&](const LobeSum<double>& lobes) { return (subject.law ? sample(*subject.law, u) : sample(lobes, u)).mu; });
  });
  return out;
}

std::string cell(const OrderedJson& answer) {
  if (answer.is_number()) return value_text(answer.get<double>());
  if (!answer.is_array()) return "-";
  std::string text;
  for (const OrderedJson& x : answer) text += (text.empty() ? "" : "  ") + cell(x);
  return text;
}

void print_tables(const Subject& subject, const PhaseOptions& options) {
  const OrderedJson all = answers(subject, options);
  const std::string per_channel = subject.law ? "" : "  red  green  blue";
  std::cout << (subject.title.empty() ? "(no name)" : printable(subject.title)) << "\n\n  mean cosine" << per_channel
            << ": " << cell(all["mean_cosine"]) << "\n\n";
  Table densities;
  densities.add({"angle", "mu", "density [1/sr]" + per_channel});
  for (std::size_t i = 0; i < options.at.size(); ++i) {
    const double degrees = std::acos(options.at[i]) * 180.0 / std::numbers::pi;
    densities.add({value_text(degrees) + "\u00B0", value_text(options.at[i]), cell(all["density"][i])});
  }
  std::cout << densities.text();
  if (options.moments) {
    Table moments;
    moments.add({"order", "Legendre moment" + per_channel});
    for (int l = 0; l <= options.moments.value_or(-1); ++l) {
      moments.add({std::to_string(l), cell(all["legendre"][static_cast<std::size_t>(l)])});
    }
    std::cout << '\n' << moments.text();
  }
  if (!options.sample.empty()) {
    Table samples;
    samples.add({"u", "sampled mu" + per_channel});
    for (std::size_t i = 0; i < options.sample.size(); ++i) {
      samples.add({value_text(options.sample[i]), cell(all["sampled_mu"][i])});
    }
    std::cout << '\n' << samples.text();
  }
}

void phase(PhaseOptions options) {
  options.at = numbers_from(options.at_text, "--at", -1.0, 1.0);
  options.sample = numbers_from(options.sample_text, "--sample", 0.0, 1.0);
  const Subject subject = subject_of(options.subject, options.allow_path);
  if (options.json) {
    std::cout << pretty(answers(subject, options));
    return;
  }
  if (options.at.empty()) {
    for (const double degrees : {0.0, 5.0, 10.0, 20.0, 30.0, 45.0, 60.0, 90.0, 120.0, 150.0, 180.0}) {
      // Rounded, so that 90 degrees are mu = 0 and not 6e-17.
      options.at.push_back(std::round(1e15 * std::cos(degrees * std::numbers::pi / 180.0)) / 1e15);
    }
  }
  print_tables(subject, options);
}

}  // namespace

void add_phase(CLI::App& app) {
  auto options = std::make_shared<PhaseOptions>();
  CLI::App* command = app.add_subcommand("phase", "Print how a law, or a medium's mixture of laws, scatters");
  command->add_option("LAW|MEDIUM", options->subject, "A law with its parameters, or a medium file")->required();
  command->add_option("--at", options->at_text, "Density [1/sr] at these cosines of the angle of scattering")
      ->type_name("MU,..");
  command->add_option("--moments", options->moments, "Legendre moments up to order N")
      ->type_name("N")
      ->check(whole_within(0, most_moments));
  command->add_option("--sample", options->sample_text, "Sampled mu for these random numbers from 0 to 1")
      ->type_name("U,..");
  command->add_flag("--json", options->json, "Print one JSON object: a law gives numbers, a medium lists [r, g, b]");
  add_allow_path(*command, options->allow_path);
  command->footer(law_list() +
                  "\nmu = 1 is straight on, mu = -1 straight back. A medium is taken at the origin.\n\n"
                  "Example: tyndall phase henyey_greenstein:g=0.7 --at 1,0,-1 --moments 4");
  command->callback([options] { phase(*options); });
}

}  // namespace tyndall
