// tyndall slab: light through a plane-parallel layer of a medium.
#include "tyndall/render/slab.h"

#include <charconv>
#include <iostream>
#include <memory>

#include "tyndall/cli/arguments.h"
#include "tyndall/cli/commands.h"
#include "tyndall/cli/number_list.h"
#include "tyndall/cli/table.h"
#include "tyndall/cli/warnings.h"
#include "tyndall/document/named_medium.h"
#include "tyndall/document/spelling.h"

namespace tyndall {
namespace {

struct SlabOptions {
  std::string medium, thickness, mu_text, illumination = "beam";
  double mu0 = 1.0, ground = 0.0;
  std::uint32_t spp = 1000000;
  std::uint64_t seed = 1;
  int threads = 0;
  bool json = false, allow_path = false;
};

double thickness_of(const std::string& text) {
  if (text == "inf") return infinity;
  double metres = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), metres);
  if (error != std::errc{} || end != text.data() + text.size() || !(metres > 0.0) || std::isinf(metres)) {
    throw Fault("--thickness", in_quotes(text), "a length in metres above 0, or inf");
  }
  return metres;
}

void print_json(const SlabRequest& request, const SlabResult& result) {
  OrderedJson out = OrderedJson::object(), errors = OrderedJson::object();
  const auto put = [&](const char* key, const Estimate& e) {
    out[key] = written(e.mean.value);
    errors[key] = written(e.standard_error.value);
  };
  put("reflectance", result.reflectance);
  put("transmittance_diffuse", result.transmittance_diffuse);
  out["transmittance_direct"] = written(result.transmittance_direct.value);
  if (!request.mu.empty()) {
    out["mu"] = request.mu;
    const auto list = [&](const char* key, const std::vector<Estimate>& estimates) {
      for (const Estimate& e : estimates) {
        out[key].push_back(written(e.mean.value));
        errors[key].push_back(written(e.standard_error.value));
      }
    };
    list("reflection", result.reflection);
    list("transmission", result.transmission);
  }
  out["standard_error"] = errors;
  std::cout << pretty(out);
}

void print_table(const SlabRequest& request, const SlabResult& result) {
  Table table;
  table.add({"share of the light", "red", "green", "blue", "error"});
  const auto row = [&](const std::string& name, const Estimate& e) {
    table.add({name, value_text(e.mean[0]), value_text(e.mean[1]), value_text(e.mean[2]),
               "\u00B1 " + value_text(largest(e.standard_error))});
  };
  row("reflected", result.reflectance);
  row("transmitted, scattered", result.transmittance_diffuse);
  row("transmitted, straight", {result.transmittance_direct, {}});
  for (std::size_t m = 0; m < request.mu.size(); ++m) {
    row("reflection R(mu = " + value_text(request.mu[m]) + ")", result.reflection[m]);
    row("transmission T(mu = " + value_text(request.mu[m]) + ")", result.transmission[m]);
  }
  std::cout << table.text();
}

void slab(const SlabOptions& options) {
  SlabRequest request;
  request.thickness = thickness_of(options.thickness);
  request.mu = numbers_from(options.mu_text, "--mu", 1e-6, 1.0);
  const MediumFile file = read_named_medium(options.medium, options.allow_path).file;
  request.medium = compile(file, options.medium);
  request.diffuse = options.illumination == "diffuse";
  request.mu0 = options.mu0;
  request.ground = options.ground;
  request.paths = options.spp;
  request.seed = options.seed;
  request.threads = options.threads;
  if (const auto objection = slab_objection(request)) {
    const bool medium = objection->field == "medium";
    throw Fault(medium ? place(options.medium) : "--" + objection->field, objection->found, objection->expected);
  }
  warn(file, options.medium);
  const SlabResult result = solve_slab(request);
  options.json ? print_json(request, result) : print_table(request, result);
}

}  // namespace

void add_slab(CLI::App& app) {
  auto options = std::make_shared<SlabOptions>();
  CLI::App* command = app.add_subcommand("slab", "Print how much light a layer of a medium reflects and lets through");
  command->add_option("MEDIUM", options->medium, "A medium file, or the name of a preset")->required();
  command->add_option("--thickness", options->thickness, "Thickness of the layer in metres, or inf")->required();
  command->add_option("--mu0", options->mu0, "Cosine of the beam to the vertical: 1 (default) is straight down")
      ->check(number_within(1e-6, 1.0));
  command->add_option("--mu", options->mu_text, "Cosines at which to print the radiance that leaves")
      ->type_name("MU,..");
  command->add_option("--ground", options->ground, "Albedo of the floor below; 0 (default) is black")
      ->check(number_within(0.0, 1.0));
  command
      ->add_option("--illumination", options->illumination, "beam (default), or diffuse: the same from the whole sky")
      ->check(word_of({"beam", "diffuse"}));
  command
      ->add_option("--spp", options->spp, "Light paths to trace (default 1000000); four times as many halve the error")
      ->check(whole_within(1, 4000000000u));
  add_seed(*command, options->seed);
  add_threads(*command, options->threads);
  add_allow_path(*command, options->allow_path);
  command->add_flag("--json", options->json, "Print one JSON object");
  command->footer(
      "A beam enters the top of a flat layer, black outside; all orders of scattering. Numbers are shares of the "
      "light\n"
      "on the layer; R(mu) and T(mu) are exit radiances, I = R mu0 E / pi for a beam of irradiance E. With --json "
      "each\n"
      "has its own standard_error: reflectance, transmittance_diffuse, and with --mu reflection and transmission.\n\n"
      "Example: tyndall slab examples/media/harbour_fog.medium.json --thickness 100 --mu0 0.3");
  command->callback([options] { slab(*options); });
}

}  // namespace tyndall
