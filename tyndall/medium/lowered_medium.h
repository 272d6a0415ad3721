#pragma once
// A medium made ready for transport: species as plain constants, and what a ray meets of them. Nothing allocates after
// lowering but the reusable list of stretches.
#include <vector>

#include "tyndall/medium/lowered_species.h"
#include "tyndall/medium/stretch.h"

namespace tyndall {

/// Calls visit(span of the species of one place) for every place of a medium, in its order.
template <class Visit>
void for_each_place(const LoweredMedium& medium, Visit visit) {
  const std::vector<LoweredSpecies>& species = medium.species;
  for (std::size_t first = 0, last; first < species.size(); first = last) {
    for (last = first + 1; last < species.size() && species[last].place == species[first].place;) ++last;
    visit(std::span<const LoweredSpecies>(&species[first], last - first));
  }
}

/// The part of a ray within [0, end] on which a species may be.
inline Interval range_of(const LoweredSpecies& s, const Ray& ray, double end) {
  Interval range{0.0, end};
  for (const Box& box : s.boxes) range = intersection(range, inside(box, ray));
  for (const Sphere& sphere : s.spheres) range = intersection(range, inside(sphere, ray));
  if (s.heights.bounded()) range = intersection(range, inside(s.heights, ray));
  return range;
}

/// Appends the stretches of the species of one place; arguments and result are those of stretches_along.
inline double add_stretches(std::span<const LoweredSpecies> together, const Ray& ray, double end,
                            std::vector<Stretch>& out, double enough) {
  const LoweredSpecies& s = together.front();
  const Interval range = range_of(s, ray, end);
  if (range.empty()) return end;
  if (!s.form.empty()) return std::min(end, add_formed_stretches(together, ray, range, out, enough));
  const double rate = s.decay * ray.direction.y;
  const double start = s.log_at_height(ray.origin.y + range.begin * ray.direction.y), factor = std::exp(start);
  if (!(factor > 0.0 || rate < 0.0)) return end;
  for (const LoweredSpecies& one : together) out.push_back(Stretch(one, range, factor, rate, start));
  return end;
}

/// The stretches of `medium` along a ray within [0, end]: none of its species overlap themselves, those of one place
/// come together. What they hold is exact but for rounding; media with noise see form.h for what is left out far away.
/// Whoever needs no more than an optical depth of `enough` in every channel gets the distance up to which the stretches
/// hold all there is: `end`, or less where the depth there exceeds it.
inline double stretches_along(const LoweredMedium& medium, const Ray& ray, double end, std::vector<Stretch>& out,
                              double enough = infinity) {
  out.clear();
  double reach = end;
  for_each_place(medium, [&](std::span<const LoweredSpecies> together) {
    reach = std::min(reach, add_stretches(together, ray, end, out, enough));
  });
  return reach;
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
