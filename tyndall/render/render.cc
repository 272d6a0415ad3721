#include "tyndall/render/render.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <memory>

#include "tyndall/render/camera.h"
#include "tyndall/render/film.h"
#include "tyndall/render/parallel.h"
#include "tyndall/render/path.h"
#include "tyndall/render/single.h"

namespace tyndall {
namespace {

constexpr int tile_size = 16;

struct Tile {
  int x0, y0, x1, y1;
};

std::vector<Tile> tiles_of(const SampleFilm& film, std::uint32_t order) {
  std::vector<Tile> tiles;
  for (int y = 0; y < film.height(); y += tile_size) {
    for (int x = 0; x < film.width(); x += tile_size) {
      tiles.push_back({x, y, std::min(x + tile_size, film.width()), std::min(y + tile_size, film.height())});
    }
  }
  if (order != 0) {
    RandomStream random(order, 0, 0);
    for (std::size_t i = tiles.size(); i > 1; --i) {
      std::swap(tiles[i - 1], tiles[static_cast<std::size_t>(random.next() * static_cast<double>(i))]);
    }
  }
  return tiles;
}

/// How many samples each pixel has after the pass that follows `done`. The first gives something to look at soon;
/// later ones grow, so that passes cost little. Always the same numbers (1, 2, 3, 4, 6, 9, ..): a picture that ends at
/// a given noise then ends with the same samples however often it was interrupted.
int next_level(int done) {
  int level = 0;
  while (level <= done) level += std::max(1, level / 2);
  return level;
}

/// What a picture of `single` shows: six digits at most; probes ask for more (probe.cc).
SingleSettings picture_settings() { return {.tolerance = 1e-6, .sky_directions = 128}; }

class Rendering {
 public:
  Rendering(const Scene& scene, const Geometry& geometry, const RenderSettings& settings, SampleFilm& film,
            const RenderHooks& hooks)
      : geometry_(geometry),
        settings_(settings),
        film_(film),
        hooks_(hooks),
        camera_(scene.camera, scene.film),
        tiles_(tiles_of(film, settings.tile_order)) {}

  /// Passes until an end; trace(x, y, sample, thread) adds the next sample of a pixel.
  template <class AddSample>
  bool passes(int spp, AddSample add) {
    spp_ = spp;
    int done = least_samples();
    tell(done, true);
    while (!stopped() && done < spp && !quiet_enough(done)) {
      const double begun = elapsed();
      const int level = std::min({spp, next_level(done), level_in_time(done)});
      while (least_samples() < level && !stopped()) {
        pass(level, add);
        if (wanted_) {
          hooks_.save(film_);
          wanted_ = false;
        }
      }
      if (stopped()) break;
      seconds_per_sample_ = (elapsed() - begun) / (level - done);
      done = level;
      tell(done, true);
    }
    const bool ended = !asked_to_stop();
    if (hooks_.report && ended) hooks_.report({1.0, elapsed(), noise_, done});
    return ended;
  }

  const CameraRays& camera() const { return camera_; }

 private:
  using Clock = std::chrono::steady_clock;

  double elapsed() const { return std::chrono::duration<double>(Clock::now() - begun_).count(); }
  int least_samples() const { return static_cast<int>(film_.samples_taken().first); }
  bool asked_to_stop() const { return hooks_.stop != nullptr && hooks_.stop->load(); }
  bool stopped() const { return late_ || asked_to_stop(); }
  bool quiet_enough(int done) const {
    // The noise of few samples is not known well; by chance it is 0.
    constexpr int enough_to_judge = 8;
    return settings_.until_noise > 0.0 && done >= enough_to_judge && noise_ <= settings_.until_noise;
  }
  /// How far to go in the time left, so that pixels end with the same number of samples if they can.
  int level_in_time(int done) const {
    if (!(settings_.seconds > 0.0) || !(seconds_per_sample_ > 0.0)) return std::numeric_limits<int>::max();
    const double samples = (settings_.seconds - elapsed()) / seconds_per_sample_;
    return done + std::max(1, static_cast<int>(std::min(samples, 1e9)));
  }

  /// Brings every pixel to `level` samples, or as many until somebody wants something else.
  template <class AddSample>
  void pass(int level, AddSample& add) {
    std::atomic<std::size_t> finished{0};
    for_each_block(tiles_.size(), thread_count(settings_.threads), [&](std::size_t i, int thread) {
      const Tile& tile = tiles_[i];
      for (int y = tile.y0; y < tile.y1; ++y) {
        for (int x = tile.x0; x < tile.x1; ++x) {
          Pixel& pixel = film_.at(x, y);
          if (static_cast<int>(pixel.samples) >= level) continue;
          if (thread == 0) watch();
          while (static_cast<int>(pixel.samples) < level && !stopped() && !wanted_) add(x, y, pixel, thread);
        }
      }
      ++finished;
      if (thread == 0 && !wanted_)
        tell(done_ + (level - done_) * static_cast<double>(finished) / static_cast<double>(tiles_.size()), false);
    });
  }

