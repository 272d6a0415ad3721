// Means over many paths: the radiance along one ray, the fluence rate at one point.
#include <memory>
#include <numbers>

#include "tyndall/medium/scatter.h"
#include "tyndall/render/parallel.h"
#include "tyndall/render/path_prepared.h"

namespace tyndall {
namespace {

constexpr std::uint32_t block_samples = 256;

/// The mean of `spp` samples of draw(tracer, number), summed in fixed blocks.
template <class Draw>
ProbeEstimate average(const PathContext& context, std::uint32_t spp, int threads, Draw draw) {
  const std::size_t blocks = (spp + block_samples - 1) / block_samples;
  std::vector<Spectrum> sums(blocks), squares(blocks);
  std::vector<std::unique_ptr<PathTracer>> tracers;
  for (int i = 0; i < thread_count(threads); ++i) tracers.push_back(std::make_unique<PathTracer>(context));
  for_each_block(blocks, thread_count(threads), [&](std::size_t block, int thread) {
    const auto first = static_cast<std::uint32_t>(block) * block_samples;
    for (std::uint32_t i = first; i < std::min(spp, first + block_samples); ++i) {
      const Spectrum x = draw(*tracers[static_cast<std::size_t>(thread)], i);
      sums[block] += x;
      squares[block] += x * x;
    }
  });
  Spectrum sum, square;
  for (std::size_t block = 0; block < blocks; ++block) sum += sums[block], square += squares[block];
  const double n = spp;
  ProbeEstimate estimate{sum / n, {}, {}};
  const Spectrum variance = (square / n - estimate.radiance * estimate.radiance) / std::max(1.0, n - 1.0);
  estimate.standard_error = map(variance, [](double x) { return std::sqrt(std::max(0.0, x)); });
  return estimate;
}

}  // namespace

ProbeEstimate path_probe(const PathContext& context, const Ray& ray, double distance, std::uint32_t spp,
                         std::uint64_t seed, int threads) {
  ProbeEstimate estimate = average(context, spp, threads, [&](PathTracer& tracer, std::uint32_t i) {
    RandomStream random(seed, 0, i);
    return tracer.trace(ray, distance, random).light.sum();
  });
  const auto hit = context.prepared().geometry.intersect(ray);
  std::vector<Stretch> scratch;
  estimate.transmittance =
      transmittance(context.prepared().medium, ray, std::min(distance, hit ? hit->t : infinity), scratch);
  return estimate;
}

ProbeEstimate path_fluence(const PathContext& context, const Vector& point, std::uint32_t spp, std::uint64_t seed,
                           int threads) {
  const PathContext::Prepared& scene = context.prepared();
  std::vector<Vector> toward;  // lamps: radiance near one goes as 1/angle, so half of the directions go there as 1/sin
  for (const Lamp& lamp : scene.lights.lamps) {
    if (length_squared(lamp.position - point) > 0.0) toward.push_back(normalized(lamp.position - point));
  }
  const double even = 1.0 / (4.0 * std::numbers::pi);
  ProbeEstimate estimate = average(context, spp, threads, [&](PathTracer& tracer, std::uint32_t i) {
    RandomStream random(seed, 0, i);
    const double pick = random.next(), xi1 = random.next(), xi2 = random.next();
    Vector direction;
    if (toward.empty() || pick < 0.5) {
      direction = sample_sphere(xi1, xi2);
    } else {
      const auto lamp = std::min(toward.size() - 1,
                                 static_cast<std::size_t>((2.0 * pick - 1.0) * static_cast<double>(toward.size())));
      const double angle = std::numbers::pi * xi1;
      direction = around(Frame::around(toward[lamp]), std::cos(angle), std::sin(angle), xi2);
    }
    double density = toward.empty() ? even : 0.5 * even;
    for (const Vector& lamp : toward) {
      const double sine = deflection_between(lamp, direction).sine();
      density += 0.5 / (2.0 * std::numbers::pi * std::numbers::pi * std::max(sine, 1e-12) *
                        static_cast<double>(toward.size()));
    }
    return tracer.trace({point, normalized(direction)}, infinity, random, false).light.sum() / density;
  });
  std::vector<Stretch> scratch;
  const auto visible = [&](const Ray& ray, double distance) {
    return scene.geometry.occluded(ray, distance) ? Spectrum{} : transmittance(scene.medium, ray, distance, scratch);
  };
  for (const Lamp& lamp : scene.lights.lamps) {
    const Vector way = lamp.position - point;
    const double distance = length(way);
    if (distance == 0.0) continue;
    const Ray ray{point, way / distance};
    estimate.radiance += lamp.intensity_toward(-ray.direction) / (distance * distance) * visible(ray, distance);
  }
  for (const SunLight& sun : scene.lights.suns) {
    estimate.radiance += sun.irradiance * visible({point, -normalized(sun.direction)}, infinity);
  }
  estimate.transmittance = transmittance(scene.medium, {point, {0.0, 1.0, 0.0}}, infinity, scratch);
  return estimate;
}

}  // namespace tyndall
