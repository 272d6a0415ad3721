// tyndall render: pictures of scenes.
#include "tyndall/render/render.h"

#include <charconv>
#include <csignal>
#include <cstdio>
#include <memory>

#include "tyndall/cli/commands.h"
#include "tyndall/cli/progress.h"
#include "tyndall/document/spelling.h"
#include "tyndall/image/exr.h"
#include "tyndall/image/png.h"
#include "tyndall/scene/scene_file.h"

namespace tyndall {
namespace {

struct RenderOptions {
  std::string scene, medium, size, integrator, tone = "filmic";
  std::vector<std::string> outputs;
  int spp = 0, threads = 0;
  double exposure = 0.0;
  std::uint64_t seed = 1;
  bool quiet = false, allow_path = false;
};

std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may only touch lock-free atomics");

/// While it lives, the first Ctrl-C asks the renderer to stop; a second one ends the program as usual.
class InterruptGuard {
 public:
  InterruptGuard() {
    struct sigaction action {};
    action.sa_handler = [](int) { interrupted = true; };
    action.sa_flags = static_cast<int>(SA_RESETHAND);
    sigaction(SIGINT, &action, &before_);
  }
  ~InterruptGuard() { sigaction(SIGINT, &before_, nullptr); }
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

 private:
  struct sigaction before_ {};
};

Film film_size(const std::string& text) {
  Film film;
  const char* const end = text.data() + text.size();
  const auto width = std::from_chars(text.data(), end, film.width);
  if (width.ec == std::errc{} && width.ptr != end && *width.ptr == 'x') {
    const auto height = std::from_chars(width.ptr + 1, end, film.height);
    const auto fits = [](int n) { return n >= 1 && n <= 16384; };
    if (height.ec == std::errc{} && height.ptr == end && fits(film.width) && fits(film.height)) return film;
  }
  throw Fault("--size", in_quotes(text), "WIDTHxHEIGHT in pixels, each from 1 to 16384, such as 1280x720");
}

void render_scene(const RenderOptions& options) {
  for (const std::string& output : options.outputs) {
    if (const std::string kind = std::filesystem::path(output).extension().string(); kind != ".exr" && kind != ".png") {
      throw Fault("--output", "the file name " + in_quotes(output), "a name ending in .exr or .png");
    }
  }
  Scene scene = read_scene(options.scene, {options.medium, options.allow_path});
  for (const std::string& warning : scene.warnings) std::fprintf(stderr, "warning: %s\n", warning.c_str());
  if (!options.size.empty()) scene.film = film_size(options.size);
  const Geometry geometry(scene);
  RenderSettings settings;
  settings.integrator = options.integrator.empty() ? scene.integrator.name : options.integrator;
  settings.spp = options.spp > 0 ? options.spp : scene.integrator.spp;
  settings.max_depth = scene.integrator.max_depth;
  settings.threads = options.threads;
  settings.seed = options.seed;
  Image image;
  {
    const InterruptGuard guard;
    ProgressBar bar(options.quiet);
    image = render(
        scene, geometry, settings,
        [&](const RenderProgress& p) {
          char detail[64] = "";
          if (p.noise > 0.0) std::snprintf(detail, sizeof detail, "%d samples, noise %.1f %%", p.spp, 100.0 * p.noise);
          bar.show(p.fraction, p.seconds, detail);
        },
        &interrupted);
  }
  for (const std::string& output : options.outputs) {
    if (std::filesystem::path(output).extension() == ".exr") {
      write_exr(output, image);
    } else {
      write_png(output, image, {options.exposure, options.tone == "none" ? Tone::none : Tone::filmic});
    }
  }
  if (interrupted && !options.quiet) std::fprintf(stderr, "stopped; the picture has the samples taken until then\n");
}

}  // namespace

void add_render(CLI::App& app) {
  auto options = std::make_shared<RenderOptions>();
  CLI::App* command = app.add_subcommand("render", "Make a picture of a scene");
  command->add_option("SCENE", options->scene, "A .scene.json, .glb or .gltf file")->required();
  command->add_option("--medium", options->medium, "The air: a medium file, instead of the scene's own");
  command
      ->add_option("-o,--output", options->outputs,
                   "Where to write: .exr (all layers, linear) or .png (to look at); may be given twice")
      ->required();
  command->add_option("--spp", options->spp, "Samples per pixel: four times as many halve the noise")
      ->check(CLI::Range(1, 1 << 24));
  command->add_option("--size", options->size, "Width and height in pixels, such as 1280x720");
  command
      ->add_option("--integrator", options->integrator,
                   "path: all light, noisy at first; single: one scattering, no noise")
      ->check(CLI::IsMember(std::vector<std::string>(integrator_names.begin(), integrator_names.end())));
  command->add_option("--exposure", options->exposure, "Brighter (+) or darker (-) in stops, .png only (default 0)")
      ->check(CLI::Range(-60.0, 60.0));
  command->add_option("--tone", options->tone, "filmic (default): highlights roll off; none: cut at white; .png only")
      ->check(CLI::IsMember(std::vector<std::string>(tone_names.begin(), tone_names.end())));
  command
      ->add_option("--threads", options->threads, "Processor threads (default: all); the picture does not depend on it")
      ->check(CLI::Range(1, 1024));
  command->add_option("--seed", options->seed, "Another number gives other noise (default 1)");
  command->add_flag("--quiet", options->quiet, "No progress");
  command->add_flag("--allow-path", options->allow_path,
                    "Follow references to files outside the folder of the file that names them");
  command->footer(
      "A scene is a .scene.json, or a .glb or .gltf of any modelling program. Ctrl-C stops early and writes the "
      "picture as it is.\n\n"
      "Example: tyndall render examples/street.scene.json --medium examples/media/street_w100.medium.json -o "
      "street.png");
  command->callback([options] { render_scene(*options); });
}

}  // namespace tyndall
