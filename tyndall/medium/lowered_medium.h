#pragma once
// A medium made ready for transport: species as plain constants, and what a ray meets of them. Nothing allocates after
// lowering but the reusable list of stretches.
#include <vector>

#include "tyndall/geometry/shape.h"
#include "tyndall/medium/medium.h"
#include "tyndall/phase/merged_lobes.h"

namespace tyndall {

/// A species for transport. Every product of constant, exponential, box and sphere profiles is exp(-decay (y - base))
/// inside the intersection of its shapes, so that optical depth has a closed form.
struct LoweredSpecies {
  Spectrum scattering, absorption, extinction;  // [1/m] at the base height
  double decay = 0.0;                           // [1/m], 0 for constant density
  double base = 0.0;                            // [m]
  std::vector<Box> boxes;
  std::vector<Sphere> spheres;
  double low = -infinity, high = infinity;     // heights between which it is [m]
  std::vector<Profile> formed;                 // profiles whose density varies inside these bounds, exponentials aside
  std::size_t first_lobe = 0, lobe_count = 0;  // in LoweredMedium::lobes

  /// Natural logarithm of the density factor at height y, shapes aside.
  double log_at_height(double y) const { return decay == 0.0 ? 0.0 : -decay * (y - base); }
};

struct LoweredMedium {
  std::vector<LoweredSpecies> species;
  LobeSum<double> lobes;  // those of all species, each species' weights summing to 1
};

/// Adds the species of `medium` to `lowered`: overlap is addition.
inline void add(LoweredMedium& lowered, const Medium& medium) {
  struct Apply {
    LoweredSpecies& s;
    void operator()(const ConstantProfile&) const {}
    void operator()(const ExponentialProfile& e) const {
      // A product of exponentials is one: exp(-(y - b1)/h1 - (y - b2)/h2) = exp(-d (y - (b1/h1 + b2/h2)/d)).
      const double rate = 1.0 / e.scale_height, both = s.decay + rate;
      s.base = (s.decay * s.base + rate * e.base) / both;
      s.decay = both;
    }
    void operator()(const LayerProfile& l) const {
      s.low = std::max(s.low, l.bottom);
      s.high = std::min(s.high, l.top);
    }
    void operator()(const TentProfile& t) const {
      (*this)(LayerProfile{t.centre - t.half_width, t.centre + t.half_width});
      s.formed.push_back(t);
    }
    void operator()(const BoxProfile& b) const {
      s.boxes.push_back(b.shape());
      if (b.feather > 0.0) s.formed.push_back(b);
    }
    void operator()(const SphereProfile& b) const {
      s.spheres.push_back(b.shape());
      if (b.feather > 0.0) s.formed.push_back(b);
    }
    void operator()(const NoiseProfile& n) const {
      if (n.contrast > 0.0) s.formed.push_back(n);
    }
  };
  for (const Species& from : medium.species) {
    if (is_zero(from.extinction())) continue;
    LoweredSpecies s;
    s.scattering = from.scattering;
    s.absorption = from.absorption;
    s.extinction = from.extinction();
    s.first_lobe = lowered.lobes.size();
    for (const Profile& profile : from.profiles) std::visit(Apply{s}, profile);
    for (auto& lobe : merged(lower(from.phase))) lowered.lobes.push_back(lobe);
    s.lobe_count = lowered.lobes.size() - s.first_lobe;
    lowered.species.push_back(std::move(s));
  }
}

inline LoweredMedium lower(const Medium& medium) {
  LoweredMedium lowered;
  add(lowered, medium);
  return lowered;
}

/// The part of a ray on which one species is present, and its density there: factor exp(-rate (t - range.begin)).
struct Stretch {
  const LoweredSpecies* species;
  Interval range;
  double factor;      // at range.begin; may underflow to 0 high above an air that the ray descends into
  double rate;        // [1/m] along the ray; negative when the ray descends into thicker air
  double log_factor;  // what factor is the exponential of

