#pragma once
// Everything a person states about a medium, and how it becomes the list of species.
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "tyndall/artist/background.h"
#include "tyndall/artist/dials.h"
#include "tyndall/artist/simple.h"
#include "tyndall/artist/two_lobes.h"

namespace tyndall {

/// The closed list of models of weather. A new one is a header and a word here.
using Conditions = std::variant<Simple, TwoLobes>;
template <>
inline constexpr std::string_view choice_key<Conditions> = "model";

struct MediumDials {
  std::optional<Background> background;
  std::optional<Conditions> conditions;
  std::vector<StatedSpecies> species;
  static constexpr auto fields() {
    return std::tuple{
        Field{"background", &MediumDials::background, any_number, "", Background::text},
        Field{"conditions", &MediumDials::conditions, any_number, "", "The weather, by one of the artist models."},
        Field{"species", &MediumDials::species, any_number, "", "More kinds of particles, stated one by one."}};
  }
};

/// The medium in SI, or what stands in its way (an Objection's field is a path below the medium). The dials must be in
/// SI: in_metres() brings them there. Species come in the order air, conditions, stated species; void ones are left
/// out.
inline std::variant<Medium, Objection> compile(const MediumDials& dials) {
  Medium others, medium;
  if (dials.background) compile(*dials.background, others.species);
  const std::size_t airs = others.species.size();
  for (const StatedSpecies& s : dials.species) compile(s, others.species);
  medium.species.assign(others.species.begin(), others.species.begin() + static_cast<std::ptrdiff_t>(airs));
  if (dials.conditions) {
    const Spectrum rest = scattering_at(others, {}) + absorption_at(others, {});
    auto objection =
        std::visit([&](const auto& model) { return compile(model, rest, medium.species); }, *dials.conditions);
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
    if (!(largest(s.extinction()) <= 1e30 && largest(s.extinction() * here) <= 1e30)) {
      return Objection{"", "a species too dense for double precision", "less of it, or a taller profile"};
    }
  }
  return medium;
}

}  // namespace tyndall
