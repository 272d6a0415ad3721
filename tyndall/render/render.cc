#include "tyndall/render/render.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <memory>
#include <thread>

#include "tyndall/render/film.h"
#include "tyndall/render/parallel.h"
#include "tyndall/render/sampler.h"
#include "tyndall/render/tile.h"

namespace tyndall {
namespace {

/// "64", or "12-16" where not all pixels have as many.
std::string range_text(std::uint64_t least, std::uint64_t most) {
  std::string text = std::to_string(least);
  if (most != least) text.append("-").append(std::to_string(most));
  return text;
}

/// How many samples each pixel has after the pass that follows `done`. The first gives something to look at soon;
/// later ones grow, so that passes cost little. Always the same numbers (1, 2, 3, 4, 6, 9, ..): a picture that ends at
/// a given noise then ends with the same samples however often it was interrupted.
int next_level(int done) {
  int level = 0;
  while (level <= done) level += std::max(1, level / 2);
  return level;
}

class Rendering {
 public:
  Rendering(const RenderSettings& settings, SampleFilm& film, const RenderHooks& hooks, Sampler& sampler)
      : settings_(settings),
        film_(film),
        hooks_(hooks),
        sampler_(sampler),
        tiles_(tiles_of(film.width(), film.height(), settings.tile_order)),
        spp_(most_samples(settings)) {}

  /// Passes until an end; true where it was not asked to stop.
  bool passes() {
    int done = least_samples();
    tell(done, true);
    while (!stopped() && done < spp_ && !quiet_enough(done)) {
      const double begun = elapsed();
      const int level = std::min({spp_, next_level(done), level_in_time(done)});
      while (least_samples() < level && !stopped()) {
        pass(level);
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
  void pass(int level) {
    std::atomic<std::size_t> next{0}, finished{0};
    std::thread others;
    if (hooks_.helpers != nullptr) {
      others = std::thread([&] {
        const auto empty = [&] { return stopped() || wanted_ || next >= tiles_.size(); };
        const auto take = [&]() -> std::optional<std::size_t> {
          const std::size_t i = empty() ? tiles_.size() : next.fetch_add(1);
          if (i >= tiles_.size()) return std::nullopt;
          ++finished;  // as good as
          return i;
        };
        hooks_.helpers->work({tiles_, level, take, empty}, film_);
      });
    }
    take_blocks(next, tiles_.size(), thread_count(settings_.threads), [&](std::size_t i, int thread) {
      for_each_pixel(tiles_[i], [&](int x, int y) {
        Pixel& pixel = film_.at(x, y);
        if (static_cast<int>(pixel.samples) >= level) return;
        if (thread == 0) watch();
        while (static_cast<int>(pixel.samples) < level && !stopped() && !wanted_) sampler_.add(x, y, pixel, thread);
      });
      ++finished;
      if (thread == 0 && !wanted_)
        tell(done_ + (level - done_) * static_cast<double>(finished) / static_cast<double>(tiles_.size()), false);
    });
    if (others.joinable()) others.join();
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

  const RenderSettings& settings_;
  SampleFilm& film_;
  const RenderHooks& hooks_;
  Sampler& sampler_;
  std::vector<Tile> tiles_;
  Clock::time_point begun_ = Clock::now(), told_{};
  std::atomic<bool> late_{false}, wanted_{false};
  int spp_, done_ = 0;
  double noise_ = 0.0, seconds_per_sample_ = 0.0;
};

}  // namespace

bool render(const Scene& scene, const Geometry& geometry, const RenderSettings& settings, SampleFilm& film,
            const RenderHooks& hooks) {
  const std::unique_ptr<Sampler> sampler = Sampler::make(scene, geometry, settings, thread_count(settings.threads));
  return Rendering(settings, film, hooks, *sampler).passes();
}

Image developed(const SampleFilm& film, const RenderSettings& settings, bool ended) {
  Image image = film.develop();
  const auto [least, most] = film.samples_taken();
  // single does all of a pixel at once, and counts it as one.
  const std::uint64_t each = settings.integrator == "single" ? static_cast<std::uint64_t>(settings.spp) : 1;
  image.notes = {{"tyndall.integrator", settings.integrator},
                 {"tyndall.spp", std::to_string(settings.spp)},
                 {"tyndall.spp_taken", range_text(least * each, most * each)},
                 {"tyndall.seed", std::to_string(settings.seed)},
                 {"tyndall.max_depth", settings.max_depth == 0 ? "none" : std::to_string(settings.max_depth)}};
  if (const std::string text = quadrature_text(settings); !text.empty())
    image.notes.emplace_back("tyndall.quadrature", text);
  if (!ended) image.notes.emplace_back("tyndall.stopped", "before all samples were taken");
  return image;
}

Image render(const Scene& scene, const Geometry& geometry, const RenderSettings& settings,
             const std::function<void(const RenderProgress&)>& report, const std::atomic<bool>* stop) {
  SampleFilm film(scene.film.width, scene.film.height);
  const bool ended = render(scene, geometry, settings, film, {report, {}, {}, stop, nullptr});
  return developed(film, settings, ended);
}

}  // namespace tyndall
