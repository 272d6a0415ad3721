#include "tyndall/render/render.h"

#include <chrono>
#include <memory>
#include <mutex>

#include "tyndall/render/camera.h"
#include "tyndall/render/film.h"
#include "tyndall/render/parallel.h"
#include "tyndall/render/path.h"
#include "tyndall/render/single.h"

namespace tyndall {
namespace {

constexpr int tile_size = 16;

/// Paths to learn from: a sixteenth of all, within limits.
constexpr std::uint64_t least_lessons = 1u << 11, most_lessons = 1u << 16;

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

/// Samples per pass: the first gives something to look at soon; later ones grow, so that passes cost little.
int pass_size(int done, int spp) { return std::min(spp - done, std::max(1, done / 2)); }

class Rendering {
 public:
  Rendering(const RenderSettings& settings, const std::function<void(const RenderProgress&)>& report,
            const std::atomic<bool>* stop)
      : settings_(settings), report_(report), stop_(stop) {}

  bool stopped() const { return stop_ != nullptr && stop_->load(); }

  /// Calls work(tile, thread) for all tiles of one pass of `samples`, reporting from the calling thread (thread 0).
  template <class Work>
  void pass(const SampleFilm& film, const std::vector<Tile>& tiles, int samples, Work work) {
    std::atomic<std::size_t> finished{0};
    for_each_block(tiles.size(), thread_count(settings_.threads), [&](std::size_t i, int thread) {
      if (stopped()) return;
      work(tiles[i], thread);
      ++finished;
      if (thread == 0)
        tell(film,
             (done_ + samples * static_cast<double>(finished) / static_cast<double>(tiles.size())) / settings_.spp,
             false);
    });
    done_ += samples;
    tell(film, static_cast<double>(done_) / settings_.spp, true);
  }

 private:
  using Clock = std::chrono::steady_clock;
  void tell(const SampleFilm& film, double fraction, bool pass_is_over) {
    const auto now = Clock::now();
    if (!report_ || (now - told_ < std::chrono::milliseconds(100) && fraction < 1.0)) return;
    told_ = now;
    // Only between passes does no thread write to the film.
    if (pass_is_over) noise_ = film.noise();
    report_({fraction, std::chrono::duration<double>(now - begun_).count(), noise_, done_});
  }

  const RenderSettings& settings_;
  const std::function<void(const RenderProgress&)>& report_;
  const std::atomic<bool>* stop_;
  Clock::time_point begun_ = Clock::now(), told_{};
  int done_ = 0;
  double noise_ = 0.0;
};

}  // namespace

Image render(const Scene& scene, const Geometry& geometry, const RenderSettings& settings,
             const std::function<void(const RenderProgress&)>& report, const std::atomic<bool>* stop) {
  SampleFilm film(scene.film.width, scene.film.height);
  const CameraRays camera(scene.camera, scene.film);
  const std::vector<Tile> tiles = tiles_of(film, settings.tile_order);
  Rendering rendering(settings, report, stop);
  std::string quadrature;
  if (settings.integrator == "single") {
    // A picture shows six digits at most; probes ask for more (probe.cc).
    const SingleContext context(scene, geometry, {.tolerance = 1e-6, .sky_directions = 128});
    quadrature = single_description(context);
    rendering.pass(film, tiles, settings.spp, [&](const Tile& tile, int) {
      for (int y = tile.y0; y < tile.y1; ++y) {
        for (int x = tile.x0; x < tile.x1 && !rendering.stopped(); ++x)
          SampleFilm::set(film.at(x, y), single_pixel(context, x, y, settings.spp));
      }
    });
  } else {
    PathContext context(scene, geometry, settings.max_depth);
    const auto all = static_cast<std::uint64_t>(settings.spp) * static_cast<std::uint64_t>(film.width()) *
                     static_cast<std::uint64_t>(film.height());
    context.learn(camera, scene.film, std::max(least_lessons, std::min(all / 16, most_lessons)), settings.seed,
                  settings.threads);
    std::vector<std::unique_ptr<PathTracer>> tracers;
    for (int i = 0; i < thread_count(settings.threads); ++i) tracers.push_back(std::make_unique<PathTracer>(context));
    for (int done = 0; done < settings.spp && !rendering.stopped();) {
      const int samples = pass_size(done, settings.spp);
      rendering.pass(film, tiles, samples, [&](const Tile& tile, int thread) {
        for (int y = tile.y0; y < tile.y1; ++y) {
          for (int x = tile.x0; x < tile.x1; ++x) {
            Pixel& pixel = film.at(x, y);
            const auto number = static_cast<std::uint64_t>(y) * static_cast<std::uint64_t>(film.width()) +
                                static_cast<std::uint64_t>(x);
            if (done == 0) {
              const auto hit = geometry.intersect(camera.through(x + 0.5, y + 0.5));
              pixel.depth = hit ? hit->t : infinity;
            }
            for (int i = 0; i < samples && !rendering.stopped(); ++i) {  // a late pass has many
              RandomStream random(settings.seed, number, static_cast<std::uint32_t>(done + i),
                                  RandomStream::Samples::even);
              const double dx = random.next(), dy = random.next();
              SampleFilm::add(pixel, tracers[static_cast<std::size_t>(thread)]->trace(camera.through(x + dx, y + dy),
                                                                                      infinity, random));
            }
          }
        }
      });
      done += samples;
    }
  }
  Image image = film.develop();
  image.notes = {{"tyndall.integrator", settings.integrator},
                 {"tyndall.spp", std::to_string(settings.spp)},
                 {"tyndall.seed", std::to_string(settings.seed)},
                 {"tyndall.max_depth", settings.max_depth == 0 ? "none" : std::to_string(settings.max_depth)}};
  if (!quadrature.empty()) image.notes.emplace_back("tyndall.quadrature", quadrature);
  if (rendering.stopped()) {
    const auto [least, most] = film.samples_taken();
    image.notes.emplace_back("tyndall.stopped", "before all samples were taken: pixels have " + std::to_string(least) +
                                                    " to " + std::to_string(most) + " samples");
  }
  return image;
}

}  // namespace tyndall
