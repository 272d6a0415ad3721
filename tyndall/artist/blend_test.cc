#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tyndall/artist/morph.h"
#include "tyndall/artist/random_dials_test.h"

namespace tyndall {
namespace {

using tests::Dice;

const MediumDials& dials_of(const Blend& blend) {
  if (const auto* objection = std::get_if<Objection>(&blend)) {
    ADD_FAILURE() << objection->field << ": " << objection->found;
    static const MediumDials none;
    return none;
  }
  return std::get<MediumDials>(blend);
}
Medium medium_of(const MediumDials& dials) {
  auto compiled = compile(dials);
  if (const auto* objection = std::get_if<Objection>(&compiled)) ADD_FAILURE() << objection->found;
  return std::holds_alternative<Medium>(compiled) ? std::get<Medium>(compiled) : Medium{};
}
Spectrum extinction_at(const Medium& medium, const Vector& p) {
  return scattering_at(medium, p) + absorption_at(medium, p);
}
bool admissible(const Medium& medium) {
  return std::all_of(medium.species.begin(), medium.species.end(), [](const Species& s) {
    return smallest(s.scattering) >= 0.0 && smallest(s.absorption) >= 0.0 && is_finite(s.extinction());
  });
}
void expect_near(const Spectrum& got, const Spectrum& expected, double relative, const Spectrum& scale) {
  for (std::size_t c = 0; c < channel_count; ++c) ASSERT_NEAR(got[c], expected[c], relative * scale[c]);
}

using Blender = Blend (*)(MediumDials, MediumDials, double);
Blend interpolate_in_metres(MediumDials a, MediumDials b, double t) { return interpolate(a, b, t); }

/// Any two media that can be interpolated: the same models, laws and profiles, other numbers.
std::pair<MediumDials, MediumDials> like_pair(Dice& dice) {
  MediumDials a = dice.medium();
  a.species.clear();
  MediumDials b = a;
  if (a.background) b.background->exaggeration = dice.between(0.0, 3.0);
  if (auto* s = a.conditions ? std::get_if<Simple>(&*a.conditions) : nullptr) {
    Simple other = dice.simple();
    other.profile = s->profile;
    b.conditions = other;
  } else if (auto* l = a.conditions ? std::get_if<TwoLobes>(&*a.conditions) : nullptr) {
    TwoLobes other = dice.two_lobes();
    other.profile = l->profile;
    b.conditions = other;
  } else if (auto* e = a.conditions ? std::get_if<TwoLobesExplicit>(&*a.conditions) : nullptr) {
    TwoLobesExplicit other = dice.two_lobes_explicit();
    other.profile = e->profile;
    b.conditions = other;
  } else if (auto* m = a.conditions ? std::get_if<Measured>(&*a.conditions) : nullptr) {
    Measured other = dice.measured();
    while (other.air != m->air || objection_to(other)) other = dice.measured();
    other.albedo = m->albedo;
    other.angstrom_exponent = m->angstrom_exponent;
    other.mean_cosine = m->mean_cosine;
    other.profile = m->profile;
    b.conditions = other;
  }
  a.species.push_back(dice.species("soot"));
  b.species.push_back(dice.species("soot"));
  b.species.back().phase = a.species.back().phase;
  b.species.back().profile = a.species.back().profile;
  if (dice.coin()) b.species.push_back(dice.species("dust"));
  Dice::make_possible(a);
  Dice::make_possible(b);
  return {a, b};
}

TEST(Interpolate, MovesWAndExtinctionInStraightLines) {
  const Simple haze{0.4, PlainExtinction{Spectrum::grey(1e-4)}, Spectrum::grey(1.0), {}, {}, {}};
  Simple fog = haze;
  fog.w = 0.8;
  fog.thickness = Visibility{Spectrum::grey(100.0), 0.05};
  const MediumDials between = dials_of(interpolate({std::nullopt, haze, {}}, {std::nullopt, fog, {}}, 0.25));
  const auto& model = std::get<Simple>(*between.conditions);
  EXPECT_DOUBLE_EQ(model.w, 0.5);
  EXPECT_DOUBLE_EQ(extinction_of(model.thickness)[0], 0.75e-4 + 0.25 * -std::log(0.05) / 100.0);
}

TEST(Interpolate, KeepsADensityThatBothStateAlike) {
  Simple a{0.4, Visibility{Spectrum::grey(100.0), 0.02}, Spectrum::grey(1.0), {}, {}, {}}, b = a;
  b.w = 0.6;
  const MediumDials between = dials_of(interpolate({std::nullopt, a, {}}, {std::nullopt, b, {}}, 0.5));
  const auto& thickness = std::get<Simple>(*between.conditions).thickness;
  ASSERT_TRUE(std::holds_alternative<Visibility>(thickness));
  EXPECT_EQ(std::get<Visibility>(thickness).visibility[0], 100.0);
}

TEST(Interpolate, RefusesUnlikeMediaAndPointsToMix) {
  Simple simple{0.4, PlainExtinction{Spectrum::grey(1e-4)}, Spectrum::grey(1.0), {}, {}, {}};
  Simple tall = simple;
  tall.profile = ExponentialProfile{};
  for (const Conditions& other : {Conditions{TwoLobes{}}, Conditions{tall}}) {
    const Blend blend = interpolate({std::nullopt, simple, {}}, {std::nullopt, other, {}}, 0.5);
    ASSERT_TRUE(std::holds_alternative<Objection>(blend));
    EXPECT_NE(std::get<Objection>(blend).expected.find("mix"), std::string::npos);
  }
}

TEST(Interpolate, RefusesMeasuredAirOfDifferentKinds) {
  Measured fog, dust;
  fog.air = Particles::fog;
  dust.air = Particles::dust;
  fog.visibility = dust.visibility = 500.0;
  const Blend blend = interpolate({std::nullopt, fog, {}}, {std::nullopt, dust, {}}, 0.5);
  ASSERT_TRUE(std::holds_alternative<Objection>(blend));
  EXPECT_EQ(std::get<Objection>(blend).field, "conditions/air");
  EXPECT_NE(std::get<Objection>(blend).expected.find("mix"), std::string::npos);
}

TEST(Interpolate, FadesAnOzoneLayerIn) {
  Background with, without;
  with.ozone = 300.0;
  const MediumDials half = dials_of(interpolate({without, {}, {}}, {with, {}, {}}, 0.5));
  EXPECT_EQ(half.background->ozone, 150.0);
}

TEST(Interpolate, WhatIsMissingCountsAsWithoutDensity) {
  const Simple fog{0.8, PlainExtinction{Spectrum::grey(1e-2)}, Spectrum::grey(1.0), {}, {}, {}};
  const MediumDials clear{Background{}, {}, {}}, thick{Background{}, fog, {}};
  const Medium half = medium_of(dials_of(interpolate(clear, thick, 0.5)));
  EXPECT_DOUBLE_EQ(extinction_at(half, {})[1], 5e-3 + note_air[1]);
}

TEST(Interpolate, LikeMediaAlwaysGiveAnAdmissibleMediumBetweenThem) {
  Dice dice(11);
  for (int i = 0; i < 5000; ++i) {
    const auto [a, b] = like_pair(dice);
    const double t = dice.between(0.0, 1.0);
    const MediumDials between = dials_of(interpolate(a, b, t));
    ASSERT_FALSE(unusable_number(between));
    ASSERT_TRUE(admissible(medium_of(between)));
  }
}

TEST(Interpolate, HoldsVisibilityInBothWhereOneDoes) {
  Dice dice(18);
  int checked = 0;
  for (int i = 0; i < 3000; ++i) {
    auto [a, b] = like_pair(dice);
    auto* model = b.conditions ? std::get_if<Simple>(&*b.conditions) : nullptr;
    if (model == nullptr) continue;
    model->hold = Hold::visibility;
    if (dice.coin(0.3)) a.conditions.reset();
    // A base height that moves would change densities at the origin on the way.
    if (model->profile && scale_height_of(*model->profile)) continue;
    if (std::holds_alternative<Objection>(compile(b))) continue;
    if (dice.coin()) std::swap(a, b);
    const double t = dice.between(0.0, 1.0), ea = extinction_at(medium_of(a), {})[1];
    const double eb = extinction_at(medium_of(b), {})[1],
                 e = extinction_at(medium_of(dials_of(interpolate(a, b, t))), {})[1];
    ASSERT_NEAR(e, (1.0 - t) * ea + t * eb, 1e-11 * (ea + eb)) << i;
    ++checked;
  }
  EXPECT_GT(checked, 300);
}

TEST(Blend, ProductsOfProfilesSurvive) {
  const auto fog = [](std::vector<Profile> profiles, double extinction) {
    Simple model;
    model.w = 0.5;
    model.thickness = PlainExtinction{Spectrum::grey(extinction)};
    if (!profiles.empty()) model.profile = Profiles(std::move(profiles));
    return MediumDials{{}, model, {}, {}};
  };
  const NoiseProfile noise{5.0, 3, 0.5, 1, {}};
  const MediumDials a = fog({ExponentialProfile{10.0, 0.0}, noise}, 0.1);
  const MediumDials b = fog({ExponentialProfile{30.0, 0.0}, noise}, 0.3);
  const Vector up{3.0, 15.0, 1.0};
  const auto at = [&](const MediumDials& dials) { return extinction_at(medium_of(dials), up)[1]; };
  EXPECT_NEAR(at(a), 0.1 * std::exp(-1.5), 1e-15);
  // The same laws in the same places: their numbers are between those of the ends.
  const MediumDials half = dials_of(interpolate(a, b, 0.5));
  EXPECT_EQ(*std::get<Simple>(*half.conditions).profile,
            Profiles(std::vector<Profile>{ExponentialProfile{20.0, 0.0}, noise}));
  EXPECT_NEAR(at(half), 0.2 * std::exp(-0.75), 1e-15);
  EXPECT_NEAR(at(dials_of(morph(a, b, 0.5))), std::sqrt(0.03) * std::exp(-0.75), 1e-15);
  EXPECT_NEAR(at(dials_of(mix(a, b, 0.5))), 0.5 * (at(a) + at(b)), 1e-15);
  for (const Species& s : medium_of(dials_of(mix(a, b, 0.5))).species) EXPECT_EQ(s.profiles.size(), 2U);
  // Another order or another number of them is another place.
  for (const MediumDials& other :
       {fog({noise, ExponentialProfile{30.0, 0.0}}, 0.3), fog({ExponentialProfile{30.0, 0.0}}, 0.3), fog({}, 0.3)}) {
    const Blend refused = interpolate(a, other, 0.5);
    ASSERT_TRUE(std::holds_alternative<Objection>(refused));
    EXPECT_EQ(std::get<Objection>(refused).field, "conditions/profile");
    EXPECT_NEAR(at(dials_of(mix(a, other, 0.25))), 0.75 * at(a) + 0.25 * at(other), 1e-15);
    const MediumDials morphed = dials_of(morph(a, other, 0.25));
    EXPECT_NEAR(extinction_at(medium_of(morphed), {})[1], std::pow(0.1, 0.75) * std::pow(0.3, 0.25), 1e-15);
    for (const StatedSpecies& s : morphed.species) EXPECT_TRUE(!s.profile || s.profile->all.size() <= 2);
  }
}

TEST(Blend, EndsAreExact) {
  Dice dice(12);
  for (int i = 0; i < 1000; ++i) {
    const MediumDials a = dice.medium(), b = dice.medium();
    for (const auto& blend : {Blender(interpolate_in_metres), Blender(mix), Blender(morph)}) {
      EXPECT_TRUE(same(dials_of(blend(a, b, 0.0)), a));
      EXPECT_TRUE(same(dials_of(blend(a, b, 1.0)), b));
    }
  }
}

TEST(Blend, ApproachesItsEnds) {
  Dice dice(13);
  for (int i = 0; i < 1000; ++i) {
    const MediumDials a = dice.medium(), b = dice.medium();
    for (const auto& blend : {mix, morph}) {
      const Spectrum near_a = extinction_at(medium_of(dials_of(blend(a, b, 1e-9))), {});
      const Spectrum near_b = extinction_at(medium_of(dials_of(blend(a, b, 1.0 - 1e-9))), {});
      const Spectrum at_a = extinction_at(medium_of(a), {}), at_b = extinction_at(medium_of(b), {});
      expect_near(near_a, at_a, 1e-6, at_a + at_b);
      expect_near(near_b, at_b, 1e-6, at_a + at_b);
    }
  }
}

TEST(Mix, IsTheWeightedSumOfBothMediaEverywhere) {
  Dice dice(14);
  for (int i = 0; i < 3000; ++i) {
    const MediumDials a = dice.medium(), b = dice.medium();
    const double t = dice.between(0.0, 1.0);
    const Medium ma = medium_of(a), mb = medium_of(b), mixed = medium_of(dials_of(mix(a, b, t)));
    ASSERT_TRUE(admissible(mixed));
    for (const Vector& p : {Vector{}, Vector{0.5, 7.0, -0.5}}) {
      const Spectrum scale = extinction_at(ma, p) + extinction_at(mb, p);
      expect_near(scattering_at(mixed, p), (1.0 - t) * scattering_at(ma, p) + t * scattering_at(mb, p), 1e-13, scale);
      expect_near(absorption_at(mixed, p), (1.0 - t) * absorption_at(ma, p) + t * absorption_at(mb, p), 1e-13, scale);
    }
    const Spectrum g = mean_cosine_at(mixed, {});
    const Spectrum sa = (1.0 - t) * scattering_at(ma, {}), sb = t * scattering_at(mb, {});
    for (std::size_t c = 0; c < channel_count; ++c) {
      if (!(sa[c] > 0.0) || !(sb[c] > 0.0)) continue;
      ASSERT_NEAR(g[c], (sa[c] * mean_cosine_at(ma, {})[c] + sb[c] * mean_cosine_at(mb, {})[c]) / (sa[c] + sb[c]),
                  1e-12);
    }
  }
}

TEST(Mix, CommutesAndAssociates) {
  Dice dice(15);
  for (int i = 0; i < 1000; ++i) {
    const MediumDials a = dice.medium(), b = dice.medium(), c = dice.medium();
    const double t = dice.between(0.01, 0.99), u = dice.between(0.01, 0.99);
    const Medium forth = medium_of(dials_of(mix(a, b, t))), back = medium_of(dials_of(mix(b, a, 1.0 - t)));
    EXPECT_EQ(forth.species.size(), back.species.size());
    const Spectrum scale = extinction_at(forth, {});
    expect_near(extinction_at(back, {}), scale, 1e-13, scale);
    // ((1-t) a + t b)(1-u) + u c = (1-s) a + s ((1-v) b + v c) with s = t (1-u) + u, v = u / s.
    const double s = t * (1.0 - u) + u, v = u / s;
    const Medium left = medium_of(dials_of(mix(dials_of(mix(a, b, t)), c, u)));
    const Medium right = medium_of(dials_of(mix(a, dials_of(mix(b, c, v)), s)));
    const Spectrum total = extinction_at(left, {});
    expect_near(scattering_at(right, {}), scattering_at(left, {}), 1e-12, total);
    expect_near(absorption_at(right, {}), absorption_at(left, {}), 1e-12, total);
  }
}

TEST(Mix, KeepsTheBackgroundADial) {
  const MediumDials a{Background{Air::note, 1.0, {}}, {}, {}}, b{Background{Air::note, 3.0, {}}, {}, {}};
  const MediumDials mixed = dials_of(mix(a, b, 0.25));
  ASSERT_TRUE(mixed.background);
  EXPECT_DOUBLE_EQ(mixed.background->exaggeration, 1.5);
  EXPECT_TRUE(mixed.species.empty());
}

TEST(Morph, LogExtinctionIsLinearPerChannel) {
  Dice dice(16);
  int checked = 0;
  for (int i = 0; i < 3000; ++i) {
    const MediumDials a = dice.medium(), b = dice.medium();
    const double t = dice.between(0.0, 1.0);
    const Medium morphed = medium_of(dials_of(morph(a, b, t)));
    ASSERT_TRUE(admissible(morphed));
    const Spectrum ea = extinction_at(medium_of(a), {}), eb = extinction_at(medium_of(b), {});
    const Spectrum e = extinction_at(morphed, {});
    for (std::size_t c = 0; c < channel_count; ++c) {
      if (!(ea[c] > 0.0) || !(eb[c] > 0.0)) continue;
      const double expected = std::exp((1.0 - t) * std::log(ea[c]) + t * std::log(eb[c]));
      ASSERT_NEAR(e[c], expected, 1e-11 * expected) << "case " << i;
      ++checked;
    }
  }
  EXPECT_GT(checked, 5000);
}

TEST(Morph, PutsLobesInOrderFirst) {
  TwoLobes a{0.25, 0.8, -0.3, PlainExtinction{Spectrum::grey(1e-3)}, Spectrum::grey(1.0), {}, {}};
  TwoLobes swapped{0.75, -0.3, 0.8, PlainExtinction{Spectrum::grey(1e-3)}, Spectrum::grey(1.0), {}, {}};
  const Medium half = medium_of(dials_of(morph({std::nullopt, a, {}}, {std::nullopt, swapped, {}}, 0.5)));
  ASSERT_EQ(half.species.size(), 2u);
  EXPECT_DOUBLE_EQ(mean_cosine(half.species[0].phase), 0.8);
  EXPECT_DOUBLE_EQ(mean_cosine(half.species[1].phase), -0.3);
  EXPECT_NEAR(half.species[0].scattering[0], 0.75e-3, 1e-17);
}

TEST(Morph, PutsExplicitLobesInOrderFirst) {
  const ExplicitLobe ahead{0.8, PlainExtinction{Spectrum::grey(1e-3)}, Spectrum::grey(1.0)};
  const ExplicitLobe back{-0.3, PlainExtinction{Spectrum::grey(2e-3)}, Spectrum::grey(1.0)};
  const TwoLobesExplicit a{ahead, back, {}, {}}, swapped{back, ahead, {}, {}};
  const Medium half = medium_of(dials_of(morph({std::nullopt, a, {}}, {std::nullopt, swapped, {}}, 0.5)));
  ASSERT_EQ(half.species.size(), 2u);
  EXPECT_DOUBLE_EQ(mean_cosine(half.species[0].phase), 0.8);
  EXPECT_NEAR(half.species[1].scattering[0], 2e-3, 1e-17);
}

TEST(Morph, WhatIsNotAtTheOriginMorphsByItself) {
  Background air;
  air.ozone = 100.0;
  Background other = air;
  other.ozone = 400.0;
  const Medium half = medium_of(dials_of(morph({air, {}, {}}, {other, {}, {}}, 0.5)));
  ASSERT_EQ(half.species.size(), 2u);
  EXPECT_NEAR(half.species[0].scattering[1], note_air[1], 1e-18);
  EXPECT_NEAR(half.species[1].absorption[1], ozone_absorption(550.0, 200.0), 1e-18);
}

TEST(Morph, LeavesAnUnchangedBackgroundAlone) {
  const Simple thin{1.0, PlainExtinction{Spectrum::grey(1e-4)}, Spectrum::grey(1.0), {}, {}, {}};
  Simple thick = thin;
  thick.thickness = PlainExtinction{Spectrum::grey(1e-1)};
  const MediumDials half = dials_of(morph({Background{}, thin, {}}, {Background{}, thick, {}}, 0.5));
  ASSERT_TRUE(half.background);
  EXPECT_DOUBLE_EQ(half.background->exaggeration, 1.0);
}

TEST(Blend, CommutesWithAChangeOfUnits) {
  Dice dice(17);
  for (int i = 0; i < 1000; ++i) {
    const auto [a, b] = like_pair(dice);
    const double t = dice.between(0.0, 1.0), unit = 0.01;
    const Medium in_si = medium_of(dials_of(interpolate(a, b, t)));
    const MediumDials scaled = dials_of(interpolate(in_metres(a, 1.0 / unit), in_metres(b, 1.0 / unit), t, unit));
    const Spectrum expected = extinction_at(in_si, {});
    expect_near(extinction_at(medium_of(in_metres(scaled, unit)), {}), expected, 1e-12, expected);
  }
}

}  // namespace
}  // namespace tyndall
