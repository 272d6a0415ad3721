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
#include "tyndall/cli/company.h"
#include "tyndall/cli/frames.h"
#include "tyndall/cli/long_work.h"
#include "tyndall/cli/progress.h"
#include "tyndall/cli/scene_arguments.h"
#include "tyndall/document/spelling.h"
#include "tyndall/document/whole_file.h"
#include "tyndall/document/writing.h"
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
  LongWork long_work;
  bool quiet = false;
};

std::atomic<bool> interrupted{false};
std::atomic<int> stopping_signal{0};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free,
              "a signal handler may only touch lock-free atomics");

/// From now on the first Ctrl-C (SIGTERM, SIGUSR1) asks the renderer to stop; a second one ends the program as usual.
/// Nobody reading the progress any more is no reason to end at all.
void heed_signals() {
  struct sigaction stop {};
  stop.sa_handler = [](int signal) {
    stopping_signal = signal;
    interrupted = true;
  };
  stop.sa_flags = static_cast<int>(SA_RESETHAND);
  sigaction(SIGINT, &stop, nullptr);
  sigaction(SIGTERM, &stop, nullptr);
  sigaction(SIGUSR1, &stop, nullptr);  // mpirun passes it on; after the others it kills
  std::signal(SIGPIPE, SIG_IGN);
}

