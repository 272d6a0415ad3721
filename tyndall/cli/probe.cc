// tyndall probe: the radiance along one ray of a scene, or the fluence rate at a point.
#include <iostream>
#include <memory>

#include "tyndall/cli/arguments.h"
#include "tyndall/cli/commands.h"
#include "tyndall/cli/number_list.h"
#include "tyndall/cli/scene_arguments.h"
#include "tyndall/cli/table.h"
#include "tyndall/document/fault.h"
#include "tyndall/document/spelling.h"
#include "tyndall/document/writing.h"
#include "tyndall/render/path.h"
#include "tyndall/render/single.h"

namespace tyndall {
namespace {

struct ProbeOptions {
  SceneArguments scene;
  std::string origin, direction, integrator = "single";
  double distance = infinity;
  std::uint32_t spp = 65536;
  std::uint64_t seed = 1;
  int threads = 0;
  bool fluence = false, json = false;
};

Vector vector_from(const std::string& text, const std::string& option) {
  const std::vector<double> xyz = three_numbers_from(text, option);
  return {xyz[0], xyz[1], xyz[2]};
}

/// One ray is worth finer quadratures of sky and glowing surfaces than every pixel of a picture.
SingleSettings finer() {
  SingleSettings settings;
  settings.sky_directions = settings.surface_directions = 4096;
  settings.emissive_points = 1024;
  settings.sky_suns = 512;
  settings.sun_rings = 6;
  settings.sun_azimuth = 16;
  return settings;
}

ProbeEstimate estimate(const ProbeOptions& options, const Scene& scene, const Ray& ray, double distance) {
  const Geometry geometry(scene);
  if (options.integrator == "path") {
    const PathContext context(scene, geometry, scene.integrator.max_depth, 1.0);
    return options.fluence ? path_fluence(context, ray.origin, options.spp, options.seed, options.threads)
                           : path_probe(context, ray, distance, options.spp, options.seed, options.threads);
  }
  // A fluence integrates thousands of rays: there the ordinary settings do.
  const SingleContext context(scene, geometry, options.fluence ? SingleSettings{} : finer());
  if (options.fluence) {
    return {single_fluence(context, ray.origin), {}, Spectrum::grey(1.0)};
  }
  const PixelLayers layers = single_radiance(context, ray, distance);
  return {layers.surface + layers.single, {}, layers.transmittance};
}

void print(const ProbeOptions& options, const ProbeEstimate& result) {
  const char* const what = options.fluence ? "fluence rate" : "radiance";
  if (options.json) {
    OrderedJson out = OrderedJson::object();
    out["radiance"] = written(result.radiance.value);
    if (options.fluence) out["fluence"] = out["radiance"];
    out["standard_error"] = written(result.standard_error.value);
    out["transmittance"] = written(result.transmittance.value);
    std::cout << pretty(out);
    return;
  }
  Table table;
  table.add({"", "red", "green", "blue"});
  const auto row = [&](const std::string& name, const Spectrum& s) {
    table.add({name, value_text(s[0]), value_text(s[1]), value_text(s[2])});
  };
  row(what, result.radiance);
  if (options.integrator == "path") row("standard error", result.standard_error);
  if (!options.fluence) row("transmittance", result.transmittance);
  std::cout << table.text();
}

void probe(const ProbeOptions& options) {
  Vector direction{0.0, 1.0, 0.0};
  if (!options.direction.empty()) {
    direction = vector_from(options.direction, "--direction");
    const double largest_part = std::max({std::fabs(direction.x), std::fabs(direction.y), std::fabs(direction.z)});
    if (!(largest_part > 0.0)) throw Fault("--direction", in_quotes(options.direction), "a direction, not all of it 0");
    direction = normalized(direction / largest_part);  // however long or short it was
  } else if (!options.fluence) {
    throw Fault("--direction", "nothing", "the direction to look in, as x,y,z");
  }
  const Vector origin = vector_from(options.origin, "--origin");
  const Scene scene = scene_of(options.scene);
  const double metres = scene.meters_per_unit;
  print(options, estimate(options, scene, {origin * metres, direction}, options.distance * metres));
}

}  // namespace

void add_probe(CLI::App& app) {
  auto options = std::make_shared<ProbeOptions>();
  CLI::App* command = app.add_subcommand("probe", "Measure the light that arrives at a point of a scene");
  add_scene_arguments(*command, options->scene);
  command->add_option("--origin", options->origin, "Where to measure: x,y,z in the scene's units")->required();
  command->add_option("--direction", options->direction, "Which way to look: x,y,z, of any length");
  command
      ->add_option("--distance", options->distance,
                   "Look only that far, in the scene's units; without it, to the first surface or the sky")
      ->check([](const std::string& text) {
        double value = 0.0;
        if (CLI::detail::lexical_cast(text, value) && value > 0.0) return std::string();
        return "found " + in_quotes(text) + ", expected a number above 0";
      });
  command
      ->add_option("--integrator", options->integrator,
                   "single (default): light scattered at most once, exact; path: all light, with a standard error")
      ->check(word_of({integrator_names.begin(), integrator_names.end()}));
  command->add_option("--spp", options->spp, "Samples of path (default 65536); four times as many halve the error")
      ->check(whole_within(2, 4000000000u));
  command->add_flag("--fluence", options->fluence,
                    "Add up the light from all directions [W/m^2] instead of looking in one");
  add_seed(*command, options->seed);
  add_threads(*command, options->threads);
  command->add_flag("--json", options->json, "Print one JSON object");
  command->footer(
      "Radiance is in W/(m^2 sr) per channel. With --distance, nothing at or beyond it is added, but lights and air\n"
      "beyond it still light what is before it. A ray through a lamp sees infinity (null in JSON).\n\n"
      "Example: tyndall probe examples/street.scene.json --origin 0,1.6,10 --direction 0,0.05,-1 --json");
  command->callback([options] { probe(*options); });
}

}  // namespace tyndall
