#pragma once
// The note's simple approach: one dial w from clear over hazy to murky, a thickness, and a veil.
#include <array>
#include <cmath>
#include <optional>
#include <string_view>
#include <tuple>
#include <vector>

#include "tyndall/artist/remark.h"
#include "tyndall/artist/surroundings.h"
#include "tyndall/artist/veil.h"

namespace tyndall {

/// What is kept while w moves.
enum class Hold { visibility };
constexpr std::array<std::string_view, 1> words_of(Hold) { return {"visibility"}; }

/// Mie extinction is k_hazy(w) thickness + k_murky(w) thickness. The k's sum to min(1, 2 w), so that below w = 0.5 the
/// dial also thins the air, unless visibility is held.
struct Simple {
  static constexpr std::string_view name = "simple";
  static constexpr std::string_view text = "Haze to murk on one dial, with an even veil.";
  double w = 0.5;
  Density thickness = PlainExtinction{};
  Spectrum albedo = Spectrum::grey(1.0);
  std::optional<Veil> veil;
  std::optional<Profiles> profile;
  std::optional<Hold> hold;
  static constexpr auto fields() {
    return std::tuple{Field{"w", &Simple::w, unit_interval, "1", "0 nothing, 0.5 hazy, 1 murky.", Scaling::none, true},
                      Field{"thickness", &Simple::thickness, any_number, "",
                            "Extinction of the haze and murk at full strength.", Scaling::none, true},
                      Field{"albedo", &Simple::albedo, unit_interval, "1",
                            "Share of what haze and murk take from a beam that is scattered."},
                      Field{"veil", &Simple::veil, any_number, "", "The even part, as of dust or smoke."},
                      Field{"profile", &Simple::profile, any_number, "",
                            "How it varies in space, a list multiplies; absent: not at all."},
                      Field{"hold", &Simple::hold, any_number, "",
                            "\"visibility\": thickness is that of the finished medium, whatever w."}};
  }
};

struct HazyMurky {
  double hazy, murky;
};
/// Hoobler's note: k_hazy = 1 - |1 - 2w|, k_murky = max(0, 2w - 1), w in [0, 1].
inline HazyMurky simple_strengths(double w) { return {1.0 - std::fabs(1.0 - 2.0 * w), std::fmax(0.0, 2.0 * w - 1.0)}; }
/// The same divided by their sum min(1, 2w); w = 0 is taken as pure hazy.
inline HazyMurky simple_shares(double w) { return w <= 0.5 ? HazyMurky{1.0, 0.0} : simple_strengths(w); }

/// Extinction at the origin in green of all but haze and murk: the others' and the veil's. Dials and `others` are in
/// units of `meters_per_unit` metres.
inline double rest_in_green(const Simple& simple, const Spectrum& others, double meters_per_unit = 1.0) {
  const double here = simple.profile ? mean_factor(*simple.profile, Vector{}) : 1.0;
  const double veil = simple.veil ? extinction_of(simple.veil->density, meters_per_unit)[visibility_channel] : 0.0;
  return others[visibility_channel] + here * veil;
}

/// Adds the model's species. The others' extinction at the origin counts only when visibility is held: then thickness
/// is multiplied by the one factor that gives the finished medium, at the origin and in the green channel, the
/// extinction that `thickness` states. Objects where the rest alone is thicker than that.
template <class Out>
std::optional<Objection> compile(const Simple& simple, const Surroundings& others, Out& out) {
  Spectrum thickness = extinction_of(simple.thickness);
  HazyMurky k = simple_strengths(simple.w);
  if (simple.hold == Hold::visibility) {
    const std::size_t green = visibility_channel;
    const double here = simple.profile ? mean_factor(*simple.profile, Vector{}) : 1.0;
    const double stated = thickness[green], rest = rest_in_green(simple, others.extinction);
    if (!(here > 0.0) || !std::isfinite(here)) {
      return Objection{"profile", "a profile that leaves nothing at the origin, where visibility is held",
                       "one that covers the origin, or no \"hold\""};
    }
    if (!(stated > 0.0)) return Objection{"thickness", "no visibility to hold", "a thickness above 0 in green"};
    // Rounding may leave a rest that should be all of it a little thicker.
    if (rest > stated * (1.0 + 1e-12)) {
      const double farthest = visibility_of(rest), wanted = visibility_of(stated);
      return Objection{"thickness",
                       "a visibility of " + short_number(wanted) +
                           " m, when background, veil and other species alone leave " + short_number(farthest) + " m",
                       "a shorter visibility, or less of them"};
    }
    thickness *= std::fmax(0.0, stated - rest) / (stated * here);
    k = simple_shares(simple.w);
  }
  add_species_of(out, "hazy", k.hazy * thickness, simple.albedo, MieHazy<double>{}, factors_of(simple.profile));
  add_species_of(out, "murky", k.murky * thickness, simple.albedo, MieMurky<double>{}, factors_of(simple.profile));
  compile(simple.veil, simple.profile, out);
  return std::nullopt;
}

/// The same medium with visibility held: thickness becomes that of the finished medium. Dials and `others`, the
/// extinction of what else is at the origin, are in units of `meters_per_unit` metres. None where visibility cannot be
/// held: nothing at the origin, or no thickness in green.
inline std::optional<Simple> held(Simple simple, const Spectrum& others, double meters_per_unit) {
  if (simple.hold) return simple;
  const std::size_t green = visibility_channel;
  const Spectrum thickness = extinction_of(simple.thickness, meters_per_unit);
  const double here = simple.profile ? mean_factor(*simple.profile, Vector{}) : 1.0;
  const HazyMurky k = simple_strengths(simple.w);
  const double whole = rest_in_green(simple, others, meters_per_unit) + here * (k.hazy + k.murky) * thickness[green];
  if (!(here > 0.0) || !(thickness[green] > 0.0)) return std::nullopt;
  simple.thickness = PlainExtinction{thickness * (whole / thickness[green])};
  simple.hold = Hold::visibility;
  return simple;
}

/// What in the model, in SI, is not found in nature.
inline void remark_on(const Simple& simple, const Remarks& remarks) {
  remark_on_thickness(simple.thickness, "thickness", remarks);
  const double visibility = visibility_of(extinction_of(simple.thickness)[visibility_channel]);
  if (visibility < 1000.0 && smallest(simple.albedo) < 0.9) {
    remarks.add("albedo", "an albedo of " + short_number(smallest(simple.albedo)) + " in fog",
                "above 0.999: drops of water hardly absorb visible light; put soot or smoke beside them as a species");
  }
}

}  // namespace tyndall
