#include "tyndall/render/sampler.h"

#include <algorithm>
#include <vector>

#include "tyndall/render/camera.h"
#include "tyndall/render/path.h"
#include "tyndall/render/single.h"

namespace tyndall {
namespace {

/// What a picture of `single` shows: six digits at most; probes ask for more (probe.cc).
SingleSettings picture_settings() { return {.tolerance = 1e-6, .sky_directions = 128}; }

/// Paths to learn from, for a film: little work beside its own samples. Not by how many those will be, which samples
/// must not know.
std::uint64_t lessons_for(const Film& film) {
  const auto pixels = static_cast<std::uint64_t>(film.width) * static_cast<std::uint64_t>(film.height);
  return std::clamp<std::uint64_t>(pixels / 2, 256, 1u << 16);
}

bool is_single(const RenderSettings& settings) { return settings.integrator == "single"; }

/// One sample, exact but for its quadratures; spp says how finely pixels that see a lamp average their footprint.
class SingleSampler : public Sampler {
 public:
  SingleSampler(const Scene& scene, const Geometry& geometry, const RenderSettings& settings)
      : context_(scene, geometry, picture_settings()), spp_(settings.spp) {}
  void add(int x, int y, Pixel& pixel, int) override { SampleFilm::set(pixel, single_pixel(context_, x, y, spp_)); }

 private:
  SingleContext context_;
  int spp_;
};

class PathSampler : public Sampler {
 public:
  PathSampler(const Scene& scene, const Geometry& geometry, const RenderSettings& settings, int threads)
      : context_(scene, geometry, settings.max_depth),
        geometry_(geometry),
        camera_(scene.camera, scene.film),
        width_(static_cast<std::uint64_t>(scene.film.width)),
        seed_(settings.seed) {
    context_.learn(camera_, scene.film, lessons_for(scene.film), seed_, threads);
    for (int i = 0; i < threads; ++i) tracers_.push_back(std::make_unique<PathTracer>(context_));
  }
  void add(int x, int y, Pixel& pixel, int thread) override {
    if (pixel.samples == 0) {
      const auto hit = geometry_.intersect(camera_.through(x + 0.5, y + 0.5));
      pixel.depth = hit ? hit->t : infinity;
    }
    const std::uint64_t number = static_cast<std::uint64_t>(y) * width_ + static_cast<std::uint64_t>(x);
    RandomStream random(seed_, number, pixel.samples, RandomStream::Samples::even);
    const double dx = random.next(), dy = random.next();
    PathTracer& tracer = *tracers_[static_cast<std::size_t>(thread)];
    SampleFilm::add(pixel, tracer.trace(camera_.through(x + dx, y + dy), infinity, random));
  }

 private:
  PathContext context_;
  const Geometry& geometry_;
  CameraRays camera_;
  std::uint64_t width_, seed_;
  std::vector<std::unique_ptr<PathTracer>> tracers_;
};

}  // namespace

std::unique_ptr<Sampler> Sampler::make(const Scene& scene, const Geometry& geometry, const RenderSettings& settings,
                                       int threads) {
  if (is_single(settings)) return std::make_unique<SingleSampler>(scene, geometry, settings);
  return std::make_unique<PathSampler>(scene, geometry, settings, threads);
}

int most_samples(const RenderSettings& settings) { return is_single(settings) ? 1 : settings.spp; }

std::string quadrature_text(const RenderSettings& settings) {
  return is_single(settings) ? single_description(picture_settings()) : "";
}

}  // namespace tyndall
