#pragma once
// Interpolating the dials of two media, as the note blends weather.
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "tyndall/artist/medium_dials.h"

namespace tyndall {

/// Dials, or what keeps the two media from being blended so.
using Blend = std::variant<MediumDials, Objection>;

namespace blending {

inline Objection unlike(std::string field, std::string found) {
  return {std::move(field), std::move(found), "two media made alike, or the blend \"mix\", which takes any two"};
}

/// Two densities in one form: as they are where they agree, else as the extinction that both mean, per `unit` metres.
/// The note interpolates optical thickness (extinction), whatever the dial shows.
inline void align(Density& a, Density& b, double unit) {
  if (same(a, b)) return;
  a = PlainExtinction{extinction_of(a, unit)};
  b = PlainExtinction{extinction_of(b, unit)};
}

/// A veil that is not there is the other one without density.
inline void align(std::optional<Veil>& a, std::optional<Veil>& b, double unit) {
  if (!a && !b) return;
  if (!a) a = Veil{PlainExtinction{}, b->albedo};
  if (!b) b = Veil{PlainExtinction{}, a->albedo};
  align(a->density, b->density, unit);
}

inline std::optional<Objection> align(Simple& a, Simple& b, double unit) {
  align(a.thickness, b.thickness, unit);
  align(a.veil, b.veil, unit);
  return std::nullopt;
}
inline std::optional<Objection> align(TwoLobes& a, TwoLobes& b, double unit) {
  align(a.thickness, b.thickness, unit);
  align(a.veil, b.veil, unit);
  return std::nullopt;
}
inline std::optional<Objection> align(TwoLobesExplicit& a, TwoLobesExplicit& b, double unit) {
  align(a.first.thickness, b.first.thickness, unit);
  align(a.second.thickness, b.second.thickness, unit);
  align(a.veil, b.veil, unit);
  return std::nullopt;
}
/// Measured air of one kind, its density stated in one way (align_measured() sees to that): a diameter that is not
/// stated is the usual one.
inline std::optional<Objection> align(Measured& a, Measured& b, double) {
  if (a.air != b.air) {
    return unlike("conditions/air",
                  "the kinds of air " + std::string(word_of(a.air)) + " and " + std::string(word_of(b.air)));
  }
  if (a.droplet_diameter || b.droplet_diameter) {
    a.droplet_diameter = a.diameter();
    b.droplet_diameter = b.diameter();
  }
  for (const auto& [field, member] : {std::pair{"conditions/angstrom_exponent", &Measured::angstrom_exponent},
                                      std::pair{"conditions/mean_cosine", &Measured::mean_cosine}}) {
    if ((a.*member).has_value() != (b.*member).has_value()) return unlike(field, "a value measured in one medium only");
  }
  if (a.albedo.has_value() != b.albedo.has_value()) {
    return unlike("conditions/albedo", "an albedo measured in one medium only");
  }
  return std::nullopt;
}

/// Extinction at the origin [1/m] of all that is in a medium besides its conditions.
inline Spectrum others_of(MediumDials dials) {
  dials.conditions.reset();
  const auto compiled = compile(dials);
  const Medium* medium = std::get_if<Medium>(&compiled);
  return medium != nullptr ? scattering_at(*medium, {}) + absorption_at(*medium, {}) : Spectrum{};
}

inline Measured without_density(Measured model) {
  model.visibility = model.turbidity = model.liquid_water_content = std::nullopt;
  model.extinction = 0.0;
  return model;
}
inline TwoLobesExplicit without_density(TwoLobesExplicit model) {
  model.first.thickness = model.second.thickness = PlainExtinction{};
  if (model.veil) model.veil->density = PlainExtinction{};
  return model;
}
template <class Model>
Model without_density(Model model) {
  model.thickness = PlainExtinction{};
  if (model.veil) model.veil->density = PlainExtinction{};
  return model;
}

/// Where one medium holds visibility and the other does not, states the other as holding the visibility that it has. A
/// medium without conditions holds that of what else is in it.
inline std::optional<Objection> align_hold(MediumDials& a, MediumDials& b, double meters_per_unit) {
  const auto simple_of = [](MediumDials& dials) {
    return dials.conditions ? std::get_if<Simple>(&*dials.conditions) : nullptr;
  };
  for (const auto& [from, to] : {std::pair{&a, &b}, std::pair{&b, &a}}) {
    const Simple* const model = simple_of(*from);
    if (model == nullptr || !model->hold || (to->conditions && simple_of(*to) == nullptr)) continue;
    Simple other = to->conditions ? *simple_of(*to) : *model;
    if (!to->conditions) {
      // Thin enough to add nothing, with the colour that the thickness has.
      other.w = 0.0;
      other.hold.reset();
      if (other.veil) other.veil->density = PlainExtinction{};
    }
    const auto same_held = held(other, others_of(in_metres(*to, meters_per_unit)) * meters_per_unit, meters_per_unit);
    if (!same_held) return unlike("conditions/hold", "visibility held in one medium, and nothing to hold in the other");
    to->conditions = *same_held;
  }
  return std::nullopt;
}

/// Two visibilities that are held may lead past what the rest leaves on the way, where veil and profile change too:
/// there what the rest leaves is held.
inline void keep_in_reach(MediumDials& dials, double meters_per_unit) {
  Simple* const simple = dials.conditions ? std::get_if<Simple>(&*dials.conditions) : nullptr;
  if (simple == nullptr || !simple->hold) return;
  const Spectrum thickness = extinction_of(simple->thickness, meters_per_unit);
  const Spectrum others = others_of(in_metres(dials, meters_per_unit)) * meters_per_unit;
  const double rest = rest_in_green(*simple, others, meters_per_unit), stated = thickness[visibility_channel];
  if (rest > stated && stated > 0.0) simple->thickness = PlainExtinction{thickness * (rest / stated)};
}

/// Measured air whose density is stated in other ways or numbers becomes what its particles alone take from a beam: as
/// everything else is interpolated by extinction, so is visibility then.
inline void align_measured(MediumDials& a, MediumDials& b, double meters_per_unit) {
  const auto measured_of = [](MediumDials& dials) {
    return dials.conditions ? std::get_if<Measured>(&*dials.conditions) : nullptr;
  };
  Measured *const x = measured_of(a), *const y = measured_of(b);
  if (x != nullptr && y != nullptr && same(*x, *y) && same(a.background, b.background) && same(a.species, b.species)) {
    return;
  }
  for (MediumDials* dials : {&a, &b}) {
    Measured* const model = measured_of(*dials);
    if (model == nullptr) continue;
    MediumDials si = in_metres(*dials, meters_per_unit);
    const Measured in_si = *measured_of(si);
    si.conditions.reset();
    const auto others = compile(si);
    if (!std::holds_alternative<Medium>(others)) continue;
    const double extinction = stated_extinction_at_550(in_si, surroundings_of(si, std::get<Medium>(others)));
    *model = without_density(*model);
    model->extinction = std::fmax(0.0, extinction) * meters_per_unit;
    model->contrast = 0.05;
  }
}

inline std::optional<Objection> align(std::optional<Conditions>& a, std::optional<Conditions>& b, double unit) {
  if (!a && !b) return std::nullopt;
  for (const auto& [from, to] : {std::pair{&a, &b}, std::pair{&b, &a}}) {
    if (!*to) *to = std::visit([](const auto& model) -> Conditions { return without_density(model); }, **from);
  }
  if (a->index() != b->index()) {
    const auto name = [](const auto& model) { return std::string(model.name); };
    return unlike("conditions/model", "the models " + std::visit(name, *a) + " and " + std::visit(name, *b));
  }
  auto objection = std::visit(
      [&](auto& model) { return align(model, std::get<std::remove_cvref_t<decltype(model)>>(*b), unit); }, *a);
  if (objection) return objection;
  if (!alike(*a, *b)) return unlike("conditions/profile", "profiles of different laws");
  return std::nullopt;
}

/// Air that is not there is the other's with exaggeration 0.
inline std::optional<Objection> align(std::optional<Background>& a, std::optional<Background>& b) {
  const auto none = [](const std::optional<Background>& x) { return !x || (x->air == Air::none && !x->ozone); };
  if (none(a) && none(b)) {
    b = a;
    return std::nullopt;
  }
  for (const auto& [absent, present] : {std::pair{&a, &b}, std::pair{&b, &a}}) {
    if (!none(*absent)) continue;
    *absent = *present;
    (*absent)->exaggeration = 0.0;
  }
  if (a->ozone.has_value() != b->ozone.has_value()) {
    a->ozone = a->ozone.value_or(0.0);
    b->ozone = b->ozone.value_or(0.0);
  }
  if (!alike(*a, *b)) return unlike("background", "backgrounds of different kinds");
  return std::nullopt;
}

inline std::optional<Objection> align(StatedSpecies& a, StatedSpecies& b, double unit) {
  const std::string name = '"' + a.name + '"';
  if (a.density && b.density) {
    align(*a.density, *b.density, unit);
    a.albedo = a.albedo.value_or(Spectrum::grey(1.0));
    b.albedo = b.albedo.value_or(Spectrum::grey(1.0));
  } else {
    for (StatedSpecies* s : {&a, &b}) {
      if (s->density) {
        const Spectrum extinction = extinction_of(*s->density, unit), albedo = s->albedo.value_or(Spectrum::grey(1.0));
        s->scattering = extinction * albedo;
        s->absorption = extinction * (Spectrum::grey(1.0) - albedo);
        s->density.reset();
        s->albedo.reset();
      }
      s->scattering = s->scattering.value_or(Spectrum{});
      s->absorption = s->absorption.value_or(Spectrum{});
    }
  }
  if (!alike(a.phase, b.phase)) return unlike("species", "different laws for the species " + name);
  if (!alike(a.profile, b.profile)) return unlike("species", "different profiles for the species " + name);
  return std::nullopt;
}

/// Pairs species by name, in their order where a name is repeated; one without a partner gets an empty one.
inline std::optional<Objection> align(std::vector<StatedSpecies>& a, std::vector<StatedSpecies>& b, double unit) {
  const auto emptied = [](StatedSpecies s) {
    if (s.density) s.density = PlainExtinction{};
    if (s.scattering) s.scattering = Spectrum{};
    if (s.absorption) s.absorption = Spectrum{};
    return s;
  };
  std::vector<StatedSpecies> left, right;
  std::vector<bool> taken(b.size(), false);
  for (const StatedSpecies& s : a) {
    std::size_t i = 0;
    while (i < b.size() && (taken[i] || b[i].name != s.name)) ++i;
    left.push_back(s);
    right.push_back(i < b.size() ? b[i] : emptied(s));
    if (i < b.size()) taken[i] = true;
  }
  for (std::size_t i = 0; i < b.size(); ++i) {
    if (taken[i]) continue;
    left.push_back(emptied(b[i]));
    right.push_back(b[i]);
  }
  for (std::size_t i = 0; i < left.size(); ++i) {
    if (auto objection = align(left[i], right[i], unit)) return objection;
  }
  a = std::move(left);
  b = std::move(right);
  return std::nullopt;
}

}  // namespace blending

/// The medium whose dials stand at t in [0, 1] between those of a and b: w, extinction (thickness and veil), lobes,
/// albedos, exaggeration, profiles and stated species, each linearly (Hoobler's note: "simply interpolate between the w
/// and optical thickness settings"). Both are in units of `meters_per_unit` metres. Exactly a at 0 and b at 1. What one
/// medium lacks counts as being there with no density; where one holds visibility, both do, as far as what else is
/// there on the way leaves it. Objects to different models, laws or profiles.
inline Blend interpolate(MediumDials a, MediumDials b, double t, double meters_per_unit = 1.0) {
  if (t == 0.0) return a;
  if (t == 1.0) return b;
  if (auto objection = blending::align_hold(a, b, meters_per_unit)) return *objection;
  blending::align_measured(a, b, meters_per_unit);
  if (auto objection = blending::align(a.background, b.background)) return *objection;
  if (auto objection = blending::align(a.conditions, b.conditions, meters_per_unit)) return *objection;
  if (auto objection = blending::align(a.species, b.species, meters_per_unit)) return *objection;
  MediumDials out{between_dials(a.background, b.background, t), between_dials(a.conditions, b.conditions, t),
                  between_dials(a.species, b.species, t), a.channels};
  blending::keep_in_reach(out, meters_per_unit);
  return out;
}

}  // namespace tyndall
