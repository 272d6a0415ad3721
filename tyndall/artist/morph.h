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
}

/// Density at the origin, where media are compared; a species that is elsewhere counts by its stated density.
inline double weight_at_origin(const std::optional<Profile>& profile) {
  const double here = profile ? mean_factor(*profile, Vector{}) : 1.0;
  return here > 0.0 && std::isfinite(here) ? here : 1.0;
}

inline Spectrum extinction_of(const StatedSpecies& s) { return *s.scattering + *s.absorption; }

inline Spectrum total_of(const std::vector<StatedSpecies>& species) {
  Spectrum total;
  for (const StatedSpecies& s : species) total += weight_at_origin(s.profile) * extinction_of(s);
  return total;
}

inline Spectrum total_of(const std::optional<Background>& background) {
  std::vector<Species> air;
  if (background) compile(*background, air);
  return air.empty() ? Spectrum{} : weight_at_origin(background->profile) * air.front().extinction();
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
/// shares that species have in it, their laws' parameters and their profiles go straight from a's to b's. Air of one
/// kind and profile stays background, its exaggeration morphed like an extinction. Where a channel is clear at one end,
/// which has no logarithm, its coefficients go straight. Dials in SI; exactly a at 0 and b at 1.
inline Blend morph(MediumDials a, MediumDials b, double t) {
  if (t == 0.0) return a;
  if (t == 1.0) return b;
  blending::order_lobes(a.conditions);
  blending::order_lobes(b.conditions);
  const Spectrum air_a = blending::total_of(a.background), air_b = blending::total_of(b.background);
  const bool one_air = !is_zero(air_a) && !is_zero(air_b) && a.background->air == b.background->air &&
                       same(a.background->profile, b.background->profile);
  auto from = blending::as_species(a, one_air), to = blending::as_species(b, one_air);
  for (const auto* side : {&from, &to}) {
    if (const auto* objection = std::get_if<Objection>(side)) return *objection;
  }
  auto &left = std::get<0>(from), &right = std::get<0>(to);
  blending::pair_up(left, right);
  const Spectrum rest_a = blending::total_of(left), rest_b = blending::total_of(right);

  MediumDials out;
  Spectrum air;
  if (one_air) {
    out.background = between_dials(a.background, b.background, t);
    out.background->exaggeration =
        blending::between_logarithms(a.background->exaggeration, b.background->exaggeration, t);
    air = blending::total_of(out.background);
  }
  for (std::size_t i = 0; i < left.size(); ++i) {
    StatedSpecies s = left[i];
    s.phase = between_dials(left[i].phase, right[i].phase, t);
    s.profile = between_dials(left[i].profile, right[i].profile, t);
    for (std::size_t c = 0; c < channel_count; ++c) {
      const bool shares = rest_a[c] > 0.0 && rest_b[c] > 0.0;
      const double by_a = shares ? rest_a[c] : 1.0, by_b = shares ? rest_b[c] : 1.0;
      (*s.scattering)[c] = between((*left[i].scattering)[c] / by_a, (*right[i].scattering)[c] / by_b, t);
      (*s.absorption)[c] = between((*left[i].absorption)[c] / by_a, (*right[i].absorption)[c] / by_b, t);
    }
    out.species.push_back(std::move(s));
  }
  // Bring the sum to where the logarithm puts it. With air that is morphed by itself the rest is never negative: a
  // sum of geometric means is at most the geometric mean of the sums (Hoelder).
  const Spectrum composed = blending::total_of(out.species);
  const Spectrum whole_a = rest_a + (one_air ? air_a : Spectrum{}), whole_b = rest_b + (one_air ? air_b : Spectrum{});
  for (std::size_t c = 0; c < channel_count; ++c) {
    if (!(whole_a[c] > 0.0) || !(whole_b[c] > 0.0) || !(composed[c] > 0.0)) continue;
    const double target = std::max(0.0, blending::between_logarithms(whole_a[c], whole_b[c], t) - air[c]);
    for (StatedSpecies& s : out.species) {
      (*s.scattering)[c] *= target / composed[c];
      (*s.absorption)[c] *= target / composed[c];
    }
  }
  return out;
}

}  // namespace tyndall