  /// What the calling thread sees to between pixels.
  void watch() {
    if (settings_.seconds > 0.0 && elapsed() > settings_.seconds) late_ = true;
    if (hooks_.wants_film && hooks_.wants_film()) wanted_ = true;
  }

  /// The share of what is asked for that is done, by whichever end comes first.
  double fraction(double samples) const {
    double share = samples / spp_;
    if (settings_.seconds > 0.0) share = std::max(share, elapsed() / settings_.seconds);
    // Noise falls with the square root of the samples.
    if (settings_.until_noise > 0.0 && noise_ > 0.0 && done_ > 0) {
      const double needed = done_ * noise_ * noise_ / (settings_.until_noise * settings_.until_noise);
      share = std::max(share, samples / needed);
    }
    return std::min(share, 0.999);  // 1 is said once, at the end
  }

  void tell(double samples, bool pass_is_over) {
    // Only between passes does no thread write to the film.
    if (pass_is_over) {
      noise_ = film_.noise();
      done_ = static_cast<int>(samples);
    }
    const auto now = Clock::now();
    if (!hooks_.report || now - told_ < std::chrono::milliseconds(100)) return;
    told_ = now;
    hooks_.report({fraction(samples), elapsed(), noise_, done_});
  }

  const Geometry& geometry_;
  const RenderSettings& settings_;
  SampleFilm& film_;
  const RenderHooks& hooks_;
  CameraRays camera_;
  std::vector<Tile> tiles_;
  Clock::time_point begun_ = Clock::now(), told_{};
  std::atomic<bool> late_{false}, wanted_{false};
  int spp_ = 1, done_ = 0;
  double noise_ = 0.0, seconds_per_sample_ = 0.0;
};

}  // namespace

bool render(const Scene& scene, const Geometry& geometry, const RenderSettings& settings, SampleFilm& film,
            const RenderHooks& hooks) {
  Rendering rendering(scene, geometry, settings, film, hooks);
  if (settings.integrator == "single") {
    const SingleContext context(scene, geometry, picture_settings());
    // One sample, exact but for its quadratures; `spp` says how finely pixels that see a lamp average their footprint.
    return rendering.passes(
        1, [&](int x, int y, Pixel& pixel, int) { SampleFilm::set(pixel, single_pixel(context, x, y, settings.spp)); });
  }
  const PathContext context(scene, geometry, settings.max_depth);
  std::vector<std::unique_ptr<PathTracer>> tracers;
  for (int i = 0; i < thread_count(settings.threads); ++i) tracers.push_back(std::make_unique<PathTracer>(context));
  const CameraRays& camera = rendering.camera();
  return rendering.passes(settings.spp, [&](int x, int y, Pixel& pixel, int thread) {
    if (pixel.samples == 0) {
      const auto hit = geometry.intersect(camera.through(x + 0.5, y + 0.5));
      pixel.depth = hit ? hit->t : infinity;
    }
    const auto number =
        static_cast<std::uint64_t>(y) * static_cast<std::uint64_t>(film.width()) + static_cast<std::uint64_t>(x);
    RandomStream random(settings.seed, number, pixel.samples, RandomStream::Samples::even);
    const double dx = random.next(), dy = random.next();
    PathTracer& tracer = *tracers[static_cast<std::size_t>(thread)];
    SampleFilm::add(pixel, tracer.trace(camera.through(x + dx, y + dy), infinity, random));
  });
}

Image developed(const SampleFilm& film, const RenderSettings& settings) {
  Image image = film.develop();
  const bool single = settings.integrator == "single";
  const auto [least, most] = film.samples_taken();
  const std::string samples =
      least == most ? std::to_string(least) : std::to_string(least) + " to " + std::to_string(most);
  image.notes = {{"tyndall.integrator", settings.integrator},
                 {"tyndall.spp", single ? std::to_string(settings.spp) : samples},
                 {"tyndall.seed", std::to_string(settings.seed)},
                 {"tyndall.max_depth", settings.max_depth == 0 ? "none" : std::to_string(settings.max_depth)}};
  if (single) image.notes.emplace_back("tyndall.quadrature", single_description(picture_settings()));
  if (least < (single ? 1u : static_cast<unsigned>(settings.spp))) {
    image.notes.emplace_back("tyndall.stopped", "before all samples were taken: pixels have " + samples + " of " +
                                                    std::to_string(single ? 1 : settings.spp));
  }
  return image;
}

Image render(const Scene& scene, const Geometry& geometry, const RenderSettings& settings,
             const std::function<void(const RenderProgress&)>& report, const std::atomic<bool>* stop) {
  SampleFilm film(scene.film.width, scene.film.height);
  render(scene, geometry, settings, film, {report, {}, {}, stop});
  return developed(film, settings);
}

}  // namespace tyndall
