#include "tyndall/render/path.h"

#include "tyndall/medium/null_flight.h"
#include "tyndall/medium/scatter.h"
#include "tyndall/render/bsdf.h"
#include "tyndall/render/lamp_aim.h"
#include "tyndall/render/lamp_segment.h"
#include "tyndall/render/path_prepared.h"

namespace tyndall {

PathContext::PathContext(const Scene& scene, const Geometry& geometry, int max_depth, double follow_through)
    : prepared_(new Prepared{scene,
                             geometry,
                             lower(scene.medium, scene.time),
                             PathLights(scene),
                             max_depth,
                             follow_through,
                             {},
                             false,
                             DenseAir(lower(scene.medium, scene.time))}) {
  prepared_->winding = std::ranges::any_of(prepared_->medium.species, [](const auto& s) { return !s.form.empty(); });
}
PathContext::~PathContext() = default;

namespace {

/// Where a path is and what it has been through.
struct Walk {
  Ray ray;
  Spectrum beta = Spectrum::grey(1.0);
  int scatterings = 0, bounces = 0;
  double direction_density = 0.0;  // with which ray.direction was sampled [1/sr]; 0: it was given (a camera ray)
  LampAim aim;                     // of the event that sampled it
  double sun_tries = 0.0;          // there: how often, in the mean, it followed a ray of each sun instead
  double lobe_density = 0.0;       // there: with which a direction by the sun's lobe would have been ray.direction
  Spectrum extinction;             // there [1/m]
  bool been_in_dense = false;      // whether it has passed dense air
  bool sought_sky = false;         // there: whether the surroundings were sampled, too
  double first_promise = 0.0;      // PathLights::promise_at its first event

  int depth() const { return scatterings + bounces; }
};

/// More than an event of a walk uses unless there are many suns: even samples (RandomStream) stay so from event to
/// event.
constexpr std::uint32_t event_dimensions = 32;

/// Transmittance of the eye's ray below which all that is seen lies in the air.
constexpr double opaque = 2.5e-3;
/// Optical depth beyond which the eye's ray ends in the air but for a thousandth.
constexpr double invisible_depth = 7.0;

/// Transmittance where finding it costs by the depth: to a depth of `sure` it is exact; what is left beyond that is
/// seldom looked for, and counts for more then.
struct AirDepth {
  double sure, enough;

  AirDepth(double surely, double xi) : sure(surely), enough(surely - std::log1p(-xi)) {}
  Spectrum transmittance(const Spectrum& depth) const {
    const double least = std::min({depth[0], depth[1], depth[2]}), lifted = std::max(0.0, least - sure);
    return least > enough ? Spectrum{} : map(depth, [&](double x) { return std::exp(lifted - x); });
  }
};

/// Weight of the strategy of density a against one of density b (balance heuristic; Veach 1997).
double balance(double a, double b) { return a / (a + b); }

}  // namespace

struct PathTracer::State {
  explicit State(const PathContext::Prepared& prepared) : context(prepared) {}

  const PathContext::Prepared& context;
  PathSample out;
  std::vector<Stretch> stretches, shadow;
  ScatterPoint scatter, beside;  // at the collision; at a lamp's sample of the same segment
  LampSegment segment;
  std::vector<SunLesson>* lessons = nullptr;  // where to write what is met of the suns, if anybody learns
  std::uint64_t sun_tries = 0;                // how often it was looked for
  PathCounts counts;

  std::optional<Hit> intersect(const Ray& ray) {
    ++counts.rays;
    return context.geometry.intersect(ray);
  }
  template <class From, class To>
  bool occluded(const From& from, const To& to) {
    ++counts.rays;
    return context.geometry.occluded(from, to);
  }

  bool may_go_on(const Walk& walk) const { return context.max_depth == 0 || walk.depth() < context.max_depth; }

  /// Adds radiance that reached the eye after the walk's events and `scatterings`, `bounces` more.
  void add(const Walk& walk, const Spectrum& radiance, int scatterings, int bounces) {
    if (!is_finite(radiance)) return;
    out.light.of(walk.scatterings + scatterings, walk.bounces + bounces) += radiance;
  }

  /// Transmittance of the medium, unbiased: where a ray takes long to follow, its last few percent are seldom looked
  /// for, and count for more then.
  Spectrum through_air(const Ray& ray, double distance, RandomStream& random) {
    if (!context.winding) return transmittance(context.medium, ray, distance, shadow);
    const AirDepth air(1.5, random.next());
    if (stretches_along(context.medium, ray, distance, shadow, air.enough) < distance) return {};
    return air.transmittance(optical_depth(shadow, distance));
  }

  /// Transmittance of medium and surfaces over a stretch of a ray; zero when a surface is in the way.
  Spectrum unoccluded(const Ray& ray, double distance, RandomStream& random) {
    return occluded(ray, distance) ? Spectrum{} : through_air(ray, distance, random);
  }
  Spectrum unoccluded(const Vector& from, const Vector& to, RandomStream& random) {
    if (occluded(from, to)) return {};
    const Vector way = to - from;
    const double distance = length(way);
    return distance == 0.0 ? Spectrum::grey(1.0) : through_air({from, way / distance}, distance, random);
  }

