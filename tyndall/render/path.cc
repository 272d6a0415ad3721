#include "tyndall/render/path.h"

#include "tyndall/light/spot_cone.h"
#include "tyndall/medium/free_flight.h"
#include "tyndall/medium/scatter.h"
#include "tyndall/render/bsdf.h"
#include "tyndall/render/distance_table.h"
#include "tyndall/render/path_lights.h"

namespace tyndall {

struct PathContext::Prepared {
  const Scene& scene;
  const Geometry& geometry;
  LoweredMedium medium;
  PathLights lights;
  int max_depth;
};

PathContext::PathContext(const Scene& scene, const Geometry& geometry, int max_depth)
    : prepared_(new Prepared{scene, geometry, lower(scene.medium), PathLights(scene), max_depth}) {}
PathContext::~PathContext() = default;

namespace {

/// Where a path is and what it has been through.
struct Walk {
  Ray ray;
  Spectrum beta = Spectrum::grey(1.0);
  int scatterings = 0, bounces = 0;
  double direction_density = 0.0;  // with which ray.direction was sampled [1/sr]; 0: it was given (a camera ray)

  int depth() const { return scatterings + bounces; }
};

/// Weight of the strategy of density a against one of density b (balance heuristic; Veach 1997).
double balance(double a, double b) { return a / (a + b); }

}  // namespace

struct PathTracer::State {
  explicit State(const PathContext::Prepared& context) : context(context) {}

  const PathContext::Prepared& context;
  PathSample out;
  std::vector<Stretch> stretches, shadow;
  ScatterPoint scatter, beside;  // at the collision; at a lamp's sample of the same segment
  std::vector<DistanceTable> tables;
  std::vector<std::size_t> tabled;  // the lamp of each table

  bool may_go_on(const Walk& walk) const { return context.max_depth == 0 || walk.depth() < context.max_depth; }

  /// Adds radiance that reached the eye after the walk's events and `scatterings`, `bounces` more.
  void add(const Walk& walk, const Spectrum& radiance, int scatterings, int bounces) {
    const int s = walk.scatterings + scatterings, b = walk.bounces + bounces;
    if (!is_finite(radiance)) return;
    (s == 0 ? out.surface : s == 1 && b == 0 ? out.single : out.multiple) += radiance;
  }

  /// Transmittance of medium and surfaces over a stretch of a ray; zero when a surface is in the way.
  Spectrum unoccluded(const Ray& ray, double distance) {
    if (context.geometry.occluded(ray, distance)) return {};
    return transmittance(context.medium, ray, distance, shadow);
  }
  Spectrum unoccluded(const Vector& from, const Vector& to) {
    if (context.geometry.occluded(from, to)) return {};
    const Vector way = to - from;
    const double distance = length(way);
    if (distance == 0.0) return Spectrum::grey(1.0);
    return transmittance(context.medium, {from, way / distance}, distance, shadow);
  }

  PathSample trace(const Ray& ray, double distance, RandomStream& random) {
    out = {};
    Walk walk{ray, Spectrum::grey(1.0), 0, 0, 0.0};
    std::optional<Hit> hit = context.geometry.intersect(ray);
    if (hit) out.depth = hit->t;
    double end = hit ? hit->t : infinity;
    if (distance < end) hit.reset();
    end = std::min(end, distance);
    stretches_along(context.medium, ray, end, stretches);
    out.transmittance = transmittance(stretches, end);
    if (may_go_on(walk)) lamps_along(walk, end, random);
    // Both ends of the eye's ray are followed: what it sees through the medium, and a collision forced to happen in it.
    Walk through = walk;
    through.beta *= out.transmittance;
    const std::vector<Stretch> seen = stretches;
    if (!is_zero(through.beta)) {
      if (hit) {
        if (bounce(through, *hit, random)) follow(through, random);
      } else if (distance == infinity) {
        leave_scene(through, true);
      }
    }
    if (!may_go_on(walk)) return out;
    stretches = seen;
    const Flight flight = sample_flight(stretches, walk.beta, end, true, random.next(), random.next());
    if (flight.t < end) {
      walk.beta *= flight.weight;
      if (collide(walk, flight.t, random)) follow(walk, random);
    }
    return out;
  }

  void follow(Walk walk, RandomStream& random) {
    for (;;) {
      const std::optional<Hit> hit = context.geometry.intersect(walk.ray);
      const double end = hit ? hit->t : infinity;
      stretches_along(context.medium, walk.ray, end, stretches);
      if (may_go_on(walk)) lamps_along(walk, end, random);
      const Flight flight = sample_flight(stretches, walk.beta, end, false, random.next(), random.next());
      walk.beta *= flight.weight;
      if (is_zero(walk.beta)) return;
      if (flight.t < end) {
        if (!may_go_on(walk) || !collide(walk, flight.t, random)) return;
      } else if (!hit) {
        leave_scene(walk, false);
        return;
      } else if (!bounce(walk, *hit, random)) {
        return;
      }
      if (walk.depth() >= 5) {
        const double survival = std::clamp(largest(walk.beta), 0.05, 0.9);
        if (random.next() >= survival) return;
        walk.beta *= 1.0 / survival;
      }
    }
  }

