// tyndall render: pictures of scenes.
#include "tyndall/render/render.h"

#include <unistd.h>

#include <charconv>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <exception>
#include <memory>
#include <optional>
#include <set>

#include "tyndall/cli/arguments.h"
#include "tyndall/cli/commands.h"
#include "tyndall/cli/progress.h"
#include "tyndall/cli/scene_arguments.h"
#include "tyndall/document/spelling.h"
#include "tyndall/document/whole_file.h"
#include "tyndall/image/exr.h"
#include "tyndall/image/png.h"
#include "tyndall/render/film.h"
#include "tyndall/scene/scene_description.h"

namespace tyndall {
namespace {

struct RenderOptions {
  SceneArguments scene;
  std::string frames, size, integrator, tone = "filmic";
  std::vector<std::string> outputs;
  int spp = 0, threads = 0;
  double exposure = 0.0;
  std::uint64_t seed = 1;
  bool quiet = false;
};

std::atomic<bool> interrupted{false};
std::atomic<int> stopping_signal{0};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free,
              "a signal handler may only touch lock-free atomics");

/// From now on the first Ctrl-C (or SIGTERM) asks the renderer to stop; a second one ends the program as usual. Nobody
/// reading the progress any more is no reason to end at all.
void heed_signals() {
  struct sigaction stop {};
  stop.sa_handler = [](int signal) {
    stopping_signal = signal;
    interrupted = true;
  };
  stop.sa_flags = static_cast<int>(SA_RESETHAND);
  sigaction(SIGINT, &stop, nullptr);
  sigaction(SIGTERM, &stop, nullptr);
  std::signal(SIGPIPE, SIG_IGN);
}

/// A Fault where the picture would take more memory than the machine has: better than being killed for it.
void check_memory(const Film& film) {
  // While sampling, a Pixel each; at the end, the planes as well (22 floats leave room for files being packed).
  constexpr double bytes_per_pixel = sizeof(Pixel) + 22 * sizeof(float);
  const double need = bytes_per_pixel * film.width * film.height;
  const double have = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  if (need <= have) return;
  const auto gigabytes = [](double bytes) { return std::to_string(std::lround(bytes / 1e9)) + " GB"; };
  throw Fault("film",
              std::to_string(film.width) + "x" + std::to_string(film.height) + " pixels, which take " + gigabytes(need),
              "a picture that fits into this machine's " + gigabytes(have));
}

Film film_size(const std::string& text) {
  Film film;
  const char* const end = text.data() + text.size();
  const auto width = std::from_chars(text.data(), end, film.width);
  if (width.ec == std::errc{} && width.ptr != end && *width.ptr == 'x') {
    const auto height = std::from_chars(width.ptr + 1, end, film.height);
    const auto fits = [](int n) { return n >= 1 && n <= 16384; };
    if (height.ec == std::errc{} && height.ptr == end && fits(film.width) && fits(film.height)) {
      if (const auto objection = objection_to(film)) throw Fault("--size", objection->found, objection->expected);
      return film;
    }
  }
  throw Fault("--size", in_quotes(text), "WIDTHxHEIGHT in pixels, each from 1 to 16384, such as 1280x720");
}

/// The pictures of an animation: from the first to the last, both included.
struct Frames {
  int first = 0, last = 0;
  int count() const { return last - first + 1; }
};

Frames frames_from(const std::string& text) {
  constexpr int most = 99999;
  Frames frames;
  const char* const end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, frames.first);
  if (first.ec == std::errc{} && first.ptr != end && *first.ptr == '-') {
    const auto last = std::from_chars(first.ptr + 1, end, frames.last);
    if (last.ec == std::errc{} && last.ptr == end && frames.first >= 0 && frames.first <= frames.last &&
        frames.last <= most) {
      return frames;
    }
  }
  throw Fault(
      "--frames", in_quotes(text),
      "FIRST-LAST, such as 0-47: whole numbers up to " + std::to_string(most) + ", the last not before the first");
}

/// A picture of an animation: fog.exr as fog.0012.exr.
std::string numbered(const std::string& output, int frame) {
  char digits[16];
  std::snprintf(digits, sizeof digits, ".%04d", frame);
  const std::filesystem::path path(output);
  return (path.parent_path() / (path.stem().string() + digits + path.extension().string())).string();
}

/// The pictures of one frame; of what is no animation, the outputs themselves.
std::vector<std::string> outputs_of(const std::vector<std::string>& outputs, const std::optional<int>& frame) {
  std::vector<std::string> names;
  for (const std::string& output : outputs) names.push_back(frame ? numbered(output, *frame) : output);
  return names;
}

/// Everything about the outputs that can be known before the work.
void check_outputs(const std::vector<std::string>& outputs, std::set<std::filesystem::path>& seen) {
  for (const std::string& output : outputs) {
    const std::filesystem::path path(output);
    if (const std::string kind = path.extension().string(); kind != ".exr" && kind != ".png") {
      throw Fault("--output", "the file name " + in_quotes(output), "a name ending in .exr or .png");
    }
    check_writable(output);
    if (!seen.insert(std::filesystem::weakly_canonical(std::filesystem::absolute(output))).second) {
      throw Fault("--output", "the file " + in_quotes(output) + " a second time", "each file once");
    }
  }
}