  /// The same with no choice in it: of the same points always the same.
  Spectrum exactly_unoccluded(const Vector& from, const Vector& to) {
    if (occluded(from, to)) return {};
    const Vector way = to - from;
    const double distance = length(way);
    return distance == 0.0 ? Spectrum::grey(1.0)
                           : transmittance(context.medium, {from, way / distance}, distance, shadow);
  }

  /// Whether a flight from `ray.origin`, where the extinction is given, is to be sampled as it comes: it will hardly
  /// leave the air, and need not be forced to collide nor the whole ray looked at. (Lamps look at whole segments.)
  bool is_dense(const Ray& ray, const Spectrum& extinction, double end) const {
    return context.lights.lamps.empty() && context.dense_air.lies_ahead(ray, extinction, end);
  }

  /// A flight of such a ray. Sets `stretches` to what is needed at its end.
  Flight dense_flight(const Ray& ray, double end, const Spectrum& beta, double xi_channel, double xi_depth,
                      RandomStream& random) {
    if (context.winding) {
      const double seed = random.next();
      return sample_null_flight(context.medium, ray, end, beta, xi_channel, xi_depth, {seed, random.next()}, stretches);
    }
    stretches_along(context.medium, ray, end, stretches, -std::log1p(-xi_depth));
    return sample_flight(stretches, beta, end, false, xi_channel, xi_depth);
  }

  PathSample trace(const Ray& ray, double distance, RandomStream& random, bool sees_sun) {
    out = {};
    Walk walk;
    walk.ray = ray;
    std::optional<Hit> hit = intersect(ray);
    if (hit) out.depth = hit->t;
    double end = hit ? hit->t : infinity;
    if (distance < end) hit.reset();
    end = std::min(end, distance);
    const double xi_depth = random.next(), xi_channel = random.next();
    const AirDepth whole(invisible_depth, random.next());
    const double reach = stretches_along(context.medium, ray, end, stretches,
                                         context.winding ? std::max(whole.enough, -std::log1p(-xi_depth)) : infinity);
    const bool ends_in_air = reach < end;
    out.transmittance = ends_in_air ? Spectrum{} : whole.transmittance(optical_depth(stretches, end));
    if (may_go_on(walk)) lamps_along(walk, end, random);
    // Both ends of the eye's ray are followed: what it sees through the medium, and a collision forced to happen in it.
    Walk through = walk;
    through.beta *= out.transmittance;
    const std::vector<Stretch> seen = stretches;
    random.begin_branch(1);
    if (!is_zero(through.beta)) {
      if (hit) {
        if (bounce(through, *hit, random)) follow(through, random);
      } else if (distance == infinity) {
        leave_scene(through, sees_sun);
      }
    }
    if (!may_go_on(walk)) return out;
    stretches = seen;
    random.begin_branch(2);
    if (!ends_in_air) suns_along(walk, end, random);
    random.begin_branch(3);
    const Flight flight = sample_flight(stretches, walk.beta, end, !ends_in_air, xi_channel, xi_depth);
    if (flight.t < end) {
      walk.beta *= flight.weight;
      if (collide(walk, flight.t, ends_in_air, random)) follow(walk, random);
    }
    return out;
  }

  void follow(Walk walk, RandomStream& random) {
    for (;;) {
      random.align(event_dimensions);
      const std::optional<Hit> hit = intersect(walk.ray);
      const double end = hit ? hit->t : infinity;
      const bool dense = is_dense(walk.ray, walk.extinction, end);
      walk.been_in_dense = walk.been_in_dense || dense;
      if (!dense) {
        stretches_along(context.medium, walk.ray, end, stretches);
        if (may_go_on(walk)) {
          lamps_along(walk, end, random);
          suns_along(walk, end, random);
        }
      }
      const double xi_depth = random.next(), xi_channel = random.next();
      const Flight flight = dense ? dense_flight(walk.ray, end, walk.beta, xi_channel, xi_depth, random)
                                  : sample_flight(stretches, walk.beta, end, false, xi_channel, xi_depth);
      walk.beta *= flight.weight;
      if (is_zero(walk.beta)) return;
      if (flight.t < end) {
        if (!may_go_on(walk) || !collide(walk, flight.t, dense, random)) return;
      } else if (!hit) {
        leave_scene(walk, false);
        return;
      } else if (!bounce(walk, *hit, random)) {
        return;
      }
      const double survival = survival_of(walk);
      if (survival < 1.0) {
        if (random.next() >= survival) return;
        walk.beta *= 1.0 / survival;
      }
    }
  }