  /// Light of point and spot lamps scattered toward the walk from its segment [0, end], whatever happens to the walk
  /// later: one lamp, one distance, both chosen by what they promise.
  void lamps_along(const Walk& walk, double end, RandomStream& random) {
    if (stretches.empty()) return;
    tables.clear();
    tabled.clear();
    double promise = 0.0;
    const double cut = depth_cut(walk.beta, end);
    for (std::size_t i = 0; i < context.lights.lamps.size(); ++i) {
      const Lamp& lamp = context.lights.lamps[i];
      Interval range{0.0, end};
      if (lamp.spot != nullptr) range = lit_interval(*lamp.spot, walk.ray, range);
      if (range.empty()) continue;
      const Vector to_lamp = lamp.position - walk.ray.origin;
      const double a = dot(to_lamp, walk.ray.direction), h = length(to_lamp - walk.ray.direction * a);
      tables.emplace_back(range, a, h, cut, [&](double t) { return promised(walk, lamp, t); });
      tabled.push_back(i);
      promise += tables.back().integral();
    }
    if (tables.empty()) return;
    // A twentieth of the choices is even: lamps whose table saw nothing keep a chance.
    const double even = 0.05 / static_cast<double>(tables.size());
    const auto chance_of = [&](std::size_t k) {
      return promise > 0.0 ? even + 0.95 * tables[k].integral() / promise : 20.0 * even;
    };
    double pick = random.next();
    std::size_t chosen = 0;
    while (chosen + 1 < tables.size() && pick >= chance_of(chosen)) pick -= chance_of(chosen++);
    const double xi_choice = random.next(), xi = random.next();
    const DistanceTable::Sample at = tables[chosen].sample(xi_choice, xi);
    if (!(at.t > 0.0 && at.t < end) || !(at.density > 0.0)) return;
    const Lamp& lamp = context.lights.lamps[tabled[chosen]];
    const Vector point = walk.ray.at(at.t), way = point - lamp.position;
    const double squared = length_squared(way);
    if (squared == 0.0) return;
    const double distance = std::sqrt(squared);
    const Vector travel = way / distance;  // of the lamp's light
    const Spectrum intensity = lamp.intensity_toward(travel);
    if (is_zero(intensity)) return;
    beside.set(context.medium, stretches, at.t);
    const Spectrum scattered = beside.scattered(deflection_between(travel, -walk.ray.direction));
    const Spectrum light = intensity * scattered * transmittance(stretches, at.t) / squared;
    if (is_zero(light)) return;
    const Spectrum visible = unoccluded(point, lamp.position);
    add(walk, walk.beta * light * visible / (at.density * chance_of(chosen)), 1, 0);
  }

  /// Distance beyond which the segment is too deep to matter for a table: optical depth 14 in the thinnest channel that
  /// counts.
  double depth_cut(const Spectrum& beta, double end) const {
    double cut = 0.0;
    for (std::size_t c = 0; c < channel_count; ++c) {
      if (beta[c] > 0.05 * largest(beta)) cut = std::max(cut, distance_at_depth(stretches, c, 14.0, end));
    }
    return cut;
  }

  /// The integrand of lamps_along times r^2, roughly: the light's own path is taken to see the extinction at the point.
  double promised(const Walk& walk, const Lamp& lamp, double t) {
    const Vector way = walk.ray.at(t) - lamp.position;
    const double distance = length(way);
    if (distance == 0.0) return 0.0;
    const Vector travel = way / distance;
    const Spectrum intensity = lamp.intensity_toward(travel);
    if (is_zero(intensity)) return 0.0;
    beside.set(context.medium, stretches, t);
    const Spectrum depth = optical_depth(stretches, t) + extinction_at(stretches, t) * distance;
    const Spectrum scattered = beside.scattered(deflection_between(travel, -walk.ray.direction));
    return sum(walk.beta * intensity * scattered * map(depth, [](double x) { return std::exp(-x); }));
  }

