// What blends promise, for any media and any share: rapidcheck draws, a hundred thousand cases in soak.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <tuple>

#include "tests/property.h"
#include "tyndall/artist/keyframes.h"
#include "tyndall/artist/prepared_blend.h"
#include "tyndall/artist/random_dials_test.h"

namespace tyndall {
namespace {

using tests::Dice;
using tests::expect_property;

constexpr int usual = 2000, soak = 100000;
constexpr BlendHow every_how[] = {BlendHow::interpolate, BlendHow::mix, BlendHow::morph};

/// Shares of all kinds: anywhere, close to an end, and the ends.
double any_share() {
  const double x = *tests::real(0.0, 1.0);
  switch (*rc::gen::inRange(0, 6)) {
    case 0:
      return 1e-12 * x;
    case 1:
      return 1.0 - 1e-12 * x;
    default:
      return x;
  }
}

/// Makes numbers of a medium other ones, its profiles and laws included, so that it stays alike.
MediumDials other_numbers(MediumDials dials, Dice& dice) {
  for_each_number(dials, FieldFacts{}, "", [&](double& x, const FieldFacts& facts, const std::string&) {
    const double other =
        facts.name == "g" || facts.name == "k" ? dice.between(-0.99, 0.99) : x * dice.between(0.5, 1.0);
    if (facts.range.contains(other) && facts.name != "visibility" && facts.name != "altitude") x = other;
  });
  return dials;
}

/// Whether nothing objects to a profile as a whole.
bool is_whole(const Profile& profile) {
  return std::visit(
      [](const auto& p) {
        if constexpr (requires { objection_to(p); }) {
          return !objection_to(p).has_value();
        } else {
          return true;
        }
      },
      profile);
}

bool is_sound(const MediumDials& dials) {
  const auto compiled = compile(dials);
  const auto* medium = std::get_if<Medium>(&compiled);
  return !unusable_number(dials) && medium != nullptr &&
         std::all_of(medium->species.begin(), medium->species.end(),
                     [](const Species& s) { return std::all_of(s.profiles.begin(), s.profiles.end(), is_whole); });
}

using Ends = std::pair<MediumDials, MediumDials>;
/// Two media that can be blended in this way.
Ends any_pair(BlendHow how) {
  Dice dice(*rc::gen::arbitrary<std::uint64_t>());
  if (how != BlendHow::interpolate) return {dice.medium(), dice.medium()};
  auto [a, b] = dice.like_pair();
  if (dice.coin(0.4)) {
    a = dice.medium();
    b = other_numbers(a, dice);
    RC_PRE(is_sound(a) && is_sound(b));
  }
  dice.hold_where_possible(a);
  dice.hold_where_possible(b);
  if (dice.coin(0.1)) a.conditions.reset();
  RC_PRE(is_sound(a));
  const Blend blend = interpolate(a, b, 0.5);
  RC_PRE(std::holds_alternative<MediumDials>(blend));  // nothing to hold in one of them
  return {a, b};
}

MediumDials dials_of(Blend blend) {
  if (const auto* objection = std::get_if<Objection>(&blend)) RC_FAIL(objection->field + ": " + objection->found);
  return std::get<MediumDials>(std::move(blend));
}
Medium medium_of(const MediumDials& dials) {
  const auto compiled = compile(dials);
  if (const auto* objection = std::get_if<Objection>(&compiled)) {
    RC_FAIL("no medium: " + objection->field + ": " + objection->found);
  }
  return std::get<Medium>(compiled);
}
Medium medium_of(Blend blend) { return medium_of(dials_of(std::move(blend))); }

const Vector places[] = {{}, {0.4, 6.0, -0.7}, {-3.0, -20.0, 2.0}};

/// Within `relative` of the sum of the sizes of what is compared, or of the smallest normal number.
void near(double got, double expected, double relative, double scale) {
  const double allowed = relative * scale + 1e-300;
  if (!(std::fabs(got - expected) <= allowed)) {
    char text[160];
    std::snprintf(text, sizeof text, "%.17g is not %.17g within %.3g", got, expected, allowed);
    RC_FAIL(std::string(text));
  }
}
void near(const Spectrum& got, const Spectrum& expected, double relative, const Spectrum& scale) {
  for (std::size_t c = 0; c < channel_count; ++c) near(got[c], expected[c], relative, scale[c]);
}
Spectrum extinction_at(const Medium& medium, const Vector& p) {
  return scattering_at(medium, p) + absorption_at(medium, p);
}

/// Scattering per channel times the density of the mixture, sideways and about.
Spectrum scattered_at(const Medium& medium, const Vector& p, double mu) {
  Spectrum total;
  for (const Species& s : medium.species) {
    const auto lobes = lower_channels(s.phase);
    for (std::size_t c = 0; c < channel_count; ++c) {
      total[c] += s.scattering[c] * mean_factor(s, p) * density(lobes[c], Deflection<double>::from_mu(mu));
    }
  }
  return total;
}

/// How coarse extinction at a place may be [1/m], for what is compared within 1e-9 of it, in blends of `ends`: a held
/// visibility is a difference at the origin and in green. Its rounding may be all that there is, times what the profile
/// is denser and the thickness stronger in another channel.
Spectrum coarseness(const Ends& ends, const Vector& p) {
  Spectrum out = Spectrum::grey(1e-6);
  for (const MediumDials* dials : {&ends.first, &ends.second}) {
    const Spectrum here = extinction_at(medium_of(*dials), {});
    out += 1e-3 * here;
    const auto* simple = dials->conditions ? std::get_if<Simple>(&*dials->conditions) : nullptr;
    if (simple == nullptr) continue;
    const Spectrum thickness = extinction_of(simple->thickness);
    const double denser =
        simple->profile ? mean_factor(*simple->profile, p) / mean_factor(*simple->profile, Vector{}) : 1.0;
    const Spectrum stronger = thickness * (denser * here[visibility_channel] / thickness[visibility_channel]);
    if (is_finite(stronger)) out += 1e-5 * stronger;
  }
  return out;
}

/// The same medium in numbers: coefficients and how it scatters, in several places.
void same_medium(const Medium& got, const Medium& expected, double relative, const Ends& ends) {
  for (const Vector& p : places) {
    const Spectrum scale = extinction_at(expected, p) + coarseness(ends, p);
    near(scattering_at(got, p), scattering_at(expected, p), relative, scale);
    near(absorption_at(got, p), absorption_at(expected, p), relative, scale);
    for (const double mu : {-1.0, 0.0, 0.9}) {
      const Spectrum light = scattered_at(expected, p, mu);
      near(scattered_at(got, p, mu), light, relative, light + scale);
    }
  }
}

void ends_are_exact() {
  for (const BlendHow how : every_how) {
    const auto [a, b] = any_pair(how);
    RC_ASSERT(same(dials_of(blended(a, b, 0.0, how)), a));
    RC_ASSERT(same(dials_of(blended(a, b, 1.0, how)), b));
    RC_ASSERT(same(dials_of(blended(a, b, 0.0, how, 0.01)), a));
    RC_ASSERT(same(dials_of(blended(a, b, 1.0, how, 0.01)), b));
    const Keyframes keys{{-1.0, a.conditions.value_or(Conditions{}), how},
                         {2.5, b.conditions.value_or(Conditions{}), how}};
    for (const double time : {-9.0, -1.0})
      RC_ASSERT(same(*dials_of(dials_at(a, keys, time)).conditions, keys[0].conditions));
    for (const double time : {2.5, 1e9})
      RC_ASSERT(same(*dials_of(dials_at(a, keys, time)).conditions, keys[1].conditions));
  }
}

void results_are_admissible() {
  for (const BlendHow how : every_how) {
    const auto [a, b] = any_pair(how);
    const MediumDials dials = dials_of(blended(a, b, any_share(), how));
    const auto unusable = unusable_number(dials);
    if (unusable) RC_FAIL(unusable->field + ": " + unusable->found);
    for (const Species& s : medium_of(dials).species) {
      RC_ASSERT(smallest(s.scattering) >= 0.0);
      RC_ASSERT(smallest(s.absorption) >= 0.0);
      RC_ASSERT(is_finite(s.extinction()));
      for (std::size_t c = 0; c < channel_count; ++c) RC_ASSERT(s.scattering[c] <= s.extinction()[c]);
      for (const Profile& profile : s.profiles) RC_ASSERT(is_whole(profile));
      const Spectrum g = mean_cosines(s.phase);
      RC_ASSERT(is_finite(g) && largest(g) <= 1.0 && smallest(g) >= -1.0);
    }
  }
}

void results_are_near_their_ends_close_to_them() {
  for (const BlendHow how : every_how) {
    const auto [a, b] = any_pair(how);
    const Medium at_a = medium_of(a), at_b = medium_of(b);
    const Spectrum scale = extinction_at(at_a, {}) + extinction_at(at_b, {});
    near(extinction_at(medium_of(blended(a, b, 1e-12, how)), {}), extinction_at(at_a, {}), 1e-5, scale);
    near(extinction_at(medium_of(blended(a, b, 1.0 - 1e-12, how)), {}), extinction_at(at_b, {}), 1e-5, scale);
  }
}

void interpolated_dials_go_straight() {
  Dice dice(*rc::gen::arbitrary<std::uint64_t>());
  const double t = any_share();
  const auto simple_of = [](const MediumDials& dials) {
    return dials.conditions ? std::get_if<Simple>(&*dials.conditions) : nullptr;
  };
  auto [a, b] = dice.like_pair();
  while (simple_of(a) == nullptr) std::tie(a, b) = dice.like_pair();
  const Simple *const x = simple_of(a), *const y = simple_of(b);
  const MediumDials dials = dials_of(interpolate(a, b, t));
  if (a.background && a.background->air != Air::none) {
    const double from = a.background->exaggeration, to = b.background->exaggeration;
    near(dials.background->exaggeration, (1.0 - t) * from + t * to, 1e-14, from + to);
  }
  const auto& z = std::get<Simple>(*dials.conditions);
  near(z.w, (1.0 - t) * x->w + t * y->w, 1e-14, 1.0);
  const auto veil = [](const Simple& s) { return s.veil ? extinction_of(s.veil->density) : Spectrum{}; };
  for (const auto& [from, to, got] :
       {std::tuple{extinction_of(x->thickness), extinction_of(y->thickness), extinction_of(z.thickness)},
        {veil(*x), veil(*y), veil(z)}}) {
    near(got, (1.0 - t) * from + t * to, 1e-13, from + to);
  }
}

void mixing_is_the_weighted_sum() {
  const auto [a, b] = any_pair(BlendHow::mix);
  const double t = any_share();
  Medium sum = medium_of(a);
  for (Species& s : sum.species) s.scattering *= 1.0 - t, s.absorption *= 1.0 - t;
  for (Species& s : medium_of(b).species) {
    sum.species.push_back(s);
    sum.species.back().scattering *= t;
    sum.species.back().absorption *= t;
  }
  same_medium(medium_of(mix(a, b, t)), sum, 1e-11, {a, b});
}

void mixing_commutes_and_associates() {
  const auto [a, b] = any_pair(BlendHow::mix);
  const MediumDials c = Dice(*rc::gen::arbitrary<std::uint64_t>()).medium();
  const double t = *tests::real(0.001, 0.999), u = *tests::real(0.001, 0.999);
  const Medium forth = medium_of(mix(a, b, t));
  same_medium(medium_of(mix(b, a, 1.0 - t)), forth, 1e-11, {a, b});
  // ((1-t) a + t b)(1-u) + u c = (1-s) a + s ((1-v) b + v c) with s = t (1-u) + u, v = u / s.
  const double s = t * (1.0 - u) + u, v = u / s;
  same_medium(medium_of(mix(a, dials_of(mix(b, c, v)), s)), medium_of(mix(dials_of(mix(a, b, t)), c, u)), 1e-11,
              {a, b});
}

void morphing_is_linear_in_log_extinction() {
  const auto [a, b] = any_pair(BlendHow::morph);
  const double t = any_share();
  const Spectrum from = extinction_at(medium_of(a), {}), to = extinction_at(medium_of(b), {});
  const Spectrum got = extinction_at(medium_of(morph(a, b, t)), {});
  for (std::size_t c = 0; c < channel_count; ++c) {
    if (!(from[c] > 0.0 && to[c] > 0.0)) continue;
    const double expected = std::exp((1.0 - t) * std::log(from[c]) + t * std::log(to[c]));
    near(got[c], expected, 1e-11, expected);
  }
}

void morphing_puts_lobes_in_order_first() {
  Dice dice(*rc::gen::arbitrary<std::uint64_t>());
  MediumDials a = dice.medium(), b = dice.medium();
  const bool own = dice.coin();
  a.conditions = own ? Conditions{dice.two_lobes_explicit()} : Conditions{dice.two_lobes()};
  b.conditions = own ? Conditions{dice.two_lobes_explicit()} : Conditions{dice.two_lobes()};
  MediumDials swapped = a;
  if (auto* lobes = std::get_if<TwoLobes>(&*swapped.conditions)) {
    std::swap(lobes->g1, lobes->g2);
    lobes->r = 1.0 - lobes->r;
  } else {
    auto& two = std::get<TwoLobesExplicit>(*swapped.conditions);
    std::swap(two.first, two.second);
  }
  const double t = any_share();
  same_medium(medium_of(morph(swapped, b, t)), medium_of(morph(a, b, t)), 1e-11, {a, b});
  same_medium(medium_of(morph(b, swapped, t)), medium_of(morph(b, a, t)), 1e-11, {a, b});
}

void blending_commutes_with_a_change_of_units() {
  const double unit = *tests::magnitude(1e-3, 1e3);
  for (const BlendHow how : every_how) {
    const auto [a, b] = any_pair(how);
    const double t = any_share();
    const MediumDials scaled = dials_of(blended(in_metres(a, 1.0 / unit), in_metres(b, 1.0 / unit), t, how, unit));
    same_medium(medium_of(in_metres(scaled, unit)), medium_of(blended(a, b, t, how)), 1e-9, {a, b});
  }
}

/// Scattering per channel times the density of the mixture, of constants for rays.
Spectrum scattered_at(const LoweredMedium& medium, const Vector& p, double mu) {
  Spectrum total;
  std::vector<Stretch> stretches;
  stretches_along(medium, {p, {0.0, 0.0, 1.0}}, 1.0, stretches);
  for (const Stretch& stretch : stretches) {
    if (!(stretch.range.begin <= 0.01 && 0.01 < stretch.range.end)) continue;
    double light = 0.0;
    for (std::size_t i = 0; i < stretch.species->lobe_count; ++i) {
      const auto& part = medium.lobes[stretch.species->first_lobe + i];
      light += part.weight *
               std::visit([&](const auto& l) { return l.density(Deflection<double>::from_mu(mu)); }, part.lobe);
    }
    total += stretch.species->scattering * (light * stretch.factor_at(0.01));
  }
  return total;
}

void prepared_blends_are_the_blends() {
  for (const BlendHow how : every_how) {
    const auto [a, b] = any_pair(how);
    auto made = PreparedBlend::of(a, b, how);
    if (const auto* objection = std::get_if<Objection>(&made)) RC_FAIL(objection->field + ": " + objection->found);
    auto& prepared = std::get<PreparedBlend>(made);
    for (const double t : {any_share(), 0.0, any_share(), 1.0}) {
      const LoweredMedium expected = lower(medium_of(blended(a, b, t, how)), 3.0), &got = prepared.at(t, 3.0);
      std::vector<Stretch> scratch;
      for (const Vector& p : places) {
        const Ray ray{p, normalized({0.6, 0.3, -0.7})};
        stretches_along(expected, ray, 5.0, scratch);
        const Spectrum depth = optical_depth(scratch, 5.0);
        stretches_along(got, ray, 5.0, scratch);
        const Spectrum scale = depth + 5.0 * (coarseness({a, b}, p) + coarseness({a, b}, ray.at(5.0)));
        near(optical_depth(scratch, 5.0), depth, 1e-9, scale);
        for (const double mu : {-0.8, 0.3, 1.0}) {
          const Spectrum light = scattered_at(expected, p, mu);
          near(scattered_at(got, p, mu), light, 1e-9, light + scale);
        }
      }
    }
  }
}

#define BLEND_PROPERTY(Suite, name, property)             \
  TEST(Suite, name) { expect_property(usual, property); } \
  TEST(Suite##Soak, name) { expect_property(soak, property); }

BLEND_PROPERTY(AnyBlend, IsExactAtItsEnds, ends_are_exact)
BLEND_PROPERTY(AnyBlend, IsAdmissible, results_are_admissible)
BLEND_PROPERTY(AnyBlend, IsContinuousAtItsEnds, results_are_near_their_ends_close_to_them)
BLEND_PROPERTY(AnyBlend, CommutesWithAChangeOfUnits, blending_commutes_with_a_change_of_units)
BLEND_PROPERTY(AnyPreparedBlend, IsTheBlend, prepared_blends_are_the_blends)
BLEND_PROPERTY(AnyInterpolation, GoesStraight, interpolated_dials_go_straight)
BLEND_PROPERTY(AnyMix, IsTheWeightedSumEverywhere, mixing_is_the_weighted_sum)
BLEND_PROPERTY(AnyMix, CommutesAndAssociates, mixing_commutes_and_associates)
BLEND_PROPERTY(AnyMorph, IsLinearInLogExtinction, morphing_is_linear_in_log_extinction)
BLEND_PROPERTY(AnyMorph, PutsLobesInOrderFirst, morphing_puts_lobes_in_order_first)

}  // namespace
}  // namespace tyndall