/// A Fault where the picture would take more memory than the machine has: better than being killed for it.
void check_memory(const Film& film) {
  // While sampling, a Pixel each; at the end, the planes as well (31 floats leave room for files being packed).
  constexpr double bytes_per_pixel = sizeof(Pixel) + 31 * sizeof(float);
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

Development looks_of(const RenderOptions& options) {
  return {options.exposure, options.tone == "none" ? Tone::none : Tone::filmic};
}

/// Writes them all even if one cannot be written: the others may be all that is left of a night's work.
void write_outputs(const RenderOptions& options, const std::vector<std::string>& outputs, const Image& image) {
  std::exception_ptr failure;
  for (const std::string& output : outputs) {
    try {
      if (std::filesystem::path(output).extension() == ".exr") {
        write_exr(output, image);
      } else {
        write_png(output, image, looks_of(options));
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

/// The pictures to be made: all that must be right before work begins.
struct Job {
  const RenderOptions& options;
  bool animated;
  Frames frames;
  SceneInTime timed;
  std::optional<Geometry> geometry;
  RenderSettings settings;
  InstructionSet common;

  /// Throws Fault.
  Job(const RenderOptions& o, bool chief, InstructionSet common_set)
      : options(o), animated(!o.frames.empty()), common(common_set) {
    std::optional<Film> film;
    if (!options.size.empty()) film = film_size(options.size);
    if (animated) frames = frames_from(options.frames);
    std::set<std::filesystem::path> seen;
    for (int frame = frames.first; frame <= frames.last && chief; ++frame)
      check_outputs(outputs_of(options.outputs, number(frame)), seen);
    SceneArguments arguments = options.scene;
    arguments.frame = number(frames.first);
    timed = scene_of(arguments, options.quiet || !chief);
    // A medium that is none in some picture, or a file that is missing, is better known now than after a night.
    for (int frame = frames.first; frame <= frames.last && animated; ++frame)
      medium_at(timed.media, time_of(scene(), frame), Grids::found);
    if (film) timed.scene.film = *film;
    check_memory(scene().film);
    geometry.emplace(scene());
    settings.integrator = options.integrator.empty() ? scene().integrator.name : options.integrator;
    settings.spp = options.spp > 0 ? options.spp : scene().integrator.spp;
    settings.max_depth = scene().integrator.max_depth;
    settings.threads = options.threads;
    settings.seed = options.seed;
    apply(options.long_work, options.spp > 0, settings);
  }
  Job(const Job&) = delete;
  Job& operator=(const Job&) = delete;

  const Scene& scene() const { return timed.scene; }
  /// The frame, where there are several.
  std::optional<int> number(int frame) const { return animated ? std::optional(frame) : std::nullopt; }
};

/// One of a job's pictures, under way.
struct Picture {
  CheckpointSubject subject;
  std::optional<FilmKeeper> keeper;  // the chief's
  SampleFilm samples{1, 1};

  /// Throws Fault.
  Picture(Job& job, int frame, bool chief) {
    if (job.animated && set_time(job.timed, time_of(job.scene(), frame))) job.geometry.emplace(job.scene());
    subject = subject_of(job.scene(), job.settings, job.common);
    if (!chief) return;
    LongWork files = job.options.long_work;
    if (job.animated && !files.checkpoint.empty()) files.checkpoint = numbered(files.checkpoint, frame);
    keeper.emplace(files, subject, [&job](const std::filesystem::path& file, const SampleFilm& now) {
      write_png(file, developed(now, job.scene(), job.settings, false), looks_of(job.options));
    });
    samples = keeper->film();
  }
  Picture(const Picture&) = delete;
  Picture& operator=(const Picture&) = delete;
};

/// What is shown of all pictures, from the first on.
struct Shown {
  explicit Shown(bool quiet) : bar(quiet) {}
  ProgressBar bar;
  double seconds_before = 0.0;
};

/// The chief's part: renders a picture and writes it. True where it came to its end.
bool make_picture(const Job& job, Picture& picture, int frame, Company& company, Shown& shown) {
  double seconds = 0.0;
  RenderHooks hooks;
  hooks.report = [&](const RenderProgress& p) {
    seconds = p.seconds;
    shown.bar.show((frame - job.frames.first + p.fraction) / job.frames.count(), shown.seconds_before + seconds,
                   progress_text(p, job.frames, job.number(frame)));
  };
  hooks.wants_film = [&] { return picture.keeper->is_due(); };
  hooks.save = [&](const SampleFilm& now) { picture.keeper->save(now); };
  hooks.stop = &interrupted;
  hooks.helpers = company.helpers();
  const bool ended = render(job.scene(), *job.geometry, job.settings, picture.samples, hooks);
  company.dismiss();
  shown.seconds_before += seconds;
  // Both, even if one cannot be written.
  std::exception_ptr failure;
  try {
    picture.keeper->finish(picture.samples);
  } catch (...) {
    failure = std::current_exception();
  }
  write_outputs(job.options, outputs_of(job.options.outputs, job.number(frame)),
                developed(picture.samples, job.scene(), job.settings, ended));
  if (failure) std::rethrow_exception(failure);
  return ended;
}

void render_scene(const RenderOptions& options) {
  Company company;
  std::optional<Job> job;
  const InstructionSet common = company.common_instruction_set(options.quiet);
  company.together([&] { job.emplace(options, company.chief(), common); });
  std::optional<Shown> shown;
  bool ended = true;
  int frame = job->frames.first;
  for (;; ++frame) {
    std::optional<Picture> picture;
    company.together([&] { picture.emplace(*job, frame, company.chief()); });
    company.agree_on(written(picture->subject).dump(), "picture");
    if (company.chief()) {
      heed_signals();
      if (!shown) shown.emplace(options.quiet);
      ended = make_picture(*job, *picture, frame, company, *shown);
    } else {
      company.serve(job->scene(), *job->geometry, job->settings);
    }
    if (!company.all_go_on(ended) || frame == job->frames.last) break;
  }
  company.leave();
  if (ended || !company.chief()) return;
  shown.reset();
  if (!options.quiet) {
    const std::string which = job->animated ? " at frame " + std::to_string(frame) + "; its" : "; the";
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
      ->allow_extra_args(false)  // what follows the name is an argument of its own, such as the scene
      ->required();
  command->add_option("--spp", options->spp, "Samples per pixel: four times as many halve the noise")
      ->check(whole_within(1, 1 << 24));
  command->add_option("--size", options->size, "Width and height in pixels, such as 1280x720");
  command
      ->add_option("--integrator", options->integrator,
                   "path: all light, noisy at first; single: one scattering, no noise")
      ->check(word_of({integrator_names.begin(), integrator_names.end()}));
  command->add_option("--exposure", options->exposure, "Brighter (+) or darker (-) in stops, .png only (default 0)")
      ->check(number_within(-60.0, 60.0));
  command->add_option("--tone", options->tone, "filmic (default): highlights roll off; none: cut at white; .png only")
      ->check(word_of({tone_names.begin(), tone_names.end()}));
  add_threads(*command, options->threads);
  add_seed(*command, options->seed);
  add_long_work(*command, options->long_work);
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