  /// A collision at distance t of the walk's segment: adds direct light of sun, surroundings and emissive surfaces, and
  /// turns.
  bool collide(Walk& walk, double t, RandomStream& random) {
    scatter.set(context.medium, stretches, t);
    const Vector point = walk.ray.at(t);
    scatter.aim(walk.beta);
    const double xi[4] = {random.next(), random.next(), random.next(), random.next()};
    if (is_zero(walk.beta * scatter.scattering())) return false;
    // Light travels against the walk: toward the eye along -direction.
    const auto toward = [&](const Vector& to_light) { return deflection_between(-to_light, -walk.ray.direction); };
    for (const SunLight& sun : context.lights.suns) {
      const LightSample light = sample_sun(sun, random.next(), random.next());
      const Spectrum f = scatter.scattered(toward(light.direction));
      if (!is_zero(f)) add(walk, walk.beta * f * light.radiance * unoccluded({point, light.direction}, infinity), 1, 0);
    }
    for (const auto& light :
         {context.lights.sample_environment(random), context.lights.sample_emitter(point, random)}) {
      if (!(light.density > 0.0)) continue;
      const Deflection<double> d = toward(light.direction);
      const double weight = balance(light.density, scatter.density(d)) / light.density;
      const Spectrum contribution = walk.beta * scatter.scattered(d) * light.radiance * weight;
      if (!is_zero(contribution)) add(walk, contribution * unoccluded({point, light.direction}, light.distance), 1, 0);
    }
    const Deflection<double> d = scatter.sample(xi[0]);
    const double density = scatter.density(d);
    if (!(density > 0.0)) return false;
    walk.beta *= scatter.scattered(d) / density;
    walk.ray = {point, normalized(around(Frame::around(walk.ray.direction), d.mu, d.sine(), xi[1]))};
    walk.direction_density = density;
    ++walk.scatterings;
    return !is_zero(walk.beta);
  }

  /// The walk has met a surface: adds its emission and the light it reflects directly, and reflects.
  bool bounce(Walk& walk, const Hit& hit, RandomStream& random) {
    const Spectrum emitted = context.lights.emission(hit);
    if (!is_zero(emitted)) {
      const double other = walk.direction_density > 0.0 ? context.lights.emitter_density(hit, walk.ray) : 0.0;
      add(walk, walk.beta * emitted * (other > 0.0 ? balance(walk.direction_density, other) : 1.0), 0, 0);
    }
    if (!may_go_on(walk)) return false;
    const SurfacePoint surface = surface_point(context.geometry, hit);
    const Vector out_direction = -walk.ray.direction;
    const Vector start = context.geometry.leave(hit.point, hit.geometric_normal);
    if (const auto lamp = context.lights.sample_lamp(start, random.next()); lamp.density > 0.0) {
      const Spectrum f = evaluate(surface, out_direction, lamp.direction);
      if (!is_zero(f)) {
        add(walk, walk.beta * f * lamp.radiance / lamp.density * unoccluded(start, lamp.position), 0, 1);
      }
    }
    for (const SunLight& sun : context.lights.suns) {
      const LightSample light = sample_sun(sun, random.next(), random.next());
      const Spectrum f = evaluate(surface, out_direction, light.direction);
      if (!is_zero(f)) add(walk, walk.beta * f * light.radiance * unoccluded({start, light.direction}, infinity), 0, 1);
    }
    for (const auto& light :
         {context.lights.sample_environment(random), context.lights.sample_emitter(start, random)}) {
      if (!(light.density > 0.0)) continue;
      const Spectrum f = evaluate(surface, out_direction, light.direction);
      if (is_zero(f)) continue;
      const double weight =
          balance(light.density, direction_density(surface, out_direction, light.direction)) / light.density;
      add(walk, walk.beta * f * light.radiance * weight * unoccluded({start, light.direction}, light.distance), 0, 1);
    }
    const Vector in = sample_direction(surface, out_direction, random.next(), random.next(), random.next());
    const double density = direction_density(surface, out_direction, in);
    if (!(density > 0.0)) return false;
    walk.beta *= evaluate(surface, out_direction, in) / density;
    walk.ray = {start, in};
    walk.direction_density = density;
    ++walk.bounces;
    return !is_zero(walk.beta) && is_finite(walk.beta);
  }

  /// The walk leaves for the surroundings. Only the eye sees the sun's disc: everything else samples it as a light.
  void leave_scene(const Walk& walk, bool eye) {
    const double density = walk.direction_density > 0.0 ? context.lights.environment_density(walk.ray.direction) : 0.0;
    const double weight = density > 0.0 ? balance(walk.direction_density, density) : 1.0;
    add(walk, walk.beta * context.lights.environment(walk.ray.direction) * weight, 0, 0);
    if (!eye) return;
    for (const SunLight& sun : context.lights.suns) add(walk, walk.beta * sun_disc(sun, walk.ray.direction), 0, 0);
  }
};

PathTracer::PathTracer(const PathContext& context) : state_(new State(context.prepared())) {}
PathTracer::~PathTracer() = default;
PathSample PathTracer::trace(const Ray& ray, double distance, RandomStream& random) {
  return state_->trace(ray, distance, random);
}

}  // namespace tyndall
