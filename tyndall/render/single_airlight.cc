#include "tyndall/render/single_airlight.h"

#include <algorithm>

#include "tyndall/light/airlight_adaptive.h"

namespace tyndall {

double SingleLamp::falloff(const Vector& away) const {
  switch (shape) {
    case Shape::spot:
      return spot_falloff(spot, dot(axis, away));
    case Shape::one_sided:
      return std::max(0.0, dot(axis, away));
    case Shape::point:
      break;
  }
  return 1.0;
}

namespace {

/// What the triangle between a piece of ray and a lamp is filled with, when that is the same everywhere.
struct Homogeneous {
  Spectrum extinction;
  std::vector<ScatteringLobe> lobes;
};

/// Fills `fill` for [begin, end], which has no border inside; false when the medium in the triangle varies.
bool homogeneous(const RayMedium& along, const Interval& range, const Vector& lamp, Homogeneous& fill) {
  const SingleMedium& medium = along.medium();
  if (!medium.shaped && !fill.lobes.empty()) return true;  // the same everywhere, and known
  fill.extinction = {};
  fill.lobes.clear();
  if (!medium.shaped) {
    for (const LoweredSpecies& s : medium.lowered.species) {
      if (s.decay != 0.0) return false;
      fill.extinction += s.extinction;
    }
    fill.lobes = medium.lobes;
    return true;
  }
  const Wedge piece = Wedge::toward_lamp(along.ray(), range, lamp);
  const double middle = range.end < infinity ? 0.5 * (range.begin + range.end) : infinity;
  const Ray& ray = along.ray();
  const double slope = ray.direction.y;
  const auto height = [&](double t) { return slope == 0.0 ? ray.origin.y : ray.origin.y + slope * t; };
  const auto [least, most] = std::minmax({height(range.begin), height(range.end), lamp.y});
  const auto missed_by_heights = [least = least, most = most](const HeightRange& h) {
    return most < h.low || least > h.high;
  };
  for (const LoweredSpecies& s : medium.lowered.species) {
    const auto holds_lamp = [&](const auto& shape) { return contains(shape, lamp); };
    const auto missed = [&](const auto& shape) { return piece.misses(shape); };
    if (std::any_of(s.boxes.begin(), s.boxes.end(), missed)) continue;
    if (std::any_of(s.spheres.begin(), s.spheres.end(), missed)) continue;
    if (s.heights.bounded() && missed_by_heights(s.heights)) continue;
    if (s.decay != 0.0 || !s.form.empty()) return false;
    const bool bounded = !s.boxes.empty() || !s.spheres.empty() || s.heights.bounded();
    if (bounded) {
      // Shapes are convex: piece and lamp inside means everything between them inside.
      const bool present = std::any_of(along.stretches().begin(), along.stretches().end(), [&](const Stretch& stretch) {
        return stretch.species == &s && stretch.range.begin < middle && middle < stretch.range.end;
      });
      if (!present || !holds_lamp(s.heights) || !std::all_of(s.boxes.begin(), s.boxes.end(), holds_lamp) ||
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
    return std::max(0.0, cosine);
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
    if (stretch.diverges) return around_lamp(part);
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
    // Twice the length still gives six digits and more.
    const double longest = tolerance_ >= 1e-7 ? 2.0 * airlight_panel : airlight_panel;
    return integrate_adaptively(breaks_, longest, tolerance_, [&](double x) {
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
    const Stretch* before = nullptr;
    double factor = 0.0;
    for (const Stretch& s : along_.stretches()) {
      if (t < s.range.begin || t > s.range.end) continue;
      if (before == nullptr || !s.like(*before)) factor = s.factor_at(t);
      before = &s;
      Spectrum part;
      for (const ScatteringLobe& lobe : along_.medium().lobes_of(*s.species)) {
        part += lobe.scattering * std::visit([&](const auto& l) { return l.density(d); }, lobe.lobe);
      }
      sum += part * factor;
    }
    return sum;
  }
  /// A lamp on the ray: infinite where there is anything around it to scatter its light, else what the stretches before
  /// and beyond the gap that it stands in scatter.
  Spectrum around_lamp(const BeamPart& part) {
    const std::vector<double>& borders = along_.borders();
    const double at = view_.place.along;
    const auto before = std::lower_bound(borders.begin(), borders.end(), at);
    const auto after = std::upper_bound(borders.begin(), borders.end(), at);
    const double begin = before == borders.begin() ? 0.0 : *(before - 1);
    const double end = after == borders.end() ? along_.reach() : *after;
    Spectrum sum;
    for (const Interval& piece : {Interval{begin, at}, Interval{at, end}}) {
      const Interval close = intersection(piece, part.stretch);
      if (!(close.begin < close.end)) continue;
      const double middle = close.end < infinity ? 0.5 * (close.begin + close.end) : close.begin + 1.0;
      Spectrum there = scattered(middle, Deflection<double>::from_mu(0.0));
      attenuate(there, optical_depth(along_.stretches(), at));
      sum += map(there, [](double x) { return x > 0.0 ? infinity : 0.0; });
    }
    if (!is_zero(sum)) return sum;
    for (const Interval& piece : {Interval{part.stretch.begin, begin}, Interval{end, part.stretch.end}}) {
      if (piece.begin < piece.end) sum += over({piece, part.full});
    }
    return sum;
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
      break;
  }
  const Interval part = intersection(lit, cone_stretch(view, lamp.axis, 90.0));
  if (part.begin < part.end) parts.push_back({part, false});
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
  const TableKnotPanels knots = tolerance < 1e-4 ? TableKnotPanels::split : TableKnotPanels::crossed;
  std::optional<LampIntegral> varying;
  for (const BeamPart& part : parts) {
    // Piece by piece between borders, as long as the medium is homogeneous around each.
    Spectrum piecewise;
    bool simple = true;
    double begin = part.stretch.begin;
    for (auto border = std::upper_bound(along.borders().begin(), along.borders().end(), begin); simple;) {
      const bool last = border == along.borders().end() || *border >= part.stretch.end;
      const double end = last ? part.stretch.end : *border++;
      simple = homogeneous(along, {begin, end}, position, fill);
      if (simple && !fill.lobes.empty()) {
        // Seen from the piece's begin; the rest of the way to the origin is transmittance.
        const LampAside place{view.place.along - begin, view.place.aside};
        const Interval stretch{0.0, end - begin};
        const Spectrum light =
            part.full ? airlight(fill.lobes, fill.extinction, place, stretch, knots)
                      : airlight_by_panels(fill.lobes, fill.extinction, AirlightStretch::of(place, stretch),
                                           LampFalloff(lamp, view, false), knots);
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

}  // namespace tyndall
