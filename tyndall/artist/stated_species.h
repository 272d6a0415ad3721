#pragma once
// A species as a person states it; and the keys by which laws and profiles are told apart where they are stated.
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "tyndall/artist/density.h"
#include "tyndall/medium/lowered_frame.h"
#include "tyndall/medium/medium.h"
#include "tyndall/number/demand.h"
#include "tyndall/number/described.h"

namespace tyndall {

template <>
inline constexpr std::string_view choice_key<Law<double>> = "law";
template <>
inline constexpr std::string_view choice_key<Profile> = "law";

/// A mixture needs a part that counts.
inline std::optional<Objection> objection_to(const Mixture<double>& mixture) {
  double total = 0.0;
  for (const auto& part : mixture.parts) total += part.weight;
  if (total > 0.0 && std::isfinite(total)) return std::nullopt;
  return Objection{"parts", mixture.parts.empty() ? "no parts" : "weights without a positive, finite sum",
                   "at least one part with a weight above 0"};
}

constexpr auto demands_of(const Mixture<double>&) { return std::array{counts("parts", "weight")}; }

/// A table is in the text or in a file, and its numbers are a law.
inline std::optional<Objection> objection_to(const Tabulated<double>& table) {
  const bool inside = !table.angles.empty() || !table.values.empty();
  if (inside && table.file) return Objection{"file", "a file beside angles and values", "one or the other"};
  if (!inside && !table.file) return Objection{"", "a table without numbers", "angles and values, or a file"};
  if (table.angles.size() != table.values.size()) {
    return Objection{"values", std::to_string(table.values.size()) + " values",
                     "as many as there are angles, " + std::to_string(table.angles.size())};
  }
  if (table.from_file() && table.file->rows->columns != 2 && table.file->rows->columns != 4) {
    return Objection{"file", "a file of " + std::to_string(table.file->rows->columns) + " columns",
                     "2 (angle, value) or 4 (angle, red, green, blue)"};
  }
  const std::optional<TableFlaw> flaw = flaw_of(table);
  if (!flaw) return std::nullopt;
  if (!table.from_file()) {
    const std::string list = flaw->channel ? "values" : "angles";
    return Objection{flaw->whole ? "" : list + '/' + std::to_string(flaw->knot), flaw->found, flaw->expected};
  }
  std::string where;
  if (!flaw->whole) {
    const std::size_t column = !flaw->channel ? 1 : table.file->rows->columns == 2 ? 2 : 2 + *flaw->channel;
    where = " (line " + std::to_string(table.file->rows->line[flaw->knot]) + ", column " + std::to_string(column) +
            " of the file)";
  }
  return Objection{"file", flaw->found + where, flaw->expected};
}

constexpr auto demands_of(const Tabulated<double>&) {
  return std::array{some_of("angles", "file"), not_both("angles", "file"), not_both("values", "file"),
                    needs("angles", "values"), needs("values", "angles")};
}

/// Coefficients as scattering and absorption, or as density (extinction) and albedo: one pair or the other.
struct StatedSpecies {
  static constexpr std::string_view text = "One kind of particle.";
  std::string name;
  std::optional<Spectrum> scattering, absorption;
  std::optional<Density> density;
  std::optional<Spectrum> albedo;
  Law<double> phase = Isotropic<double>{};
  std::optional<Profiles> profile;
  static constexpr auto fields() {
    return std::tuple{
        Field{"name", &StatedSpecies::name, any_number, "", "What to call it."},
        Field{"scattering", &StatedSpecies::scattering, not_negative, "1/m", "Scattering coefficient.",
              Scaling::inverse_length},
        Field{"absorption", &StatedSpecies::absorption, not_negative, "1/m", "Absorption coefficient.",
              Scaling::inverse_length},
        Field{"density", &StatedSpecies::density, any_number, "",
              "How dense it is, scattering and absorption together."},
        Field{"albedo", &StatedSpecies::albedo, unit_interval, "1",
              "Share of the extinction that is scattering; 1 unless stated."},
        Field{"phase", &StatedSpecies::phase, any_number, "", "Its law of scattering; isotropic unless stated."},
        Field{"profile", &StatedSpecies::profile, any_number, "",
              "How it varies in space, a list multiplies; absent: not at all."}};
  }
};

inline std::optional<Objection> objection_to(const StatedSpecies& s) {
  const bool coefficients = s.scattering || s.absorption;
  const std::string possible = "either scattering and absorption, or density and albedo";
  if (coefficients && s.density) return Objection{"density", "density beside scattering or absorption", possible};
  if (s.albedo && !s.density) return Objection{"albedo", "albedo without density", possible};
  if (!coefficients && !s.density) return Objection{"", "a species without coefficients", possible};
  return std::nullopt;
}

constexpr auto demands_of(const StatedSpecies&) {
  return std::array{some_of("scattering", "absorption", "density"), not_both("scattering", "density"),
                    not_both("absorption", "density"), needs("albedo", "density")};
}

/// What a product is of; none where there is no profile.
inline std::span<const Profile> factors_of(const std::optional<Profiles>& profile) {
  return profile ? std::span<const Profile>(profile->all) : std::span<const Profile>{};
}

/// Adds a species unless it does nothing to light.
inline void add_species(std::vector<Species>& out, std::string_view name, const Spectrum& scattering,
                        const Spectrum& absorption, const Law<double>& phase, std::span<const Profile> profiles) {
  if (is_zero(scattering + absorption)) return;
  out.push_back({std::string(name), scattering, absorption, phase, {profiles.begin(), profiles.end()}});
}
/// The same into a frame, where what does nothing keeps its place.
inline void add_species(LoweredFrame& out, std::string_view /*name*/, const Spectrum& scattering,
                        const Spectrum& absorption, const Law<double>& phase, std::span<const Profile> profiles) {
  out.put(scattering, absorption, phase, profiles);
}
/// Adds a species of this extinction [1/m] and albedo to either.
template <class Out>
void add_species_of(Out& out, std::string_view name, const Spectrum& extinction, const Spectrum& albedo,
                    const Law<double>& phase, std::span<const Profile> profiles) {
  add_species(out, name, extinction * albedo, extinction * (Spectrum::grey(1.0) - albedo), phase, profiles);
}

template <class Out>
void compile(const StatedSpecies& s, Out& out) {
  if (s.density) {
    add_species_of(out, s.name, extinction_of(*s.density), s.albedo.value_or(Spectrum::grey(1.0)), s.phase,
                   factors_of(s.profile));
  } else {
    add_species(out, s.name, s.scattering.value_or(Spectrum{}), s.absorption.value_or(Spectrum{}), s.phase,
                factors_of(s.profile));
  }
}

}  // namespace tyndall