  /// Russian roulette. By promise: throughput times the light to be had where the walk is, relative to where it began;
  /// its weight never grows beyond what that promise has lost. By depth (PathContext, follow_through), except after
  /// dense air, whose late orders are most of its light: weights grow no faster than the depth, so variance stays
  /// bounded wherever light is lost. Last resort against endless walks: beyond 256 events the weight grows as the
  /// depth, besides: those who got far are few, but not so few that they bring sparks.
  double survival_of(const Walk& walk) const {
    const double promise = largest(walk.beta) * context.lights.promise_at(walk.ray.origin) / walk.first_promise;
    const int depth = walk.depth();
    const bool doubled = depth >= 2 && (depth & (depth - 1)) == 0;
    return std::clamp(4.0 * promise, 0.1, depth > 256 ? 1.0 - 1.0 / depth : 1.0) *
           (doubled && !walk.been_in_dense ? context.follow_through : 1.0);
  }

  /// Light of point and spot lamps scattered toward the walk from its segment [0, end], whatever happens to the walk
  /// later: a lamp and a distance, both chosen by what they promise. The eye's own segment, which everything seen hangs
  /// on, gets several, with the choices of the lamp spread evenly.
  void lamps_along(const Walk& walk, double end, RandomStream& random) {
    if (stretches.empty() || context.lights.lamps.empty()) return;
    segment.set(context.medium, stretches, walk.ray, end, walk.beta);
    const bool eye = walk.depth() == 0;
    const int count = eye ? 4 : 1;
    const double offset = random.next();
    random.align(4);
    segment.promise(context.lights.lamps, eye);
    for (int i = 0; i < count; ++i) {
      const double xi_choice = random.next(), xi = random.next();
      const LampSegment::Sample at = segment.sample(context.lights.lamps, (i + offset) / count, xi_choice, xi);
      double weight = 1.0 / count;
      if (walk.direction_density > 0.0) {
        const Lamp& lamp = context.lights.lamps[at.lamp];
        const double other = walk.aim.tries() * walk.aim.density(lamp, walk.ray.direction);
        weight *= balance(walk.direction_density, other) *
                  (1.0 - lamp_shaft_weight(walk.aim, lamp, walk.ray.origin, walk.ray.at(at.t),
                                           walk.direction_density + other));
      }
      add(walk, walk.beta * airlight(walk.ray, end, at, random) * weight, 1, 0);
    }
  }

  /// Sunlight scattered toward the walk from its segment [0, end], whatever happens to the walk later: in thin air few
  /// walks collide, and those that do would bring all of it. Shafts are light or shadow, so their share of the eye's
  /// segment is measured at two places, spread evenly over the chances of a collision; in opaque air other noise is
  /// larger.
  void suns_along(const Walk& walk, double end, RandomStream& random) {
    if (stretches.empty() || context.lights.suns.empty()) return;
    const bool shafts_show = walk.depth() == 0 && largest(out.transmittance) > opaque;
    const int places = !shafts_show ? 1 : context.beams.empty() ? 2 : 4;
    for (int i = 0; i < places; ++i) {
      const double xi_channel = random.next(), xi = (i + random.next()) / places;
      const Flight flight = sample_flight(stretches, walk.beta, end, true, xi_channel, xi);
      if (!(flight.t < end)) continue;
      beside.set(context.medium, stretches, flight.t);
      suns_at(walk, flight.t, beside, walk.beta * flight.weight / static_cast<double>(places), false, random);
    }
  }

  /// Of what a sun may bring, in the mean over channels and per what a walk of throughput 1 brings by an even law, the
  /// share that is looked for.
  static double worth_looking(const Spectrum& per_steradian) {
    return std::min(1.0, mean(per_steradian) * (4.0 * std::numbers::pi));
  }

  /// The suns' light scattered toward the walk at distance t of its segment, with throughput beta. thrifty: what is
  /// little is looked for seldom.
  void suns_at(const Walk& walk, double t, const ScatterPoint& there, const Spectrum& beta, bool thrifty,
               RandomStream& random) {
    const Vector point = walk.ray.at(t);
    for (std::size_t i = 0; i < context.lights.suns.size(); ++i) {
      const LightSample light = sample_sun(context.lights.suns[i], random.next(), random.next());
      const Spectrum f = there.scattered(deflection_between(-light.direction, -walk.ray.direction));
      if (is_zero(f)) continue;
      double weight = 1.0;
      const double beams =
          walk.sun_tries > 0.0 ? walk.sun_tries * context.beams[i].density(point, -light.direction) : 0.0;
      if (beams > 0.0) {
        const double chance = mean(extinction_at(stretches, t) * transmittance(stretches, t));
        weight -= shaft_weight(beams, walk.ray.origin, point, light.direction, walk.direction_density * chance);
      }
      // (With beams there are no lobes.)
      if (walk.lobe_density > 0.0) weight = balance(walk.direction_density, walk.lobe_density);
      const double looks = thrifty ? worth_looking(beta * f * weight) : 1.0;
      const bool in_vain = thrifty && random.next() >= looks;
      const Spectrum brought =
          in_vain ? Spectrum{}
                  : beta * f * light.radiance * unoccluded({point, light.direction}, infinity, random) / looks;
      learn_of_sun(walk, i, point, light.direction, brought);
      add(walk, brought * weight, 1, 0);
    }
  }