  /// Whether the other is as dense everywhere: species of one conditions share a profile, whose exponentials need be
  /// computed only once.
  bool like(const Stretch& other) const {
    return rate == other.rate && log_factor == other.log_factor && range.begin == other.range.begin &&
           range.end == other.range.end;
  }

  /// Density factor at t inside the range.
  double factor_at(double t) const { return rate == 0.0 ? factor : std::exp(log_factor - rate * (t - range.begin)); }

  /// Length [m] of unit-density species between range.begin and t, clamped to the range: the factor at the thicker end
  /// times (1 - e^-|rate s|)/|rate|, by expm1 without cancellation; 0 <= result, infinite for an unbounded stretch of
  /// constant density.
  double depth_to(double t) const {
    const double s = std::min(t, range.end) - range.begin;
    if (!(s > 0.0)) return 0.0;
    if (rate == 0.0) return factor * s;
    if (rate > 0.0) return -factor * std::expm1(-rate * s) / rate;
    return std::exp(log_factor - rate * s) * std::expm1(rate * s) / rate;
  }

  /// The t at which depth_to(t) = depth >= 0; infinity where the stretch holds less.
  double distance_at(double depth) const {
    double s;
    if (rate == 0.0) {
      s = depth / factor;
    } else if (rate > 0.0) {
      const double x = depth * rate / factor;
      if (x >= 1.0) return infinity;
      s = -std::log1p(-x) / rate;
    } else if (log_factor > -700.0) {
      s = std::log1p(-depth * rate / factor) / -rate;
    } else {
      s = depth > 0.0 ? (std::log(-depth * rate) - log_factor) / -rate : 0.0;
    }
    const double t = range.begin + s;
    return t < range.end ? t : infinity;
  }
};

/// The stretches of `medium` along a ray within [0, end].
inline void stretches_along(const LoweredMedium& medium, const Ray& ray, double end, std::vector<Stretch>& out) {
  out.clear();
  for (const LoweredSpecies& s : medium.species) {
    Interval range{0.0, end};
    for (const Box& box : s.boxes) range = intersection(range, inside(box, ray));
    for (const Sphere& sphere : s.spheres) range = intersection(range, inside(sphere, ray));
    if (range.empty()) continue;
    const double rate = s.decay * ray.direction.y;
    const double start = s.log_at_height(ray.origin.y + range.begin * ray.direction.y), factor = std::exp(start);
    if (factor > 0.0 || rate < 0.0) out.push_back({&s, range, factor, rate, start});
  }
}

/// Optical depth per channel from the ray's origin to t.
inline Spectrum optical_depth(const std::vector<Stretch>& stretches, double t) {
  Spectrum depth;
  const Stretch* before = nullptr;
  double length = 0.0;
  for (const Stretch& s : stretches) {
    if (before == nullptr || !s.like(*before)) length = s.depth_to(t);
    before = &s;
    for (std::size_t c = 0; c < channel_count; ++c) {
      // 0 * infinity: a species without extinction in this channel stays transparent over any length.
      if (s.species->extinction[c] > 0.0) depth[c] += s.species->extinction[c] * length;
    }
  }
  return depth;
}

inline Spectrum transmittance(const std::vector<Stretch>& stretches, double t) {
  return map(optical_depth(stretches, t), [](double x) { return std::exp(-x); });
}

/// Transmittance of the medium between two points (exactly 1 where they coincide).
inline Spectrum transmittance(const LoweredMedium& medium, const Ray& ray, double end, std::vector<Stretch>& scratch) {
  stretches_along(medium, ray, end, scratch);
  return transmittance(scratch, end);
}

/// Extinction per channel at t [1/m].
inline Spectrum extinction_at(const std::vector<Stretch>& stretches, double t) {
  Spectrum total;
  const Stretch* before = nullptr;
  double factor = 0.0;
  for (const Stretch& s : stretches) {
    if (t < s.range.begin || t >= s.range.end) continue;
    if (before == nullptr || !s.like(*before)) factor = s.factor_at(t);
    before = &s;
    total += s.species->extinction * factor;
  }
  return total;
}

}  // namespace tyndall
