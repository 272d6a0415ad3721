#pragma once
// The integrator `path`: unbiased light transport of all orders in surfaces and media.
#include <cstdint>
#include <memory>
#include <vector>

#include "tyndall/medium/lowered_medium.h"
#include "tyndall/render/light_by_order.h"
#include "tyndall/sampling/random_stream.h"
#include "tyndall/scene/geometry.h"
#include "tyndall/scene/scene.h"

namespace tyndall {

class CameraRays;
struct SunLesson;

/// What `path` prepares once per scene; read only afterwards, by any number of threads.
class PathContext {
 public:
  /// Both must outlive the context. max_depth: most events (collisions and reflections) of a path, 0 for no limit.
  /// follow_through: the share of paths that go on each time their number of events has doubled (Russian roulette,
  /// unbiased): 0.8 is good for pictures, where late orders are smooth and many pixels share the work; 1 for a figure
  /// that hangs on late orders.
  PathContext(const Scene& scene, const Geometry& geometry, int max_depth = 0, double follow_through = 0.8);
  ~PathContext();
  PathContext(const PathContext&) = delete;
  PathContext& operator=(const PathContext&) = delete;

  /// Sends a few paths through the camera's film and remembers where they met the sun (sun_beams.h): if they seldom do,
  /// later ones look there too, and bring less noise and the same mean. `paths`: at most; few teach nothing. Same
  /// arguments, same result, for any number of threads. Not while others trace.
  void learn(const CameraRays& camera, const Film& film, std::uint64_t paths, std::uint64_t seed, int threads = 0);

  struct Prepared;
  const Prepared& prepared() const { return *prepared_; }

 private:
  std::unique_ptr<Prepared> prepared_;
};

/// One unbiased estimate of the radiance along a ray.
struct PathSample {
  LightByOrder light;
  Spectrum transmittance;
  double depth = infinity;  // distance to the surface seen [m]
};

/// What a tracer has done: rays asked of surfaces, those of shadows included; collisions and reflections of walks.
struct PathCounts {
  std::uint64_t rays = 0, collisions = 0, bounces = 0;
};

/// Traces paths; one per thread, for its scratch memory.
class PathTracer {
 public:
  explicit PathTracer(const PathContext& context);
  ~PathTracer();
  PathTracer(const PathTracer&) = delete;
  PathTracer& operator=(const PathTracer&) = delete;

  /// Radiance arriving at ray.origin from ray.direction (a unit vector). The ray ends at `distance` or the first
  /// surface; with a finite `distance` nothing at or beyond it is added, but what is there still lights the segment.
  /// sees_sun: add the disc of a sun that the ray itself looks at.
  PathSample trace(const Ray& ray, double distance, RandomStream& random, bool sees_sun = true);

  /// From now on appends where its paths meet the suns, after at least one event, to `lessons`.
  void teach(std::vector<SunLesson>& lessons);
  /// How often it has looked for them, in vain or not.
  std::uint64_t sun_tries() const;
  const PathCounts& counts() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// A mean over `spp` samples and its standard error; transmittance is exact.
struct ProbeEstimate {
  Spectrum radiance, standard_error, transmittance;
};

/// The radiance of a probe ray (PathTracer::trace), by any number of threads with the same bits.
ProbeEstimate path_probe(const PathContext& context, const Ray& ray, double distance, std::uint32_t spp,
                         std::uint64_t seed, int threads = 0);

/// The fluence rate at a point [W/m^2]: radiance from all directions. transmittance is that along +Y. Light of point
/// and spot lamps that arrives unscattered is added exactly.
ProbeEstimate path_fluence(const PathContext& context, const Vector& point, std::uint32_t spp, std::uint64_t seed,
                           int threads = 0);

}  // namespace tyndall