  /// Of a sun's light, at a point of the air where `scatter` is the mixture: with which density scattering toward the
  /// sun's lobe takes a direction.
  double sun_lobe(const Vector& next) const {
    return scatter.density(deflection_between(normalized(context.lights.suns[0].direction), -next));
  }

  /// Another way to sunlight one event ahead, where laws are narrow: at the next collision the sun will scatter toward
  /// the walk along few directions, seldom those that the walk took. Here one of those is taken, and the place sampled;
  /// the balance heuristic against the walk's own choice leaves of both peaks the lower.
  template <class Reflect, class Density>
  void toward_sun_lobe(Walk& walk, const Vector& from, RandomStream& random, Reflect reflect, Density density) {
    const double narrow = 10.0 * inverse_four_pi<double>();  // a forward value from which on this pays
    walk.lobe_density = 0.0;
    if (context.lights.suns.size() != 1 || !context.beams.empty()) return;
    if (context.max_depth != 0 && walk.depth() + 1 >= context.max_depth) return;
    if (scatter.density(Deflection<double>::from_ends(0.0, 2.0)) < narrow) return;
    walk.lobe_density = 1.0;  // until the direction is known
    const SunLight& sun = context.lights.suns[0];
    random.align(4);
    const double xi[2] = {random.next(), random.next()};
    const Deflection<double> turn = scatter.sample(xi[0]);
    const Ray ray{from, -normalized(around(Frame::around(normalized(sun.direction)), turn.mu, turn.sine(), xi[1]))};
    const Spectrum f = reflect(ray.direction);
    const double own = sun_lobe(ray.direction);
    if (is_zero(f) || !(own > 0.0)) return;
    const auto hit = intersect(ray);
    const double end = hit ? hit->t : infinity;
    const bool dense = is_dense(ray, walk.extinction, end);
    const double weight = balance(own, density(ray.direction)) / own;
    const double looks = dense ? worth_looking(f * (own * weight)) : 1.0;
    if (dense && random.next() >= looks) return;
    const double xi_channel = random.next(), xi_depth = random.next();
    if (!dense) stretches_along(context.medium, ray, end, stretches);
    if (!dense && stretches.empty()) return;
    const Flight flight = dense ? dense_flight(ray, end, f, xi_channel, xi_depth, random)
                                : sample_flight(stretches, f, end, true, xi_channel, xi_depth);
    if (!(flight.t < end)) return;
    const Vector place = ray.at(flight.t);
    beside.set(context.medium, stretches, flight.t);
    const LightSample light = sample_sun(sun, random.next(), random.next());
    const Spectrum scattered =
        f * flight.weight * beside.scattered(deflection_between(-light.direction, -ray.direction));
    if (is_zero(scattered)) return;
    add(walk, scattered * light.radiance * unoccluded({place, light.direction}, infinity, random) * (weight / looks), 2,
        0);
  }

  void learn_of_sun(const Walk& walk, std::size_t sun, const Vector& place, const Vector& toward,
                    const Spectrum& brought) {
    if (lessons == nullptr || walk.depth() == 0) return;
    ++sun_tries;
    if (const double worth = sum(brought); worth > 0.0 && std::isfinite(worth)) {
      lessons->push_back({static_cast<std::uint32_t>(sun), place, -toward, worth});
    }
  }

  /// The balance heuristic between two ways to a place in the air that lights `from`: along a ray of the sun that
  /// passes there, equiangularly seen from `from` (`beams`: rays per area), and by a walk (`walks`: density [1/sr] of
  /// the direction times that [1/m] of colliding there). The factor 1/r^2 of both is left out; so is how far the ray
  /// goes, which the one side does not know: any function of the place weighs without bias.
  static double shaft_weight(double beams, const Vector& from, const Vector& place, const Vector& toward,
                             double walks) {
    return balance(beams * length(cross(from - place, toward)) / std::numbers::pi, walks);
  }

