// Paths, rays and collisions per second of `path`, on one thread, in scenes of examples/.
#include <benchmark/benchmark.h>

#include "tyndall/render/camera.h"
#include "tyndall/render/path.h"
#include "tyndall/scene/scene_file.h"

namespace tyndall {
namespace {

void path(benchmark::State& state, const std::string& name) {
  const Scene scene = read_scene(TYNDALL_SOURCE_DIR "/examples/" + name + ".scene.json");
  const Geometry geometry(scene);
  PathContext context(scene, geometry);
  const CameraRays camera(scene.camera, scene.film);
  context.learn(camera, scene.film, 65536, 1, 1);
  PathTracer tracer(context);
  std::uint64_t paths = 0;
  const PathCounts before = tracer.counts();
  for (auto _ : state) {
    for (int i = 0; i < 1000; ++i, ++paths) {
      RandomStream random(1, paths, 0);
      const double x = random.next() * scene.film.width, y = random.next() * scene.film.height;
      benchmark::DoNotOptimize(tracer.trace(camera.through(x, y), infinity, random));
    }
  }
  const PathCounts& after = tracer.counts();
  const auto rate = [&](std::uint64_t count) {
    return benchmark::Counter(static_cast<double>(count), benchmark::Counter::kIsRate);
  };
  state.counters["paths"] = rate(paths);
  state.counters["rays"] = rate(after.rays - before.rays);
  state.counters["collisions"] = rate(after.collisions - before.collisions);
  state.counters["reflections"] = rate(after.bounces - before.bounces);
}

const bool registered = [] {
  for (const std::string name : {"street", "room", "landscape", "cloud"}) {
    benchmark::RegisterBenchmark(("path/" + name).c_str(), path, name)->Unit(benchmark::kMillisecond)->MinTime(3.0);
  }
  return true;
}();

}  // namespace
}  // namespace tyndall
