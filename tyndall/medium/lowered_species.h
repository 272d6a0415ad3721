#pragma once
// Species as transport wants them.
#include <span>
#include <vector>

#include "tyndall/geometry/shape.h"
#include "tyndall/medium/form.h"
#include "tyndall/medium/medium.h"
#include "tyndall/phase/merged_lobes.h"

namespace tyndall {

/// A species for transport. Every product of profiles is exp(-decay (y - base)) times a form, inside the intersection
/// of its shapes.
struct LoweredSpecies {
  Spectrum scattering, absorption, extinction;  // [1/m] at the base height
  double decay = 0.0;                           // [1/m], 0 for constant density
  double base = 0.0;                            // [m]
  std::vector<Box> boxes;                       // at most one
  std::vector<Sphere> spheres;
  HeightRange heights;  // bounded only where there is no box, which else is cut by them
  Form form;
  std::size_t place = 0;                       // the number of the first species of the medium with the same profiles
  std::size_t first_lobe = 0, lobe_count = 0;  // in LoweredMedium::lobes

  /// Natural logarithm of the density factor at height y, shapes and form aside.
  double log_at_height(double y) const { return decay == 0.0 ? 0.0 : -decay * (y - base); }
  /// Whether it is everywhere, and as dense everywhere.
  bool is_constant() const {
    return decay == 0.0 && boxes.empty() && spheres.empty() && !heights.bounded() && form.empty();
  }
  /// Whether it changes along y only: a slab can be made of it.
  bool is_layered() const {
    return boxes.empty() && spheres.empty() && form.boxes.empty() && form.spheres.empty() && form.noises.empty() &&
           form.grids.empty();
  }
};

struct LoweredMedium {
  std::vector<LoweredSpecies> species;
  LobeSum<double> lobes;  // those of all species, each species' weights summing to 1
};

/// Puts profiles, for a time [s], into a species that has none yet; false when nothing is left of it because its shapes
/// do not meet.
inline bool place(LoweredSpecies& species, const std::vector<Profile>& profiles, double time) {
  struct Apply {
    LoweredSpecies& s;
    double time;
    void operator()(const ConstantProfile&) const {}
    void operator()(const ExponentialProfile& e) const {
      // A product of exponentials is one: exp(-(y - b1)/h1 - (y - b2)/h2) = exp(-d (y - (b1/h1 + b2/h2)/d)).
      const double rate = 1.0 / e.scale_height, both = s.decay + rate;
      s.base = (s.decay * s.base + rate * e.base) / both;
      s.decay = both;
    }
    void operator()(const LayerProfile& l) const {
      s.heights = {std::max(s.heights.low, l.bottom), std::min(s.heights.high, l.top)};
    }
    void operator()(const TentProfile& t) const {
      (*this)(LayerProfile{t.centre - t.half_width, t.centre + t.half_width});
      s.form.tents.push_back(t);
    }
    void operator()(const BoxProfile& b) const {
      s.boxes.push_back(b.shape());
      if (b.feather > 0.0) s.form.boxes.push_back(b);
    }
    void operator()(const SphereProfile& b) const {
      s.spheres.push_back(b.shape());
      if (b.feather > 0.0) s.form.spheres.push_back(b);
    }
    void operator()(const NoiseProfile& n) const {
      if (n.contrast > 0.0) {
        s.form.noises.push_back({{n.scale, n.octaves, n.contrast, n.seed}, n.wind * time});
      }
    }
    void operator()(const GridProfile& g) const {
      if (std::optional<PlacedGrid> grid = placed(g)) {
        s.boxes.push_back(grid->bounds);
        s.form.grids.push_back(std::move(*grid));
      } else {
        s.heights = {0.0, 0.0};  // nothing is left
      }
    }
  };
  for (const Profile& profile : profiles) std::visit(Apply{species, time}, profile);
  if (species.boxes.empty()) return species.heights.low < species.heights.high;
  Box all = species.boxes.front();
  for (const Box& box : species.boxes) {
    all.low = {std::max(all.low.x, box.low.x), std::max(all.low.y, box.low.y), std::max(all.low.z, box.low.z)};
    all.high = {std::min(all.high.x, box.high.x), std::min(all.high.y, box.high.y), std::min(all.high.z, box.high.z)};
  }
  all.low.y = std::max(all.low.y, species.heights.low);
  all.high.y = std::min(all.high.y, species.heights.high);
  species.boxes.assign(1, all);
  species.heights = {};
  return all.low.x < all.high.x && all.low.y < all.high.y && all.low.z < all.high.z;
}

/// What a species does in one channel; nothing in the others.
inline LoweredSpecies in_channel(LoweredSpecies species, std::size_t channel) {
  for (Spectrum* coefficient : {&species.scattering, &species.absorption, &species.extinction}) {
    const double here = (*coefficient)[channel];
    *coefficient = {};
    (*coefficient)[channel] = here;
  }
  return species;
}

/// Adds a species with the lobes of its law, which is the same in all its channels.
inline void put(LoweredMedium& lowered, LoweredSpecies species, const Law<double>& law) {
  species.first_lobe = lowered.lobes.size();
  for (auto& lobe : merged(lower(law))) lowered.lobes.push_back(std::move(lobe));
  species.lobe_count = lowered.lobes.size() - species.first_lobe;
  lowered.species.push_back(std::move(species));
}

/// Adds the species of `medium`, as they are at a time [s], to `lowered`: overlap is addition. A species whose law
/// differs by channel becomes one for each channel, alone in it: what follows knows of laws that are the same in all
/// channels only, and mixtures, weights and densities per channel come out right.
inline void add(LoweredMedium& lowered, const Medium& medium, double time = 0.0) {
  const Species* before = nullptr;
  for (const Species& from : medium.species) {
    if (is_zero(from.extinction())) continue;
    LoweredSpecies s;
    s.scattering = from.scattering;
    s.absorption = from.absorption;
    s.extinction = from.extinction();
    if (!place(s, from.profiles, time)) continue;
    // Only neighbours are compared: the species of one conditions come together.
    const bool same = before != nullptr && before->profiles == from.profiles;
    s.place = same ? lowered.species.back().place : lowered.species.size();
    before = &from;
    if (!is_chromatic(from.phase)) {
      put(lowered, std::move(s), from.phase);
      continue;
    }
    for (std::size_t c = 0; c < channel_count; ++c) {
      if (s.extinction[c] > 0.0) put(lowered, in_channel(s, c), in_channel(from.phase, c));
    }
  }
}

inline LoweredMedium lower(const Medium& medium, double time = 0.0) {
  LoweredMedium lowered;
  add(lowered, medium, time);
  return lowered;
}

}  // namespace tyndall