  /// Another way to sunlight one event ahead, where walks seldom find it (SunBeams): along a ray of the sun, to the
  /// surface it hits and to a place in the air that it lights. As toward_lamplight, with that function's arguments.
  template <class Reflect, class Density>
  void toward_sunlight(Walk& walk, const Vector& from, int scatterings, int bounces, RandomStream& random,
                       Reflect reflect, Density density) {
    walk.sun_tries = 0.0;
    if (context.beams.empty() || (context.max_depth != 0 && walk.depth() + 1 >= context.max_depth)) return;
    walk.sun_tries = walk.depth() < 2 ? 1.0 : 0.3;
    if (walk.sun_tries < 1.0 && random.next() >= walk.sun_tries) return;
    random.align(4);
    for (std::size_t i = 0; i < context.beams.size(); ++i) {
      const SunBeams& beams = context.beams[i];
      if (!beams.useful()) continue;
      const double xi[2] = {random.next(), random.next()};
      const LightSample sun = sample_sun(context.lights.suns[i], random.next(), random.next());
      const Ray beam{beams.sample(xi[0], xi[1]), -sun.direction};
      const auto lit = intersect(beam);
      if (lit) {
        const Vector way = lit->point - from;
        const double squared = length_squared(way);
        const Vector direction = squared > 0.0 ? way / std::sqrt(squared) : Vector{};
        const Spectrum f = squared > 0.0 ? reflect(direction) : Spectrum{};
        const Spectrum reflected =
            is_zero(f) ? f : evaluate(surface_point(context.geometry, *lit), -direction, sun.direction);
        if (!is_zero(reflected)) {
          const double own = walk.sun_tries * sunlit_density(i, *lit, beam.direction, from);
          const Spectrum through = transmittance(context.medium, {lit->point, sun.direction}, infinity, shadow);
          const Vector start = context.geometry.leave(lit->point, lit->geometric_normal);
          const double weight = balance(own, density(direction)) / own;
          add(walk, f * reflected * sun.radiance * through * unoccluded(from, start, random) * weight, scatterings,
              bounces + 1);
        }
      }
      const std::optional<Shaft> shaft =
          shaft_along(beam, lit ? lit->t : infinity, from, false, 0.5, random.next(), reflect);
      if (!shaft) continue;
      const Spectrum extinction = extinction_at(stretches, shaft->t);
      const Spectrum clear = exactly_unoccluded(from, shaft->place);  // its weight hangs on it
      if (is_zero(clear)) continue;
      const double rays = walk.sun_tries * beams.density(shaft->place, beam.direction);
      const double weight =
          shaft_weight(rays, from, shaft->place, sun.direction, density(shaft->direction) * mean(extinction * clear));
      const Spectrum light =
          sun.radiance * transmittance(context.medium, {shaft->place, sun.direction}, infinity, shadow);
      add(walk, shaft->scattered * light * clear * (weight / (rays * shaft->density)), scatterings + 1, bounces);
    }
  }

  /// A place in the air that a ray of light passes on its way [0, end], and what of it goes on from there by `from`:
  /// reflect at `from` times scattering at the place. density: [1/m] of the distance t, times the squared distance of
  /// the place from `from`. Sets `stretches` to those of the ray. with_care: t is chosen by what arrives; otherwise
  /// equiangularly about `from`.
  struct Shaft {
    double t, density;
    Vector place, direction;  // direction: unit, from `from` to the place
    Spectrum scattered;
  };
  template <class Reflect>
  std::optional<Shaft> shaft_along(const Ray& beam, double end, const Vector& from, bool with_care, double choice,
                                   double xi, Reflect reflect) {
    stretches_along(context.medium, beam, end, stretches);
    if (stretches.empty()) return std::nullopt;
    Interval air{infinity, 0.0};
    for (const Stretch& s : stretches) {
      air = {std::min(air.begin, s.range.begin), std::max(air.end, s.range.end)};
    }
    const Vector start = from - beam.origin;
    const double a = dot(start, beam.direction), h = length(cross(start, beam.direction));
    const auto product = [&](double t) {
      const Vector way = beam.at(t) - from;
      const double squared = length_squared(way);
      if (!with_care || squared == 0.0) return 0.0;
      const Vector direction = way / std::sqrt(squared);
      beside.set(context.medium, stretches, t);
      return sum(reflect(direction) * beside.scattered(deflection_between(beam.direction, -direction)));
    };
    const DistanceTable::Sample at = DistanceTable(air, a, h, air.end, product).sample(choice, xi);
    if (!(at.t > air.begin && at.t < air.end) || !(at.density > 0.0)) return std::nullopt;
    Shaft shaft{at.t, 0.0, beam.at(at.t), {}, {}};
    const Vector way = shaft.place - from;
    const double squared = length_squared(way);
    if (squared == 0.0) return std::nullopt;
    shaft.density = at.density * squared;
    shaft.direction = way / std::sqrt(squared);
    const Spectrum f = reflect(shaft.direction);
    if (is_zero(f)) return std::nullopt;
    beside.set(context.medium, stretches, at.t);
    shaft.scattered = f * beside.scattered(deflection_between(beam.direction, -shaft.direction));
    if (is_zero(shaft.scattered)) return std::nullopt;
    return shaft;
  }

  /// Density [1/sr] at `from` of the direction to a place on a surface that a ray of the sun hits, chosen as above.
  double sunlit_density(std::size_t sun, const Hit& lit, const Vector& travel, const Vector& from) const {
    const Vector way = lit.point - from;
    const double facing = std::fabs(dot(lit.geometric_normal, normalized(way)));
    if (facing == 0.0) return 0.0;
    return context.beams[sun].density(lit.point, travel) * std::fabs(dot(lit.geometric_normal, travel)) *
           length_squared(way) / facing;
  }

