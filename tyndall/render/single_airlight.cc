#include "tyndall/render/single_airlight.h"

#include <algorithm>

#include "tyndall/light/airlight_adaptive.h"
#include "tyndall/medium/free_flight.h"

namespace tyndall {
namespace {

/// Deeper than this nothing is seen: e^-60.
constexpr double opaque = 60.0;

/// Whether two lobes are one: of one kind and alike in three directions.
bool same(const Lobe<double>& a, const Lobe<double>& b) {
  const auto alike = [&](double mu) {
    const auto value = [&](const auto& l) { return l.density(Deflection<double>::from_mu(mu)); };
    return std::visit(value, a) == std::visit(value, b);
  };
  return a.index() == b.index() && alike(-1.0) && alike(0.3) && alike(1.0);
}

void sort_unique(std::vector<double>& x) {
  std::sort(x.begin(), x.end());
  x.erase(std::unique(x.begin(), x.end()), x.end());
}

/// e^-depth per channel, times value; depths may be infinite and values too where they are.
void attenuate(Spectrum& value, const Spectrum& depth) {
  for (std::size_t c = 0; c < channel_count; ++c) value[c] = depth[c] < 740.0 ? value[c] * std::exp(-depth[c]) : 0.0;
}

}  // namespace

SingleMedium::SingleMedium(const Medium& from) : lowered(lower(from)) {
  lobes.resize(lowered.lobes.size());
  kind.resize(lowered.lobes.size());
  bool constant = true, alike = true;
  for (const LoweredSpecies& s : lowered.species) {
    for (std::size_t i = s.first_lobe; i < s.first_lobe + s.lobe_count; ++i) {
      const WeightedLobe<double>& lobe = lowered.lobes[i];
      lobes[i] = {s.scattering * lobe.weight, lobe.lobe};
      std::size_t k = 0;
      while (k < kinds.size() && !same(kinds[k], lobe.lobe)) ++k;
      if (k == kinds.size()) kinds.push_back(lobe.lobe);
      kind[i] = k;
    }
    constant = constant && s.decay == 0.0 && s.spheres.empty();
    alike = alike && s.boxes.empty() && s.spheres.empty() && s.decay == lowered.species.front().decay;
  }
  linear = constant || alike;
}

void RayMedium::set(const SingleMedium& medium, const Ray& ray, double end) {
  medium_ = &medium;
  ray_ = ray;
  borders_.clear();
  marks_.clear();
  stretches_along(medium.lowered, ray, end, stretches_);
  reach_ = 0.0;
  for (const Stretch& s : stretches_) reach_ = std::max(reach_, s.range.end);
  if (!(reach_ > 0.0)) return;
  // Opaque in every channel that scatters at all: the end of what is seen. A channel that never gets there, as the
  // medium thins with height, ends where the densest of what is left is a part in 1e18.
  double last = 0.0;
  for (std::size_t c = 0; c < channel_count; ++c) {
    double thinning = 0.0;
    bool scatters = false;
    for (const Stretch& s : stretches_) {
      if (!(s.species->extinction[c] > 0.0)) continue;
      scatters = true;
      const double away = s.rate > 0.0 ? std::min(s.range.end, s.range.begin + 42.0 / s.rate) : s.range.end;
      thinning = std::max(thinning, away);
    }
    if (scatters) last = std::max(last, std::min(thinning, distance_at_depth(stretches_, c, opaque, reach_)));
  }
  reach_ = std::min(reach_, last);
  for (const Stretch& s : stretches_) {
    if (s.range.begin > 0.0) borders_.push_back(s.range.begin);
    borders_.push_back(s.range.end);
    if (s.rate == 0.0) continue;
    // 16 points follow an exponential of an exponential over 3 scale lengths; further from its dense end than 45 of
    // them nothing is left of it.
    const double step = 3.0 / std::fabs(s.rate), top = std::min(s.range.end, reach_);
    for (int k = 1; k <= 15; ++k) {
      const double t = s.rate > 0.0 ? s.range.begin + k * step : top - k * step;
      if (t > s.range.begin && t < top) marks_.push_back(t);
    }
  }
  for (std::size_t c = 0; c < channel_count; ++c) {
    for (const double depth : {0.3, 3.0, 12.0, 30.0}) marks_.push_back(distance_at_depth(stretches_, c, depth, reach_));
  }
  const auto outside = [&](double t) { return !(t > 0.0 && t < reach_); };
  std::erase_if(borders_, outside);
  std::erase_if(marks_, outside);
  sort_unique(borders_);
  sort_unique(marks_);
}

double SingleLamp::falloff(const Vector& away) const {
  switch (shape) {
    case Shape::spot:
      return spot_falloff(spot, dot(axis, away));
    case Shape::one_sided:
      return std::max(0.0, dot(axis, away));
    case Shape::two_sided:
      return std::fabs(dot(axis, away));
    case Shape::point:
      break;
  }
  return 1.0;
}

Spectrum depth_between(const LoweredMedium& medium, const Vector& a, const Vector& b, std::vector<Stretch>& scratch) {
  // From the lower end, where the air is thickest: upward, exponentials only fall.
  const Vector &from = a.y < b.y ? a : b, &to = a.y < b.y ? b : a;
  const Vector way = to - from;
  const double distance = length(way);
  if (!(distance > 0.0)) return {};
  stretches_along(medium, {from, way / distance}, distance, scratch);
  return optical_depth(scratch, distance);
}

namespace {

/// Places on the ray where the light's way begins or ceases to meet a shape of the medium, or meets another face of
/// it: the projections of the corners that the wedge's plane cuts out of boxes, and of the tangents to spheres. Between
/// them the light's optical depth is smooth.
void add_kinks(const LoweredMedium& medium, const Wedge& wedge, std::vector<double>& breaks) {
  if (!wedge.flat) return;
  const auto add = [&](double px, double py) {
    if (py > 0.0 && (wedge.far || py < wedge.aside)) breaks.push_back(wedge.projected(px, py));
  };
  for (const LoweredSpecies& s : medium.species) {
    for (const Box& box : s.boxes) {
      for (int axis = 0; axis < 3; ++axis) {
        for (int corner = 0; corner < 4; ++corner) {
          double p[3], e[3] = {0.0, 0.0, 0.0};
          p[axis] = box.low[axis];
          e[axis] = box.high[axis] - box.low[axis];
          const int b = (axis + 1) % 3, c = (axis + 2) % 3;
          p[b] = corner % 2 == 0 ? box.low[b] : box.high[b];
          p[c] = corner / 2 == 0 ? box.low[c] : box.high[c];
          const Vector start = Vector{p[0], p[1], p[2]} - wedge.origin, edge{e[0], e[1], e[2]};
          const double rise = dot(edge, wedge.z), height = dot(start, wedge.z);
          if (rise == 0.0) continue;
          const double at = -height / rise;
          if (at < 0.0 || at > 1.0) continue;
          const Vector q = start + edge * at;
          add(dot(q, wedge.x), dot(q, wedge.y));
        }
      }
    }
    for (const Sphere& sphere : s.spheres) {
      const Vector to = sphere.center - wedge.origin;
      const double cx = dot(to, wedge.x), cy = dot(to, wedge.y), cz = dot(to, wedge.z);
      const double disc = sphere.radius * sphere.radius - cz * cz;
      if (!(disc > 0.0)) continue;
      if (wedge.far) {
        const double norm = std::sqrt(disc) / std::hypot(wedge.slope, 1.0);
        add(cx + norm, cy - wedge.slope * norm);
        add(cx - norm, cy + wedge.slope * norm);
      } else {
        const double dx = cx - wedge.along, dy = cy - wedge.aside, squared = dx * dx + dy * dy;
        if (!(squared > disc)) continue;
        const double along = (squared - disc) / squared, across = std::sqrt(disc * (squared - disc)) / squared;
        add(wedge.along + dx * along - dy * across, wedge.aside + dy * along + dx * across);
        add(wedge.along + dx * along + dy * across, wedge.aside + dy * along - dx * across);
      }
    }
  }
}

/// What the triangle between a piece of ray and a lamp is filled with, when that is the same everywhere.
struct Homogeneous {
  Spectrum extinction;
  std::vector<ScatteringLobe> lobes;
};

/// Fills `fill` for [begin, end], which has no border inside; false when the medium in the triangle varies.
bool homogeneous(const RayMedium& along, const Wedge& piece, const Vector& lamp, Homogeneous& fill) {
  fill.extinction = {};
  fill.lobes.clear();
  const double middle = piece.range.end < infinity ? 0.5 * (piece.range.begin + piece.range.end) : infinity;
  const SingleMedium& medium = along.medium();
  for (const LoweredSpecies& s : medium.lowered.species) {
    const auto holds_lamp = [&](const auto& shape) { return contains(shape, lamp); };
    const auto missed = [&](const auto& shape) { return piece.misses(shape); };
    if (std::any_of(s.boxes.begin(), s.boxes.end(), missed)) continue;
    if (std::any_of(s.spheres.begin(), s.spheres.end(), missed)) continue;
    if (s.decay != 0.0) return false;
    const bool bounded = !s.boxes.empty() || !s.spheres.empty();
    if (bounded) {
      // Shapes are convex: piece and lamp inside means everything between them inside.
      const bool present = std::any_of(along.stretches().begin(), along.stretches().end(), [&](const Stretch& stretch) {
        return stretch.species == &s && stretch.range.begin < middle && middle < stretch.range.end;
      });
      if (!present || !std::all_of(s.boxes.begin(), s.boxes.end(), holds_lamp) ||
          !std::all_of(s.spheres.begin(), s.spheres.end(), holds_lamp)) {
        return false;
      }
    }
    fill.extinction += s.extinction;
    for (const ScatteringLobe& lobe : medium.lobes_of(s)) fill.lobes.push_back(lobe);
  }
  return true;
}

/// The falloff of a lamp along a ray, as a function of the deflection.
struct LampFalloff {
  SingleLamp::Shape shape;
  double axis_along, axis_aside;
  SpotFalloff ramp;

