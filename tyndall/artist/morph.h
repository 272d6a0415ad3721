#pragma once
// Morphing one medium into another: thickness changes by equal factors in equal times, as the eye judges it.
#include <algorithm>
#include <cmath>
#include <utility>

#include "tyndall/artist/mix.h"

namespace tyndall {
namespace blending {

/// a^(1 - t) b^t for a, b > 0; straight between them where one is 0, which has no logarithm.
inline double between_logarithms(double a, double b, double t) {
  return a > 0.0 && b > 0.0 ? std::exp(between(std::log(a), std::log(b), t)) : between(a, b, t);
}

/// The lobe that points further forward comes first, so that lobes correspond.
inline void order_lobes(std::optional<Conditions>& conditions) {
  if (!conditions) return;
  if (auto* lobes = std::get_if<TwoLobes>(&*conditions); lobes != nullptr && lobes->g1 < lobes->g2) {
    std::swap(lobes->g1, lobes->g2);
    lobes->r = 1.0 - lobes->r;
  }
  if (auto* lobes = std::get_if<TwoLobesExplicit>(&*conditions); lobes != nullptr && lobes->first.g < lobes->second.g) {
    std::swap(lobes->first, lobes->second);
  }
}

/// Density at the origin, where media are compared; a species that is elsewhere counts by its stated density.
inline double weight_at_origin(const std::optional<Profiles>& profile) {
  const double here = profile ? mean_factor(*profile, Vector{}) : 1.0;
  return here > 0.0 && std::isfinite(here) ? here : 1.0;
}

/// Whether a profile has nothing at the origin.
inline bool is_elsewhere(const std::optional<Profiles>& profile) {
  return profile && !(mean_factor(*profile, Vector{}) > 0.0);
}

inline Spectrum extinction_of(const StatedSpecies& s) { return *s.scattering + *s.absorption; }

/// Extinction at the origin of those species that `counts` names by their index.
template <class Counts>
Spectrum total_of(const std::vector<StatedSpecies>& species, const Counts& counts) {
  Spectrum total;
  for (std::size_t i = 0; i < species.size(); ++i) {
    if (counts(i)) total += weight_at_origin(species[i].profile) * extinction_of(species[i]);
  }
  return total;
}

inline Spectrum air_at_origin(const MediumDials& dials) {
  Spectrum total;
  for (const Species& s : air_of(dials)) total += mean_factor(s, Vector{}) * s.extinction();
  return total;
}

/// Pairs what corresponds (name, kind of law and of profile); what does not gets an empty partner.
inline void pair_up(std::vector<StatedSpecies>& a, std::vector<StatedSpecies>& b) {
  const auto emptied = [](StatedSpecies s) {
    s.scattering = s.absorption = Spectrum{};
    return s;
  };
  std::vector<StatedSpecies> left, right;
  for (const StatedSpecies& s : a) {
    const auto partner = std::find_if(b.begin(), b.end(), [&](const StatedSpecies& o) {
      return o.name == s.name && alike(o.phase, s.phase) && alike(o.profile, s.profile);
    });
    left.push_back(s);
    right.push_back(partner != b.end() ? *partner : emptied(s));
    if (partner != b.end()) b.erase(partner);
  }
  for (const StatedSpecies& s : b) {
    left.push_back(emptied(s));
    right.push_back(s);
  }
  a = std::move(left);
  b = std::move(right);
}

}  // namespace blending

/// At t in [0, 1] between a and b: the logarithm of the extinction at the origin is linear in t in every channel, the
/// shares that species have in it, their laws' parameters and their profiles go straight from a's to b's. What is not
/// at the origin (an ozone layer, a ball of smoke) is morphed so by itself. Air of one kind stays background, its
/// exaggeration morphed like an extinction. Where a channel is clear at one end, which has no logarithm, its
/// coefficients go straight. Dials in SI; exactly a at 0 and b at 1.
inline Blend morph(MediumDials a, MediumDials b, double t) {
  if (t == 0.0) return a;
  if (t == 1.0) return b;
  blending::order_lobes(a.conditions);
  blending::order_lobes(b.conditions);
  const Spectrum air_a = blending::air_at_origin(a), air_b = blending::air_at_origin(b);
  const bool one_air = !is_zero(air_a) && !is_zero(air_b) && differ_in_exaggeration_only(*a.background, *b.background);
  auto from = blending::as_species(a, one_air), to = blending::as_species(b, one_air);
  for (const auto* side : {&from, &to}) {
    if (const auto* objection = std::get_if<Objection>(side)) return *objection;
  }
  auto &left = std::get<0>(from), &right = std::get<0>(to);
  blending::pair_up(left, right);

  MediumDials out;
  out.channels = a.channels;
  Spectrum air;
  if (one_air) {
    out.background = a.background;
    out.background->exaggeration =
        blending::between_logarithms(a.background->exaggeration, b.background->exaggeration, t);
    air = blending::air_at_origin(out);
  }
  out.species = left;
  for (const bool elsewhere : {false, true}) {
    const auto counts = [&](std::size_t i) {
      return elsewhere == (blending::is_elsewhere(left[i].profile) && blending::is_elsewhere(right[i].profile));
    };
    const Spectrum rest_a = blending::total_of(left, counts), rest_b = blending::total_of(right, counts);
    for (std::size_t i = 0; i < left.size(); ++i) {
      if (!counts(i)) continue;
      StatedSpecies& s = out.species[i];
      s.phase = between_dials(left[i].phase, right[i].phase, t);
      s.profile = between_dials(left[i].profile, right[i].profile, t);
      for (std::size_t c = 0; c < channel_count; ++c) {
        const bool shares = rest_a[c] > 0.0 && rest_b[c] > 0.0;
        const double by_a = shares ? rest_a[c] : 1.0, by_b = shares ? rest_b[c] : 1.0;
        (*s.scattering)[c] = between((*left[i].scattering)[c] / by_a, (*right[i].scattering)[c] / by_b, t);
        (*s.absorption)[c] = between((*left[i].absorption)[c] / by_a, (*right[i].absorption)[c] / by_b, t);
      }
    }
    // Bring the sum to where the logarithm puts it. With air that is morphed by itself the rest is never negative: a
    // sum of geometric means is at most the geometric mean of the sums (Hoelder).
    const Spectrum composed = blending::total_of(out.species, counts);
    const bool with_air = one_air && !elsewhere;
    const Spectrum whole_a = rest_a + (with_air ? air_a : Spectrum{}),
                   whole_b = rest_b + (with_air ? air_b : Spectrum{});
    for (std::size_t c = 0; c < channel_count; ++c) {
      if (!(whole_a[c] > 0.0) || !(whole_b[c] > 0.0) || !(composed[c] > 0.0)) continue;
      const double whole = blending::between_logarithms(whole_a[c], whole_b[c], t);
      const double target = std::max(0.0, whole - (with_air ? air[c] : 0.0));
      for (std::size_t i = 0; i < left.size(); ++i) {
        if (!counts(i)) continue;
        (*out.species[i].scattering)[c] *= target / composed[c];
        (*out.species[i].absorption)[c] *= target / composed[c];
      }
    }
  }
  return out;
}

}  // namespace tyndall