  /// Light of a lamp scattered back along the ray of `stretches` at a sampled distance, over the sample's density.
  Spectrum airlight(const Ray& ray, double end, const LampSegment::Sample& at, RandomStream& random) {
    if (!(at.t > 0.0 && at.t < end) || !(at.density > 0.0)) return {};
    const Lamp& lamp = context.lights.lamps[at.lamp];
    const Vector point = ray.at(at.t), way = point - lamp.position;
    const double squared = length_squared(way);
    if (squared == 0.0) return {};
    const Vector travel = way / std::sqrt(squared);  // of the lamp's light
    const Spectrum intensity = lamp.intensity_toward(travel);
    if (is_zero(intensity)) return {};
    beside.set(context.medium, stretches, at.t);
    const Spectrum scattered = beside.scattered(deflection_between(travel, -ray.direction));
    const Spectrum light = intensity * scattered * transmittance(stretches, at.t) / (squared * at.density);
    return is_zero(light) ? light : light * unoccluded(point, lamp.position, random);
  }

  void aim(Walk& walk, const Vector& from, const Spectrum& extinction) const {
    const double tries = walk.depth() < 2 ? 1.0 : 0.3;
    walk.aim = LampAim(context.lights.lamps, from, sum(walk.beta * extinction) / sum(walk.beta), tries);
  }

  /// More ways to the light of lamps one event ahead, for a walk about to leave `from` after `scatterings` or
  /// `bounces`. The walk's own direction, chosen by the phase function or the surface alone, would meet it as sparks:
  /// in the air near a lamp light goes as 1/angle, and a lamp may light a small place brightly. Two more directions are
  /// drawn, one around a lamp with density 1/sin(angle), one to a place that a ray of a lamp hits; with the walk's own,
  /// the balance heuristic bounds all weights. reflect(direction) is throughput per steradian, density(direction) that
  /// of the walk's own choice.
  template <class Reflect, class Density>
  void toward_lamplight(const Walk& walk, const Vector& from, int scatterings, int bounces, RandomStream& random,
                        Reflect reflect, Density density) {
    const std::vector<Lamp>& lamps = context.lights.lamps;
    if (lamps.empty() || (context.max_depth != 0 && walk.depth() + 1 >= context.max_depth)) return;
    const double tries = walk.aim.tries();
    if (random.next() >= tries) return;
    const double xi[6] = {random.next(), random.next(), random.next(), random.next(), random.next(), random.next()};
    const std::size_t lamp = walk.aim.choose(lamps, xi[0]);
    const Ray around_lamp{from, walk.aim.direction(lamps[lamp], xi[1], xi[2])};
    if (const Spectrum f = reflect(around_lamp.direction); !is_zero(f) && !context.medium.species.empty()) {
      const double own = tries * walk.aim.density(lamps[lamp], around_lamp.direction);
      const auto hit = intersect(around_lamp);
      const double end = hit ? hit->t : infinity;
      stretches_along(context.medium, around_lamp, end, stretches);
      if (own > 0.0 && !stretches.empty()) {
        segment.set(context.medium, stretches, around_lamp, end, f);
        const LampSegment::Sample at = segment.sample_one(lamps, lamp, xi[3], xi[4]);
        const double other = density(around_lamp.direction);
        const double weight = balance(own, other) / own *
                              (1.0 - lamp_shaft_weight(walk.aim, lamps[lamp], from, around_lamp.at(at.t), own + other));
        add(walk, f * airlight(around_lamp, end, at, random) * weight, scatterings + 1, bounces);
      }
    }
    const double xi_beam[4] = {random.next(), random.next(), random.next(), random.next()};
    const Ray beam{lamps[lamp].position, walk.aim.beam(lamps[lamp], xi[5], xi_beam[0], xi_beam[1])};
    const Spectrum intensity = lamps[lamp].intensity_toward(beam.direction);
    const auto lit = intersect(beam);
    if (lit) add_lit_surface(walk, from, scatterings, bounces, lamp, beam, *lit, intensity, random, reflect, density);
    if (lamps[lamp].spot == nullptr) return;
    const std::optional<Shaft> shaft =
        shaft_along(beam, lit ? lit->t : infinity, from, true, xi_beam[2], xi_beam[3], reflect);
    if (!shaft) return;
    const Spectrum through = transmittance(stretches, shaft->t);
    const double walks = tries * walk.aim.density(lamps[lamp], shaft->direction) + density(shaft->direction);
    const double weight = lamp_shaft_weight(walk.aim, lamps[lamp], from, shaft->place, walks);
    const double own = tries * walk.aim.chance(lamps[lamp]) * walk.aim.beam_density(lamps[lamp], beam.direction);
    add(walk,
        shaft->scattered * intensity * through * unoccluded(from, shaft->place, random) *
            (weight / (own * shaft->density)),
        scatterings + 1, bounces);
  }

  /// The balance heuristic between two ways to a place in the air that a lamp lights and that lights `from`: along a
  /// ray of the lamp, and from `from` in a direction of density `walks` [1/sr]; both equiangularly, so that what is
  /// left of distances are the sines of the angles at which lamp and `from` see each other and the place. Those of half
  /// the angles serve as well, and need no care at the ends: any function of the place weighs without bias. Rays of
  /// point lights, which go everywhere, are not followed in the air.
  static double lamp_shaft_weight(const LampAim& aim, const Lamp& lamp, const Vector& from, const Vector& place,
                                  double walks) {
    if (lamp.spot == nullptr || length_squared(lamp.position - from) == 0.0) return 0.0;
    const Vector across = normalized(lamp.position - from);
    const Vector travel = normalized(place - lamp.position);
    const double here = length(across - normalized(place - from)), there = length(across + travel);
    return balance(aim.tries() * aim.chance(lamp) * aim.beam_density(lamp, travel) * there, walks * here);
  }