  LampFalloff(const SingleLamp& lamp, const LampView& view, bool full)
      : shape(full ? SingleLamp::Shape::point : lamp.shape),
        axis_along(dot(lamp.axis, view.direction)),
        axis_aside(dot(lamp.axis, view.normal)),
        ramp(view, lamp.spot, lamp.axis) {}

  double operator()(const Deflection<double>& d) const {
    if (shape == SingleLamp::Shape::point) return 1.0;
    if (shape == SingleLamp::Shape::spot) return ramp(d);
    const double cosine = -d.mu * axis_along - d.sine() * axis_aside;
    return shape == SingleLamp::Shape::one_sided ? std::max(0.0, cosine) : std::fabs(cosine);
  }
};

/// Adaptive panels over one lit stretch of a ray.
class LampIntegral {
 public:
  LampIntegral(const RayMedium& along, const SingleLamp& lamp, const LampView& view, const std::vector<double>& kinks,
               double tolerance)
      : along_(along), lamp_(lamp), view_(view), kinks_(kinks), tolerance_(tolerance) {
    position_ = along.ray().at(view.place.along) + view.normal * view.place.aside;
  }

  Spectrum over(const BeamPart& part) {
    const AirlightStretch stretch = AirlightStretch::of(view_.place, part.stretch);
    if (stretch.diverges) return diverging();
    const LampFalloff falloff(lamp_, view_, part.full);
    breaks_.assign({0.0, stretch.span});
    for (const auto* list : {&along_.borders(), &along_.marks(), &kinks_}) {
      for (const double t : *list) {
        if (!(t > part.stretch.begin && t < part.stretch.end)) continue;
        const double x = stretch.x_at(part.stretch.begin, t);
        if (x < stretch.span) breaks_.push_back(x);
      }
    }
    std::sort(breaks_.begin(), breaks_.end());
    return integrate_adaptively(breaks_, airlight_panel, tolerance_, [&](double x) {
      const AirlightStretch::Point p = stretch.at(x);
      const double t = std::clamp(stretch.t_at(p.v), part.stretch.begin, part.stretch.end);
      Spectrum value = scattered(t, p.deflection) * (p.weight * falloff(p.deflection));
      const Vector point = position_ + view_.toward(p.deflection) * stretch.distance_at(p.v);
      attenuate(value, optical_depth(along_.stretches(), t) +
                           depth_between(along_.medium().lowered, position_, point, scratch_));
      return value;
    });
  }