/// Writes them all even if one cannot be written: the others may be all that is left of a night's work.
void write_outputs(const RenderOptions& options, const std::vector<std::string>& outputs, const Image& image) {
  std::exception_ptr failure;
  for (const std::string& output : outputs) {
    try {
      if (std::filesystem::path(output).extension() == ".exr") {
        write_exr(output, image);
      } else {
        write_png(output, image, {options.exposure, options.tone == "none" ? Tone::none : Tone::filmic});
      }
    } catch (...) {
      if (!failure) failure = std::current_exception();
    }
  }
  if (failure) std::rethrow_exception(failure);
}

/// What the bar says of the work on a picture, which may be one of several.
std::string progress_text(const RenderProgress& p, const Frames& frames, const std::optional<int>& frame) {
  char text[96] = "";
  if (p.noise > 0.0) std::snprintf(text, sizeof text, "%d samples, noise %.1f %%", p.spp, 100.0 * p.noise);
  if (!frame) return text;
  return "frame " + std::to_string(*frame) + " (" + std::to_string(*frame - frames.first + 1) + " of " +
         std::to_string(frames.count()) + ")" + (p.noise > 0.0 ? ", " : "") + text;
}

void render_scene(RenderOptions options) {
  std::optional<Film> film;
  if (!options.size.empty()) film = film_size(options.size);
  const bool animated = !options.frames.empty();
  const Frames frames = animated ? frames_from(options.frames) : Frames{};
  const auto number = [&](int frame) { return animated ? std::optional(frame) : std::nullopt; };
  std::set<std::filesystem::path> seen;
  for (int frame = frames.first; frame <= frames.last; ++frame) {
    check_outputs(outputs_of(options.outputs, number(frame)), seen);
  }
  options.scene.frame = number(frames.first);
  SceneInTime timed = scene_of(options.scene, options.quiet);
  Scene& scene = timed.scene;
  // A medium that is none in some picture is better known now than after a night.
  for (int frame = frames.first; frame <= frames.last && animated; ++frame) {
    medium_at(timed.media, time_of(scene, frame));
  }
  if (film) scene.film = *film;
  check_memory(scene.film);
  const Geometry geometry(scene);
  RenderSettings settings;
  settings.integrator = options.integrator.empty() ? scene.integrator.name : options.integrator;
  settings.spp = options.spp > 0 ? options.spp : scene.integrator.spp;
  settings.max_depth = scene.integrator.max_depth;
  settings.threads = options.threads;
  settings.seed = options.seed;
  heed_signals();
  int frame = frames.first;
  {
    ProgressBar bar(options.quiet);
    double seconds_before = 0.0;
    for (;; ++frame) {
      if (animated) set_time(timed, time_of(scene, frame));
      double seconds = 0.0;
      const Image image = render(
          scene, geometry, settings,
          [&](const RenderProgress& p) {
            seconds = p.seconds;
            bar.show((frame - frames.first + p.fraction) / frames.count(), seconds_before + seconds,
                     progress_text(p, frames, number(frame)));
          },
          &interrupted);
      write_outputs(options, outputs_of(options.outputs, number(frame)), image);
      seconds_before += seconds;
      if (interrupted || frame == frames.last) break;
    }
  }
  if (!interrupted) return;
  if (!options.quiet) {
    const std::string which = animated ? " at frame " + std::to_string(frame) + "; its" : "; the";
    std::fprintf(stderr, "stopped%s picture has the samples taken until then\n", which.c_str());
  }
  throw CLI::RuntimeError(128 + stopping_signal);
}

}  // namespace

void add_render(CLI::App& app) {
  auto options = std::make_shared<RenderOptions>();
  CLI::App* command = app.add_subcommand("render", "Make a picture of a scene");
  add_scene_arguments(*command, options->scene);
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
      ->check(number_within(-60.0, 60.0));
  command->add_option("--tone", options->tone, "filmic (default): highlights roll off; none: cut at white; .png only")
      ->check(CLI::IsMember(std::vector<std::string>(tone_names.begin(), tone_names.end())));
  add_threads(*command, options->threads);
  add_seed(*command, options->seed);
  command
      ->add_option("--frames", options->frames,
                   "Pictures of an animation, numbered: fog.exr as fog.0012.exr; picture n is that of time n / fps")
      ->type_name("A-B")
      ->excludes("--time");
  command->add_flag("--quiet", options->quiet, "No progress, no warnings");
  command->footer(
      "A scene is a .scene.json, or a .glb or .gltf of any modelling program. Ctrl-C stops early and writes the "
      "picture as it is (exit code 130); of several, the one it is at.\n\n"
      "Example: tyndall render examples/street.scene.json --medium examples/media/street_w100.medium.json -o "
      "street.png");
  command->callback([options] { render_scene(*options); });
}

}  // namespace tyndall
