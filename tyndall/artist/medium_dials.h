#pragma once
// Everything a person states about a medium, and how it becomes the list of species.
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "tyndall/artist/background.h"
#include "tyndall/artist/channel_tag.h"
#include "tyndall/artist/dials.h"
#include "tyndall/artist/measured.h"
#include "tyndall/artist/remark.h"
#include "tyndall/artist/simple.h"
#include "tyndall/artist/two_lobes.h"
#include "tyndall/artist/two_lobes_explicit.h"

namespace tyndall {

/// The closed list of models of weather. A new one is a header and a word here.
using Conditions = std::variant<Simple, TwoLobes, TwoLobesExplicit, Measured>;
template <>
inline constexpr std::string_view choice_key<Conditions> = "model";

struct MediumDials {
  std::optional<Background> background;
  std::optional<Conditions> conditions;
  std::vector<StatedSpecies> species;
  std::optional<ChannelTag> channels = std::nullopt;  // absent: linear sRGB
  static constexpr auto fields() {
    return std::tuple{
        Field{"channels", &MediumDials::channels, any_number, "", "What the three channels are."},
        Field{"background", &MediumDials::background, any_number, "", Background::text},
        Field{"conditions", &MediumDials::conditions, any_number, "", "The weather, by one of the artist models."},
        Field{"species", &MediumDials::species, any_number, "", "More kinds of particles, stated one by one."}};
  }
};

/// What there is besides the conditions, seen from them.
inline Surroundings surroundings_of(const MediumDials& dials, const Medium& others) {
  const double altitude = dials.background ? dials.background->altitude : 0.0;
  return {scattering_at(others, {}) + absorption_at(others, {}), wavelengths_of(dials.channels),
          standard_air_at(altitude).pressure};
}

/// The medium in SI, or what stands in its way (an Objection's field is a path below the medium). The dials must be in
/// SI: in_metres() brings them there. Species come in the order air, ozone, conditions, stated species; void ones are
/// left out.
inline std::variant<Medium, Objection> compile(const MediumDials& dials) {
  Medium others, medium;
  if (dials.background) {
    if (auto objection = compile(*dials.background, wavelengths_of(dials.channels), others.species)) return *objection;
  }
  const std::size_t airs = others.species.size();
  for (const StatedSpecies& s : dials.species) compile(s, others.species);
  medium.species.assign(others.species.begin(), others.species.begin() + static_cast<std::ptrdiff_t>(airs));
  if (dials.conditions) {
    const Surroundings surroundings = surroundings_of(dials, others);
    auto objection =
        std::visit([&](const auto& model) { return compile(model, surroundings, medium.species); }, *dials.conditions);
    if (objection) {
      objection->field = "conditions" + (objection->field.empty() ? "" : "/" + objection->field);
      return *objection;
    }
  }
  medium.species.insert(medium.species.end(), others.species.begin() + static_cast<std::ptrdiff_t>(airs),
                        others.species.end());
  for (const Species& s : medium.species) {
    const double here = mean_factor(s, {});
    // Up to 1e30 1/m, products with a scene's lengths and lights stay within double precision.
    const Spectrum extinction = s.extinction(), at_origin = extinction * here;
    if (!(is_finite(extinction) && is_finite(at_origin) && largest(extinction) <= 1e30 && largest(at_origin) <= 1e30)) {
      return Objection{"", "a species too dense for double precision", "less of it, or a taller profile"};
    }
  }
  return medium;
}

/// The same medium as a frame that is filled again and again; only numbers may have changed since the first time. In a
/// frame air and ozone come first, stated species next, conditions last; conditions that contradict the rest are not
/// there. Nothing allocates but in the first frames and where dials contradict each other.
inline void compile_frame(const MediumDials& dials, double time, LoweredFrame& out) {
  out.begin(time);
  if (dials.background) compile(*dials.background, wavelengths_of(dials.channels), out);
  for (const StatedSpecies& s : dials.species) compile(s, out);
  if (dials.conditions) {
    const double altitude = dials.background ? dials.background->altitude : 0.0;
    const Surroundings surroundings{out.extinction_at_origin(), wavelengths_of(dials.channels),
                                    standard_air_at(altitude).pressure};
    std::visit([&](const auto& model) { compile(model, surroundings, out); }, *dials.conditions);
  }
  out.end();
}

/// What the background of a medium in SI compiles to, alone.
inline std::vector<Species> air_of(const MediumDials& dials) {
  std::vector<Species> air;
  if (dials.background) compile(*dials.background, wavelengths_of(dials.channels), air);
  return air;
}

/// Where numbers come from that a medium in SI uses without stating them.
inline std::vector<std::string> statements_on(const MediumDials& dials) {
  std::vector<std::string> out;
  if (dials.background) out = statements_on(*dials.background, wavelengths_of(dials.channels));
  const auto* measured = dials.conditions ? std::get_if<Measured>(&*dials.conditions) : nullptr;
  if (measured != nullptr) {
    for (std::string& text : statements_on(*measured)) out.push_back(std::move(text));
  }
  return out;
}

/// Everything in a medium, in SI, that is outside what physics allows: not refused, but worth knowing.
inline std::vector<Remark> remarks_on(const MediumDials& dials) {
  std::vector<Remark> out;
  if (dials.background) remark_on(*dials.background, wavelengths_of(dials.channels), {out, "background"});
  if (dials.conditions) {
    std::visit([&](const auto& model) { remark_on(model, {out, "conditions"}); }, *dials.conditions);
  }
  return out;
}

}  // namespace tyndall