 private:
  Spectrum scattered(double t, const Deflection<double>& d) const {
    Spectrum sum;
    for (const Stretch& s : along_.stretches()) {
      if (t < s.range.begin || t > s.range.end) continue;
      Spectrum part;
      for (const ScatteringLobe& lobe : along_.medium().lobes_of(*s.species)) {
        part += lobe.scattering * std::visit([&](const auto& l) { return l.density(d); }, lobe.lobe);
      }
      sum += part * s.factor_at(t);
    }
    return sum;
  }
  /// A lamp on the ray: infinite where there is anything at it to scatter its light.
  Spectrum diverging() const {
    Spectrum there = scattered(view_.place.along, Deflection<double>::from_mu(0.0));
    attenuate(there, optical_depth(along_.stretches(), view_.place.along));
    return map(there, [](double x) { return x > 0.0 ? infinity : 0.0; });
  }

  const RayMedium& along_;
  const SingleLamp& lamp_;
  const LampView& view_;
  const std::vector<double>& kinks_;
  double tolerance_;
  Vector position_;
  std::vector<double> breaks_;
  std::vector<Stretch> scratch_;
};

/// A lit stretch cut into parts in which the falloff is smooth.
void falloff_parts(const LampView& view, const SingleLamp& lamp, const Interval& lit, std::vector<BeamPart>& parts) {
  switch (lamp.shape) {
    case SingleLamp::Shape::point:
      parts.push_back({lit, true});
      return;
    case SingleLamp::Shape::spot:
      beam_parts(view, lamp.spot, lamp.axis, lit, parts);
      return;
    case SingleLamp::Shape::one_sided:
    case SingleLamp::Shape::two_sided:
      break;
  }
  const auto add = [&](const Interval& side) {
    const Interval part = intersection(lit, side);
    if (part.begin < part.end) parts.push_back({part, false});
  };
  add(cone_stretch(view, lamp.axis, 90.0));
  if (lamp.shape == SingleLamp::Shape::two_sided) add(cone_stretch(view, -lamp.axis, 90.0));
}

}  // namespace

Spectrum lamp_airlight(const RayMedium& along, const SingleLamp& lamp, std::span<const Interval> lit,
                       double tolerance) {
  Spectrum sum;
  if (along.empty() || is_zero(lamp.intensity)) return sum;
  LampView view = LampView::of(along.ray(), lamp.position);
  view.place.aside = std::sqrt(view.place.aside * view.place.aside + lamp.softening);
  std::vector<BeamPart> parts;
  for (const Interval& stretch : lit) {
    const Interval within = intersection(stretch, {0.0, along.reach()});
    if (within.begin < within.end) falloff_parts(view, lamp, within, parts);
  }
  if (parts.empty()) return sum;
  const Vector position = along.ray().at(view.place.along) + view.normal * view.place.aside;
  std::vector<double> kinks;
  bool have_kinks = false;
  Homogeneous fill;
  std::optional<LampIntegral> varying;
  for (const BeamPart& part : parts) {
    // Piece by piece between borders, as long as the medium is homogeneous around each.
    Spectrum piecewise;
    bool simple = true;
    double begin = part.stretch.begin;
    for (auto border = std::upper_bound(along.borders().begin(), along.borders().end(), begin); simple;) {
      const bool last = border == along.borders().end() || *border >= part.stretch.end;
      const double end = last ? part.stretch.end : *border++;
      const Wedge piece = Wedge::toward_lamp(along.ray(), {begin, end}, position);
      simple = homogeneous(along, piece, position, fill);
      if (simple && !fill.lobes.empty()) {
        // Seen from the piece's begin; the rest of the way to the origin is transmittance.
        const LampAside place{view.place.along - begin, view.place.aside};
        const Interval stretch{0.0, end - begin};
        const Spectrum light =
            part.full ? airlight(fill.lobes, fill.extinction, place, stretch)
                      : airlight_by_panels(fill.lobes, fill.extinction, AirlightStretch::of(place, stretch),
                                           LampFalloff(lamp, view, false));
        const Spectrum through = along.transmittance_to(begin);
        for (std::size_t c = 0; c < channel_count; ++c) {
          if (through[c] > 0.0) piecewise[c] += light[c] * through[c];
        }
      }
      if (last) break;
      begin = end;
    }
    if (simple) {
      sum += piecewise;
      continue;
    }
    if (!have_kinks) {
      add_kinks(along.medium().lowered, Wedge::toward_lamp(along.ray(), {0.0, along.reach()}, position), kinks);
      have_kinks = true;
    }
    if (!varying) varying.emplace(along, lamp, view, kinks, tolerance);
    sum += varying->over(part);
  }
  Spectrum radiance;
  for (std::size_t c = 0; c < channel_count; ++c) {
    if (sum[c] > 0.0 && lamp.intensity[c] > 0.0) radiance[c] = sum[c] * lamp.intensity[c];
  }
  return radiance;
}

Spectrum sun_airlight(const RayMedium& along, const Vector& toward, std::span<const Interval> lit, double tolerance) {
  Spectrum sum;
  if (along.empty() || lit.empty()) return sum;
  const SingleMedium& medium = along.medium();
  const Vector& direction = along.ray().direction;
  // Light travels along -toward before, along -direction after.
  const auto deflection =
      Deflection<double>::from_ends(0.5 * length_squared(toward - direction), 0.5 * length_squared(toward + direction));
  std::vector<Spectrum> strength;  // of each stretch, where its factor is 1
  for (const Stretch& s : along.stretches()) {
    Spectrum scattering;
    for (const ScatteringLobe& lobe : medium.lobes_of(*s.species)) {
      scattering += lobe.scattering * std::visit([&](const auto& l) { return l.density(deflection); }, lobe.lobe);
    }
    strength.push_back(scattering);
  }
  if (std::all_of(strength.begin(), strength.end(), [](const Spectrum& s) { return is_zero(s); })) return sum;
  std::vector<Stretch> scratch;
  const auto depth_at = [&](double t) {
    stretches_along(medium.lowered, {along.ray().at(t), toward}, infinity, scratch);
    return optical_depth(along.stretches(), t) + optical_depth(scratch, infinity);
  };
  std::vector<double> kinks;
  add_kinks(medium.lowered, Wedge::toward_direction(along.ray(), {0.0, along.reach()}, toward), kinks);
  std::vector<double> breaks;
  for (const Interval& stretch : lit) {
    const Interval within = intersection(stretch, {0.0, along.reach()});
    if (!(within.begin < within.end)) continue;
    breaks.assign({within.begin, within.end});
    const auto add = [&](const std::vector<double>& list) {
      for (const double t : list) {
        if (t > within.begin && t < within.end) breaks.push_back(t);
      }
    };
    add(along.borders());
    add(kinks);
    if (!medium.linear) add(along.marks());
    std::sort(breaks.begin(), breaks.end());
    if (!medium.linear) {
      sum += integrate_adaptively(breaks, infinity, tolerance, [&](double t) {
        Spectrum value;
        for (std::size_t i = 0; i < strength.size(); ++i) {
          const Stretch& s = along.stretches()[i];
          if (t >= s.range.begin && t <= s.range.end) value += strength[i] * s.factor_at(t);
        }
        if (!is_zero(value)) attenuate(value, depth_at(t));
        return value;
      });
      continue;
    }
    for (std::size_t k = 0; k + 1 < breaks.size(); ++k) {
      const double begin = breaks[k], span = breaks[k + 1] - begin;
      if (!(span > 0.0)) continue;
      // With w the column of medium since the piece's begin and a depth that is linear in w, E(w) = E0 + (E1 - E0) w/W,
      //   int strength e^-E dw = strength W (e^-E0 - e^-E1) / (E1 - E0).
      // E is taken inside the piece and continued to its ends, where it may jump.
      double rate = 0.0;
      Spectrum column;  // strength times W, added over species: all share the rate
      for (std::size_t i = 0; i < strength.size(); ++i) {
        const Stretch& s = along.stretches()[i];
        const double middle = begin + 0.5 * span;
        if (middle < s.range.begin || middle > s.range.end) continue;
        rate = s.rate;
        const double w = rate == 0.0 ? span : -std::expm1(-rate * span) / rate;
        column += strength[i] * (s.factor_at(begin) * w);
      }
      if (is_zero(column)) continue;
      const auto share = [&](double t) {  // w / W
        return rate == 0.0 ? t / span : std::expm1(-rate * t) / std::expm1(-rate * span);
      };
      const double t0 = 0.25 * span, t1 = 0.75 * span, w0 = share(t0), w1 = share(t1);
      const Spectrum e0 = depth_at(begin + t0), e1 = depth_at(begin + t1);
      for (std::size_t c = 0; c < channel_count; ++c) {
        if (!(column[c] > 0.0) || !(e0[c] < 1e6) || !(e1[c] < 1e6)) continue;
        const double slope = (e1[c] - e0[c]) / (w1 - w0);  // E1 - E0
        const double least = slope >= 0.0 ? e0[c] - slope * w0 : e1[c] + slope * (1.0 - w1);
        const double fall = std::fabs(slope);
        sum[c] += column[c] * std::exp(-least) * (fall > 1e-8 ? -std::expm1(-fall) / fall : 1.0 - 0.5 * fall);
      }
    }
  }
  return sum;
}

}  // namespace tyndall
