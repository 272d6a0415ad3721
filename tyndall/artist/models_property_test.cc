// What every model promises, for any dials.
#include <gtest/gtest.h>

#include "tests/property.h"
#include "tyndall/artist/blend.h"

namespace tyndall {
namespace {

using rc::gen::element;
using tests::expect_property;
using tests::magnitude;
using tests::maybe;
using tests::real;

Spectrum spectrum_of(double low, double high) {
  return {{*magnitude(low, high), *magnitude(low, high), *magnitude(low, high)}};
}
Spectrum any_albedo() { return {{*real(0.0, 1.0), *real(0.0, 1.0), *real(0.0, 1.0)}}; }

Density any_density(double low, double high) {
  const Spectrum sigma = spectrum_of(low, high);
  const double distance = *magnitude(0.1, 100.0);
  auto forms = every_form_of(sigma, distance, *magnitude(0.1, 10.0));
  forms.push_back(PlainExtinction{sigma});
  return forms[*rc::gen::inRange<std::size_t>(0, forms.size())];
}

std::optional<Profiles> any_profile() {
  const double height = *magnitude(1.0, 1e4);
  const NoiseProfile noise{height, 4, 0.5, 0, {}};
  const ExponentialProfile deep{height, -0.5 * height};
  return *element<std::optional<Profiles>>(std::nullopt, ConstantProfile{}, ExponentialProfile{height, 0.0}, deep,
                                           SphereProfile{{}, height}, noise,
                                           std::vector<Profile>{deep, noise, SphereProfile{{}, height}});
}

std::optional<Background> any_background() {
  if (*rc::gen::inRange(0, 4) == 0) return std::nullopt;
  Background air;
  air.air = *element(Air::none, Air::note, Air::standard);
  air.exaggeration = *real(0.0, 5.0);
  air.profile = any_profile();
  air.altitude = *real(-400.0, 8000.0);
  air.ozone = *maybe(real(0.0, 600.0));
  return air;
}

std::optional<Veil> any_veil() {
  if (*element(true, false)) return std::nullopt;
  return Veil{any_density(1e-7, 1e-4), any_albedo()};
}

std::vector<StatedSpecies> any_species() {
  if (*element(true, false)) return {};
  StatedSpecies soot;
  soot.name = "soot";
  soot.density = any_density(1e-7, 1e-4);
  soot.albedo = any_albedo();
  soot.profile = any_profile();
  return {soot};
}

/// Extinction in green at the origin.
double green_of(const Medium& medium) {
  return scattering_at(medium, {})[visibility_channel] + absorption_at(medium, {})[visibility_channel];
}
double green_of(const MediumDials& dials) { return green_of(std::get<Medium>(compile(dials))); }

void held_visibility_is_what_was_typed() {
  Simple simple;
  simple.w = *real(0.0, 1.0);
  const Visibility typed{spectrum_of(1.0, 1e5), *element(0.05, 0.02)};
  simple.thickness = typed;
  simple.albedo = any_albedo();
  simple.hold = Hold::visibility;
  simple.veil = any_veil();
  simple.profile = any_profile();
  MediumDials dials{any_background(), simple, any_species()};
  const auto compiled = compile(dials);
  if (const auto* objection = std::get_if<Objection>(&compiled)) {
    // Only where the rest alone is thicker than what was asked for.
    RC_ASSERT(objection->field == "conditions/thickness");
    simple.hold.reset();
    simple.thickness = PlainExtinction{};
    dials.conditions = simple;
    RC_ASSERT(green_of(dials) > extinction_of(Density{typed})[visibility_channel] * (1.0 - 1e-12));
    return;
  }
  const double seen = visibility_of(green_of(std::get<Medium>(compiled)), typed.contrast);
  RC_ASSERT(std::fabs(seen - typed.visibility[1]) <= 1e-9 * typed.visibility[1]);
}

Measured any_measured() {
  Measured measured;
  measured.air = static_cast<Particles>(*rc::gen::inRange(0, 8));
  if (is_water(measured.air)) {
    measured.droplet_diameter = *maybe(measured.air == Particles::fog ? magnitude(1.5, 50.0) : magnitude(100.0, 1e4));
  }
  measured.albedo = *maybe(rc::gen::map(real(0.0, 1.0), [](double x) { return Spectrum::grey(x); }));
  measured.angstrom_exponent = *maybe(real(-1.0, 4.0));
  measured.mean_cosine = *maybe(real(-0.9, 0.9));
  measured.profile = any_profile();
  return measured;
}

void measured_visibility_is_what_was_typed() {
  Measured measured = any_measured();
  measured.visibility = *magnitude(1.0, 1e5);
  measured.contrast = *element(0.05, 0.02);
  MediumDials dials{any_background(), measured, any_species()};
  const auto compiled = compile(dials);
  if (const auto* objection = std::get_if<Objection>(&compiled)) {
    RC_ASSERT(objection->field == "conditions/visibility");
    dials.conditions.reset();
    RC_ASSERT(visibility_of(green_of(dials), measured.contrast) < *measured.visibility * (1.0 + 1e-12));
    return;
  }
  const double seen = visibility_of(green_of(std::get<Medium>(compiled)), measured.contrast);
  RC_ASSERT(std::fabs(seen - *measured.visibility) <= 1e-9 * *measured.visibility);
}

/// Two settings of one model that differ in what may be interpolated; none of them thinner than nothing.
std::pair<Conditions, Conditions> two_of_a_model() {
  const auto profile = any_profile();
  const auto g = [] { return *real(-0.99, 0.99); };
  switch (*rc::gen::inRange(0, 3)) {
    case 0: {
      const auto lobes = [&] {
        return TwoLobes{*real(0.0, 1.0), g(), g(), any_density(1e-4, 1.0), any_albedo(), any_veil(), profile};
      };
      return {lobes(), lobes()};
    }
    case 1: {
      const auto lobe = [&] { return ExplicitLobe{g(), any_density(1e-4, 1.0), any_albedo()}; };
      const auto lobes = [&] { return TwoLobesExplicit{lobe(), lobe(), any_veil(), profile}; };
      return {lobes(), lobes()};
    }
    default: {
      Measured a = any_measured();
      a.profile = profile;
      Measured b = a;
      for (Measured* m : {&a, &b}) {
        switch (*rc::gen::inRange(0, 4)) {
          case 0:
            m->visibility = *magnitude(1.0, 1e3);
            break;
          case 1:
            m->extinction = *magnitude(1e-4, 1.0);
            break;
          case 2:
            m->turbidity = *real(1.0, 10.0);
            break;
          default:
            if (is_water(m->air)) m->liquid_water_content = *magnitude(1e-3, 1.0);
            if (!is_water(m->air)) m->visibility = *magnitude(1.0, 1e3);
        }
      }
      return {a, b};
    }
  }
}

void one_model_interpolates_its_extinction() {
  const auto [from, to] = two_of_a_model();
  MediumDials a{any_background(), from, any_species()}, b{a.background, to, a.species};
  if (b.background) b.background->exaggeration = *real(0.0, 5.0);
  RC_PRE(std::holds_alternative<Medium>(compile(a)) && std::holds_alternative<Medium>(compile(b)));
  const double t = *real(0.0, 1.0), unit = *element(1.0, 0.01, 1000.0);
  const Blend blend = interpolate(in_metres(a, 1.0 / unit), in_metres(b, 1.0 / unit), t, unit);
  RC_ASSERT(std::holds_alternative<MediumDials>(blend));
  const MediumDials dials = in_metres(std::get<MediumDials>(blend), unit);
  RC_ASSERT(!unusable_number(dials));
  const double ends = (1.0 - t) * green_of(a) + t * green_of(b);
  RC_ASSERT(std::fabs(green_of(dials) - ends) <= 1e-11 * ends);
}

void a_density_means_one_extinction_in_every_form_and_unit() {
  const Spectrum sigma = spectrum_of(1e-6, 10.0);
  const double unit = *magnitude(1e-3, 1e3), distance = *magnitude(0.1, 10.0);
  for (const Density& form : every_form_of(sigma, distance, *magnitude(0.01, 100.0))) {
    const Spectrum in_unit = extinction_of(in_metres(form, 1.0 / unit), unit) / unit;
    for (std::size_t c = 0; c < channel_count; ++c) {
      // A transmittance near 1 has few digits of what is missing to it.
      const double allowed = 1e-13 * sigma[c] + 4e-16 / distance;
      RC_ASSERT(std::fabs(extinction_of(form)[c] - sigma[c]) <= allowed);
      RC_ASSERT(std::fabs(in_unit[c] - sigma[c]) <= allowed);
    }
  }
}

constexpr int cases = 5000, soak_cases = 100000;

TEST(Models, HeldVisibilityIsWhatWasTypedForAnyDials) { expect_property(cases, held_visibility_is_what_was_typed); }
TEST(ModelsSoak, HeldVisibilityIsWhatWasTypedForAnyDials) {
  expect_property(soak_cases, held_visibility_is_what_was_typed);
}
TEST(Models, MeasuredVisibilityIsWhatWasTypedForAnyDials) {
  expect_property(cases, measured_visibility_is_what_was_typed);
}
TEST(ModelsSoak, MeasuredVisibilityIsWhatWasTypedForAnyDials) {
  expect_property(soak_cases, measured_visibility_is_what_was_typed);
}
TEST(Models, OneModelInterpolatesItsExtinctionInAnyUnit) {
  expect_property(cases, one_model_interpolates_its_extinction);
}
TEST(ModelsSoak, OneModelInterpolatesItsExtinctionInAnyUnit) {
  expect_property(soak_cases, one_model_interpolates_its_extinction);
}
TEST(Models, ADensityMeansOneExtinctionInEveryFormAndUnit) {
  expect_property(cases, a_density_means_one_extinction_in_every_form_and_unit);
}
TEST(ModelsSoak, ADensityMeansOneExtinctionInEveryFormAndUnit) {
  expect_property(soak_cases, a_density_means_one_extinction_in_every_form_and_unit);
}

}  // namespace
}  // namespace tyndall
