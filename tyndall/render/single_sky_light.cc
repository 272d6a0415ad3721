// What the smooth part of the surroundings gives to a surface point and to a ray.
#include <algorithm>
#include <numbers>

#include "tyndall/medium/free_flight.h"
#include "tyndall/render/single_ray.h"

namespace tyndall {
namespace {

double fraction(double x) { return x - std::floor(x); }

/// Point k of n spread evenly over the unit square (Fibonacci lattice with the golden ratio for any n).
struct FibonacciPoint {
  double x, y;
};
FibonacciPoint fibonacci(int k, int n) {
  const double turns = k * 0.61803398874989484820;
  return {(k + 0.5) / n, turns - std::floor(turns)};
}

/// Where little of the sky is seen (indoors, through windows), up to this many times as many directions.
constexpr double most_more = 8.0;

/// sum(count, seen) with `count` directions, and with more of them when surfaces hide more than three quarters.
template <class Sum>
Spectrum more_if_hidden(int count, const Sum& sum) {
  SkySeen seen;
  const Spectrum first = sum(count, seen);
  if (!(seen.asked > 0.0) || seen.open > 0.25 * seen.asked) return first;
  const double more = std::min(most_more, 0.5 * seen.asked / std::max(seen.open, 1e-3));
  return sum(static_cast<int>(std::lround(more * count)), seen);
}

}  // namespace

/// By directions that the surface favours: so many of its glossy, so many of its diffuse lobe, each on a Fibonacci
/// lattice, weighted by the density of both together.
Spectrum SingleRay::reflected_sky(const SurfacePoint& surface, const Vector& start, const Vector& out) {
  const double out_cosine = dot(surface.frame.normal, out);
  if (context_.sky.empty() || context_.settings.surface_directions < 1 || !(out_cosine > 0.0)) return {};
  const double chance = glossy_chance(surface, out_cosine);
  return more_if_hidden(context_.settings.surface_directions, [&](int count, SkySeen& seen) {
    const int glossy = static_cast<int>(std::lround(chance * count));
    Spectrum sum;
    for (int k = 0; k < count; ++k) {
      const bool is_glossy = k < glossy;
      const FibonacciPoint at = is_glossy ? fibonacci(k, glossy) : fibonacci(k - glossy, count - glossy);
      const Vector in = sample_direction(surface, out, is_glossy ? 0.0 : 1.0, at.x, at.y);
      const double diffuse = std::max(0.0, dot(surface.frame.normal, in)) / std::numbers::pi;
      const double facets = (direction_density(surface, out, in) - (1.0 - chance) * diffuse) / chance;
      const double density = glossy * std::max(0.0, facets) + (count - glossy) * diffuse;
      if (!(density > 0.0)) continue;
      const Spectrum light = context_.sky.smooth(in) * evaluate(surface, out, in) / density;
      if (is_zero(light)) continue;
      const Spectrum arrives = open_way({start, in});
      ++seen.asked;
      if (!is_zero(arrives)) ++seen.open;
      sum += light * arrives;
    }
    return sum;
  });
}

/// Places along the ray where equal shares of its light (one channel's) are scattered or lost.
void SingleRay::set_stations() {
  constexpr int count = 64;
  stations_.clear();
  const std::vector<Stretch>& stretches = medium_.stretches();
  const Spectrum depth = optical_depth(stretches, medium_.reach());
  const std::size_t channel =
      depth[1] > 0.0 ? 1 : static_cast<std::size_t>(std::max_element(&depth[0], &depth[0] + channel_count) - &depth[0]);
  const double spent = -std::expm1(-depth[channel]);
  for (int k = 0; k < count; ++k) {
    const double fall = -std::log1p(-spent * (k + 0.5) / count);
    const double t = distance_at_depth(stretches, channel, fall, medium_.reach());
    if (!(t < medium_.reach())) continue;
    Spectrum scattering;
    for (const Stretch& s : stretches) {
      if (t >= s.range.begin && t < s.range.end) scattering += s.species->scattering * s.factor_at(t);
    }
    const double density = extinction_at(stretches, t)[channel] * std::exp(-fall);
    if (!(density > 0.0)) continue;
    attenuate(scattering, optical_depth(stretches, t));
    stations_.push_back({ray_.at(t), scattering / density});
  }
}

/// How much of the light from a direction that the ray would scatter is not hidden by surfaces, judged at a few of the
/// stations, which take turns.
Spectrum SingleRay::open_share(const Vector& toward, int turn) {
  if (context_.shadows.empty() || stations_.empty()) return Spectrum::grey(1.0);
  const std::size_t stride =
      std::max<std::size_t>(1, stations_.size() / static_cast<std::size_t>(std::max(1, context_.settings.sky_shadows)));
  Spectrum open, all;
  for (std::size_t k = static_cast<std::size_t>(fraction(turn * 0.75487766624669276) * static_cast<double>(stride));
       k < stations_.size(); k += stride) {
    Spectrum light = stations_[k].light;
    stretches_along(context_.medium.lowered, {stations_[k].point, toward}, infinity, scratch_);
    attenuate(light, optical_depth(scratch_, infinity));
    all += light;
    if (!is_zero(light) && !context_.geometry.occluded(Ray{stations_[k].point, toward})) open += light;
  }
  for (std::size_t c = 0; c < channel_count; ++c) open[c] = all[c] > 0.0 ? open[c] / all[c] : 0.0;
  return open;
}

/// What each distinct lobe has in the scattering along the ray; returns the sum.
double SingleRay::set_shares() {
  const SingleMedium& medium = context_.medium;
  shares_.assign(medium.kinds.size(), 0.0);
  double whole = 0.0;
  for (const Stretch& s : medium_.stretches()) {
    const double column = s.depth_to(medium_.reach());
    for (std::size_t i = s.species->first_lobe; i < s.species->first_lobe + s.species->lobe_count; ++i) {
      const double scattered = mean(medium.lobes[i].scattering) * column;
      shares_[medium.kind[i]] += scattered;
      whole += scattered;
    }
  }
  return whole;
}

/// The smooth sky: so many directions for each of the medium's lobes as it has a share in the scattering along the ray,
/// spread evenly in its own cumulative distribution, so that the sharpest lobe asks for no more of them than the
/// broadest; weighted by the density of all together. Each is a sun, its shadows taken at a few places.
Spectrum SingleRay::from_sky() {
  if (medium_.empty() || context_.sky.empty() || context_.settings.sky_directions < 1) return {};
  const double whole = set_shares();
  if (!(whole > 0.0)) return {};
  if (!context_.shadows.empty()) set_stations();
  const std::vector<double> shares = shares_;
  return more_if_hidden(context_.settings.sky_directions,
                        [&](int count, SkySeen& seen) { return scattered_sky(shares, whole, count, seen); });
}

Spectrum SingleRay::scattered_sky(const std::vector<double>& shares, double whole, int count, SkySeen& seen) {
  // At least four each: none may be found by another's directions alone.
  shares_ = shares;
  for (double& share : shares_) share = share > 0.0 ? std::max(4.0, std::round(count * share / whole)) : 0.0;
  const double tolerance = std::max(coarse_tolerance, context_.settings.tolerance);
  const Frame frame = Frame::around(ray_.direction);
  Spectrum sum;
  int turn = 0;
  for (std::size_t kind = 0; kind < shares_.size(); ++kind) {
    const int directions = static_cast<int>(shares_[kind]);
    for (int k = 0; k < directions; ++k) {
      const double height = fibonacci(k, directions).x, angle = 2.0 * std::numbers::pi * fibonacci(turn++, 1).y;
      const Deflection<double> d =
          std::visit([&](const auto& lobe) { return lobe.sample(height); }, context_.medium.kinds[kind]);
      double density = 0.0;
      for (std::size_t other = 0; other < shares_.size(); ++other) {
        if (shares_[other] == 0.0) continue;
        density +=
            shares_[other] * std::visit([&](const auto& l) { return l.density(d); }, context_.medium.kinds[other]);
      }
      // Undeflected light comes from straight ahead.
      const double sine = d.sine();
      const Vector toward = normalized(frame.to_world({sine * std::cos(angle), sine * std::sin(angle), d.mu}));
      const Spectrum light = context_.sky.smooth(toward);
      if (is_zero(light)) continue;
      const Spectrum open = open_share(toward, turn);
      seen.open += mean(open);
      ++seen.asked;
      if (is_zero(open)) continue;
      lit_.assign(1, {0.0, medium_.reach()});
      sum += light * open / density * sun_airlight(medium_, toward, lit_, tolerance);
    }
  }
  return sum;
}

}  // namespace tyndall
