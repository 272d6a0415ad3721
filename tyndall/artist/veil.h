#pragma once
// The veil: the note's isotropic term for dust and smoke. (Real dust scatters forward: mean cosine near 0.7.)
#include <string>
#include <tuple>
#include <vector>

#include "tyndall/artist/remark.h"
#include "tyndall/artist/standard_air.h"
#include "tyndall/artist/stated_species.h"
#include "tyndall/artist/surroundings.h"

namespace tyndall {

struct Veil {
  static constexpr std::string_view text = "An even veil that scatters alike in all directions.";
  Density density = PlainExtinction{};
  Spectrum albedo = Spectrum::grey(1.0);
  static constexpr auto fields() {
    return std::tuple{
        Field{"density", &Veil::density, any_number, "", "How dense the veil is.", Scaling::none, true},
        Field{"albedo", &Veil::albedo, unit_interval, "1", "Share of what it takes from a beam that is scattered."}};
  }
};

template <class Out>
void compile(const std::optional<Veil>& veil, const std::optional<Profiles>& profile, Out& out) {
  if (veil)
    add_species_of(out, "veil", extinction_of(veil->density), veil->albedo, Isotropic<double>{}, factors_of(profile));
}

/// A remark where a thickness is stated by a visibility that even clear air does not have, in green. In SI.
inline void remark_on_thickness(const Density& thickness, const std::string& field, const Remarks& remarks) {
  const auto* stated = std::get_if<Visibility>(&thickness);
  if (stated == nullptr) return;
  const double metres = stated->visibility[visibility_channel], farthest = farthest_visibility(stated->contrast);
  if (metres > farthest) {
    remarks.add(field + "/visibility", "a visibility of " + short_number(metres) + " m",
                "at most " + short_number(farthest) + " m, through air alone at sea level");
  }
}

}  // namespace tyndall
