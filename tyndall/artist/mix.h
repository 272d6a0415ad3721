#pragma once
// Mixing two media: both present, each in its share.
#include <utility>

#include "tyndall/artist/blend.h"

namespace tyndall {
namespace blending {

/// Everything a medium is made of as stated species, except what its background contributes if `without_air`.
inline std::variant<std::vector<StatedSpecies>, Objection> as_species(const MediumDials& dials, bool without_air) {
  const auto compiled = compile(dials);
  if (const auto* objection = std::get_if<Objection>(&compiled)) return *objection;
  const std::vector<Species> air = without_air ? air_of(dials) : std::vector<Species>{};
  std::vector<StatedSpecies> out;
  const auto& all = std::get<Medium>(compiled).species;
  for (std::size_t i = air.size(); i < all.size(); ++i) {  // air comes first
    StatedSpecies s;
    s.name = all[i].name;
    s.scattering = all[i].scattering;
    s.absorption = all[i].absorption;
    s.phase = all[i].phase;
    if (!all[i].profiles.empty()) s.profile = all[i].profiles;
    out.push_back(std::move(s));
  }
  return out;
}

/// Both backgrounds aligned, if they differ in exaggeration only: then the dial can say what both are together.
inline bool one_air(std::optional<Background>& a, std::optional<Background>& b) {
  auto x = a, y = b;
  if (align(x, y) || !alike(x, y) || (x && !differ_in_exaggeration_only(*x, *y))) return false;
  a = std::move(x);
  b = std::move(y);
  return true;
}

}  // namespace blending

/// (1 - t) a + t b as media: every coefficient is the weighted sum, whatever the two are made of, t in [0, 1]. Mixing
/// commutes and associates. Dials in SI; exactly a at 0 and b at 1. Species equal in name, law and profile are joined;
/// the background stays a dial where both are of one kind. Objects only where a or b is no medium.
inline Blend mix(MediumDials a, MediumDials b, double t) {
  if (t == 0.0) return a;
  if (t == 1.0) return b;
  MediumDials from = a, to = b, out;
  out.channels = a.channels;
  const bool one_air = blending::one_air(a.background, b.background);
  if (one_air) out.background = between_dials(a.background, b.background, t);
  for (const auto& [dials, share] : {std::pair{&from, 1.0 - t}, std::pair{&to, t}}) {
    auto species = blending::as_species(*dials, one_air);
    if (const auto* objection = std::get_if<Objection>(&species)) return *objection;
    for (StatedSpecies& s : std::get<0>(species)) {
      *s.scattering *= share;
      *s.absorption *= share;
      bool joined = false;
      for (StatedSpecies& o : out.species) {
        if (joined || o.name != s.name || !same(o.phase, s.phase) || !same(o.profile, s.profile)) continue;
        *o.scattering += *s.scattering;
        *o.absorption += *s.absorption;
        joined = true;
      }
      if (!joined) out.species.push_back(std::move(s));
    }
  }
  return out;
}

}  // namespace tyndall