  /// Light of a lamp that a surface where one of its rays ends reflects toward `from`.
  template <class Reflect, class Density>
  void add_lit_surface(const Walk& walk, const Vector& from, int scatterings, int bounces, std::size_t lamp,
                       const Ray& beam, const Hit& lit, const Spectrum& intensity, RandomStream& random,
                       Reflect reflect, Density density) {
    const Vector way = lit.point - from;
    if (length_squared(way) == 0.0) return;
    const Vector direction = normalized(way);
    const Spectrum f = reflect(direction);
    if (is_zero(f)) return;
    const Spectrum reflected = evaluate(surface_point(context.geometry, lit), -direction, -beam.direction);
    if (is_zero(reflected)) return;
    const double own = walk.aim.tries() * beam_density(walk, lamp, lit, from);
    const Spectrum light = intensity / (lit.t * lit.t);
    const Spectrum through = transmittance(context.medium, beam, lit.t, shadow);
    const Vector start = context.geometry.leave(lit.point, lit.geometric_normal);
    const double weight = balance(own, density(direction)) / own;
    add(walk, f * reflected * light * through * unoccluded(from, start, random) * weight, scatterings, bounces + 1);
  }

  /// Density [1/sr] at `from` of the direction to a place on a surface that a ray of a lamp hits, chosen as above.
  double beam_density(const Walk& walk, std::size_t lamp, const Hit& lit, const Vector& from) const {
    const Lamp& light = context.lights.lamps[lamp];
    const Vector way = lit.point - from, beam = lit.point - light.position;
    const double facing = std::fabs(dot(lit.geometric_normal, normalized(way)));
    const double incidence = std::fabs(dot(lit.geometric_normal, normalized(beam)));
    if (facing == 0.0) return 0.0;
    const double per_area =
        walk.aim.chance(light) * walk.aim.beam_density(light, normalized(beam)) * incidence / length_squared(beam);
    return per_area * length_squared(way) / facing;
  }

  /// A collision at distance t of the walk's segment: adds direct light of surroundings and emissive surfaces, and that
  /// of suns if it stands for the segment's, and turns.
  bool collide(Walk& walk, double t, bool with_suns, RandomStream& random) {
    ++counts.collisions;
    scatter.set(context.medium, stretches, t);
    const Vector point = walk.ray.at(t);
    if (with_suns) suns_at(walk, t, scatter, walk.beta, true, random);
    scatter.aim(walk.beta);
    const double xi[2] = {random.next(), random.next()};
    if (is_zero(walk.beta * scatter.scattering())) return false;
    // Light travels against the walk: toward the eye along -direction.
    const auto toward = [&](const Vector& to_light) { return deflection_between(-to_light, -walk.ray.direction); };
    // Late walks are those that hardly find out: any way to the sky is good.
    walk.sought_sky = walk.depth() >= 16 || !context.lights.even_environment();
    for (const auto& light : {walk.sought_sky ? context.lights.sample_environment(random) : LightSample{},
                              context.lights.sample_emitter(point, random)}) {
      if (!(light.density > 0.0)) continue;
      const Deflection<double> d = toward(light.direction);
      const double weight = balance(light.density, scatter.density(d)) / light.density;
      const Spectrum contribution = walk.beta * scatter.scattered(d) * light.radiance * weight;
      if (!is_zero(contribution))
        add(walk, contribution * unoccluded({point, light.direction}, light.distance, random), 1, 0);
    }
    walk.extinction = extinction_at(stretches, t);
    aim(walk, point, walk.extinction);
    const auto reflect = [&](const Vector& next) {
      return walk.beta * scatter.scattered(deflection_between(walk.ray.direction, next));
    };
    const auto density_of = [&](const Vector& next) {
      return scatter.density(deflection_between(walk.ray.direction, next));
    };
    toward_lamplight(walk, point, 1, 0, random, reflect, density_of);
    toward_sunlight(walk, point, 1, 0, random, reflect, density_of);
    toward_sun_lobe(walk, point, random, reflect, density_of);
    const Deflection<double> d = scatter.sample(xi[0]);
    const double density = scatter.density(d);
    if (!(density > 0.0)) return false;
    walk.beta *= scatter.scattered(d) / density;
    walk.ray = {point, normalized(around(Frame::around(walk.ray.direction), d.mu, d.sine(), xi[1]))};
    walk.direction_density = density;
    if (walk.lobe_density > 0.0) walk.lobe_density = sun_lobe(walk.ray.direction);
    ++walk.scatterings;
    if (walk.first_promise == 0.0) walk.first_promise = context.lights.promise_at(point);
    return !is_zero(walk.beta);
  }

  /// The walk has met a surface: adds its emission and the light it reflects directly, and reflects.
  bool bounce(Walk& walk, const Hit& hit, RandomStream& random) {
    ++counts.bounces;
    const Spectrum emitted = context.lights.emission(hit);
    if (!is_zero(emitted)) {
      const double other = walk.direction_density > 0.0 ? context.lights.emitter_density(hit, walk.ray) : 0.0;
      add(walk, walk.beta * emitted * (other > 0.0 ? balance(walk.direction_density, other) : 1.0), 0, 0);
    }
    if (!may_go_on(walk)) return false;
    random.align(4);
    const double xi[3] = {random.next(), random.next(), random.next()};
    const Reflection surface(surface_point(context.geometry, hit), -walk.ray.direction);
    const Vector start = context.geometry.leave(hit.point, hit.geometric_normal);
    const LampSample lamp = context.lights.sample_lamp(
        start, random.next(), [&](const Vector& toward) { return walk.beta * surface.evaluate(toward); });
    if (lamp.density > 0.0) {
      const Vector position = context.lights.lamps[lamp.lamp].position;
      const double weight =
          walk.direction_density > 0.0
              ? balance(walk.direction_density, walk.aim.tries() * beam_density(walk, lamp.lamp, hit, walk.ray.origin))
              : 1.0;
      add(walk, lamp.reflected * unoccluded(start, position, random) * (weight / lamp.density), 0, 1);
    }
    for (std::size_t i = 0; i < context.lights.suns.size(); ++i) {
      const LightSample light = sample_sun(context.lights.suns[i], random.next(), random.next());
      const Spectrum f = surface.evaluate(light.direction);
      if (is_zero(f)) continue;
      const Spectrum brought = walk.beta * f * light.radiance * unoccluded({start, light.direction}, infinity, random);
      learn_of_sun(walk, i, hit.point, light.direction, brought);
      const double beams =
          walk.sun_tries > 0.0 ? walk.sun_tries * sunlit_density(i, hit, -light.direction, walk.ray.origin) : 0.0;
      add(walk, brought * (beams > 0.0 ? balance(walk.direction_density, beams) : 1.0), 0, 1);
    }
    for (const auto& light :
         {context.lights.sample_environment(random), context.lights.sample_emitter(start, random)}) {
      if (!(light.density > 0.0)) continue;
      const Spectrum f = surface.evaluate(light.direction);
      if (is_zero(f)) continue;
      const double weight = balance(light.density, surface.density(light.direction)) / light.density;
      add(walk, walk.beta * f * light.radiance * weight * unoccluded({start, light.direction}, light.distance, random),
          0, 1);
    }
    stretches_along(context.medium, {start, hit.geometric_normal}, infinity, stretches);
    walk.extinction = extinction_at(stretches, 0.0);
    aim(walk, start, walk.extinction);
    const auto reflect = [&](const Vector& next) { return walk.beta * surface.evaluate(next); };
    const auto density_of = [&](const Vector& next) { return surface.density(next); };
    toward_lamplight(walk, start, 0, 1, random, reflect, density_of);
    toward_sunlight(walk, start, 0, 1, random, reflect, density_of);
    const Vector in = surface.sample(xi[2], xi[0], xi[1]);
    const double density = surface.density(in);
    if (!(density > 0.0)) return false;
    walk.beta *= surface.evaluate(in) / density;
    walk.ray = {start, in};
    walk.direction_density = density;
    walk.lobe_density = 0.0;
    walk.sought_sky = true;
    ++walk.bounces;
    if (walk.first_promise == 0.0) walk.first_promise = context.lights.promise_at(start);
    return !is_zero(walk.beta) && is_finite(walk.beta);
  }

  /// The walk leaves for the surroundings. Only the eye may see the sun's disc: everything else samples it as a light.
  void leave_scene(const Walk& walk, bool sees_sun) {
    const double density = walk.sought_sky ? context.lights.environment_density(walk.ray.direction) : 0.0;
    const double weight = density > 0.0 ? balance(walk.direction_density, density) : 1.0;
    add(walk, walk.beta * context.lights.environment(walk.ray.direction) * weight, 0, 0);
    if (!sees_sun) return;
    for (const SunLight& sun : context.lights.suns) add(walk, walk.beta * sun_disc(sun, walk.ray.direction), 0, 0);
  }
};

PathTracer::PathTracer(const PathContext& context) : state_(new State(context.prepared())) {}
PathTracer::~PathTracer() = default;
void PathTracer::teach(std::vector<SunLesson>& lessons) { state_->lessons = &lessons; }
std::uint64_t PathTracer::sun_tries() const { return state_->sun_tries; }
const PathCounts& PathTracer::counts() const { return state_->counts; }
PathSample PathTracer::trace(const Ray& ray, double distance, RandomStream& random, bool sees_sun) {
  return state_->trace(ray, distance, random, sees_sun);
}

}  // namespace tyndall
