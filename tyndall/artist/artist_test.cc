#include <gtest/gtest.h>

#include <cmath>

#include "tyndall/artist/medium_dials.h"
#include "tyndall/artist/random_dials_test.h"

namespace tyndall {
namespace {

using tests::Dice;

Medium medium_of(const MediumDials& dials) {
  auto compiled = compile(dials);
  if (const auto* objection = std::get_if<Objection>(&compiled)) ADD_FAILURE() << objection->found;
  return std::holds_alternative<Medium>(compiled) ? std::get<Medium>(compiled) : Medium{};
}
Spectrum extinction_at_origin(const MediumDials& dials) {
  const Medium medium = medium_of(dials);
  return scattering_at(medium, {}) + absorption_at(medium, {});
}
MediumDials with(Conditions conditions) { return {std::nullopt, std::move(conditions), {}}; }
Simple simple(double w, Density thickness) { return {w, thickness, Spectrum::grey(1.0), {}, {}, {}}; }

TEST(Density, EveryFormMeansTheSameExtinction) {
  const Spectrum sigma{{1e-3, 2e-3, 4e-3}};
  const Density forms[] = {PlainExtinction{sigma}, StatedExtinction{sigma}, MeanFreePath{Spectrum::grey(1.0) / sigma},
                           Visibility{Spectrum::grey(-std::log(0.05)) / sigma, 0.05},
                           Visibility{Spectrum::grey(-std::log(0.02)) / sigma, 0.02}};
  for (const Density& form : forms) {
    for (std::size_t c = 0; c < channel_count; ++c) EXPECT_NEAR(extinction_of(form)[c], sigma[c], 1e-15 * sigma[c]);
  }
}

TEST(Background, IsTheNotesTripletTimesExaggerationOnItAlone) {
  MediumDials dials{Background{}, simple(0.5, PlainExtinction{Spectrum::grey(1e-3)}), {}};
  const Medium real = medium_of(dials);
  ASSERT_EQ(real.species.size(), 2u);
  EXPECT_EQ(real.species[0].scattering, (Spectrum{{5.8e-6, 1.36e-5, 3.31e-5}}));
  EXPECT_TRUE(is_zero(real.species[0].absorption));
  EXPECT_TRUE(std::holds_alternative<Rayleigh<double>>(real.species[0].phase));
  dials.background->exaggeration = 3.0;
  const Medium exaggerated = medium_of(dials);
  EXPECT_EQ(exaggerated.species[0].scattering, 3.0 * real.species[0].scattering);
  EXPECT_EQ(exaggerated.species[1].scattering, real.species[1].scattering);
  dials.background->exaggeration = 0.0;
  EXPECT_EQ(medium_of(dials).species.size(), 1u);
  dials.background = Background{Air::none, 7.0, {}};
  EXPECT_EQ(medium_of(dials).species.size(), 1u);
}

TEST(Simple, StrengthsFollowTheNote) {
  const double table[][3] = {{0, 0, 0}, {0.25, 0.5, 0}, {0.5, 1, 0}, {0.75, 0.5, 0.5}, {1, 0, 1}};
  for (const auto& [w, hazy, murky] : table) {
    EXPECT_EQ(simple_strengths(w).hazy, hazy);
    EXPECT_EQ(simple_strengths(w).murky, murky);
  }
  for (int i = 0; i <= 1000; ++i) {
    const double w = i / 1000.0;
    EXPECT_NEAR(simple_strengths(w).hazy + simple_strengths(w).murky, std::min(1.0, 2.0 * w), 1e-15);
    EXPECT_NEAR(simple_shares(w).hazy + simple_shares(w).murky, 1.0, 1e-15);
  }
  EXPECT_EQ(simple_shares(0.0).hazy, 1.0);  // w = 0 is taken as pure hazy
}

TEST(Simple, IsHazyMurkyAndVeilWithTheirCoefficients) {
  Simple model = simple(0.75, PlainExtinction{Spectrum::grey(2e-3)});
  model.albedo = Spectrum::grey(0.9);
  model.veil = Veil{PlainExtinction{Spectrum::grey(1e-3)}, {{0.5, 1.0, 0.0}}};
  model.profile = ExponentialProfile{30.0, 0.0};
  const Medium medium = medium_of(with(model));
  ASSERT_EQ(medium.species.size(), 3u);
  EXPECT_TRUE(std::holds_alternative<MieHazy<double>>(medium.species[0].phase));
  EXPECT_TRUE(std::holds_alternative<MieMurky<double>>(medium.species[1].phase));
  EXPECT_TRUE(std::holds_alternative<Isotropic<double>>(medium.species[2].phase));
  EXPECT_DOUBLE_EQ(medium.species[0].scattering[0], 0.5 * 2e-3 * 0.9);
  EXPECT_NEAR(medium.species[1].absorption[2], 0.5 * 2e-3 * 0.1, 1e-18);
  EXPECT_EQ(medium.species[2].scattering, (Spectrum{{5e-4, 1e-3, 0.0}}));
  EXPECT_EQ(medium.species[2].absorption, (Spectrum{{5e-4, 0.0, 1e-3}}));
  for (const Species& s : medium.species) EXPECT_EQ(s.profiles.size(), 1u);
}

TEST(Simple, BelowHalfTheDialAlsoThinsTheAir) {
  const Density thickness = PlainExtinction{Spectrum::grey(1e-3)};
  EXPECT_DOUBLE_EQ(extinction_at_origin(with(simple(0.25, thickness)))[1], 5e-4);
  EXPECT_DOUBLE_EQ(extinction_at_origin(with(simple(0.9, thickness)))[1], 1e-3);
  EXPECT_TRUE(medium_of(with(simple(0.0, thickness))).species.empty());
}

TEST(Hold, VisibilityIsWhatWasTypedForAnyWBackgroundVeilAndSpecies) {
  Dice dice(2);
  int held = 0, refused = 0;
  for (int i = 0; i < 20000; ++i) {
    MediumDials dials = dice.medium();
    Simple model = dice.simple();
    const Visibility typed{dice.spectrum(1.0, 1e5), dice.coin() ? 0.05 : 0.02};
    model.thickness = typed;
    model.hold = Hold::visibility;
    dials.conditions = model;
    const auto compiled = compile(dials);
    if (const auto* objection = std::get_if<Objection>(&compiled)) {
      // Only where the rest is thicker than what was asked for.
      MediumDials rest = dials;
      auto& thinned = std::get<Simple>(*rest.conditions);
      thinned.hold.reset();
      thinned.thickness = PlainExtinction{};
      EXPECT_GT(extinction_at_origin(rest)[1], extinction_of(typed)[1] * (1.0 - 1e-12));
      EXPECT_EQ(objection->field, "conditions/thickness");
      ++refused;
      continue;
    }
    const double seen = visibility_of(extinction_at_origin(dials)[1], typed.contrast);
    ASSERT_NEAR(seen, typed.visibility[1], 1e-9 * typed.visibility[1]) << "case " << i << ", w = " << model.w;
    ++held;
  }
  EXPECT_GT(held, 10000);
  EXPECT_GT(refused, 100);
}

TEST(Hold, KeepsTheColourOfTheThickness) {
  Simple model = simple(0.3, Visibility{{{300.0, 600.0, 1200.0}}, 0.05});
  model.hold = Hold::visibility;
  const MediumDials dials{Background{}, model, {}};
  const Medium medium = medium_of(dials);
  const Spectrum hazy = medium.species[1].scattering;
  EXPECT_NEAR(hazy[0] / hazy[1], 2.0, 1e-14);
  EXPECT_NEAR(hazy[1] / hazy[2], 2.0, 1e-14);
}

TEST(Hold, RefusesWhatCannotBe) {
  Simple model = simple(0.3, Visibility{Spectrum::grey(1e6), 0.05});
  model.hold = Hold::visibility;
  for (const auto& dials : {MediumDials{Background{}, model, {}},
                            [&] {
                              Simple elsewhere = model;
                              elsewhere.profile = BoxProfile{{10.0, 10.0, 10.0}, {20.0, 20.0, 20.0}};
                              return MediumDials{std::nullopt, elsewhere, {}};
                            }(),
                            [&] {
                              Simple nothing = model;
                              nothing.thickness = PlainExtinction{};
                              return MediumDials{std::nullopt, nothing, {}};
                            }()}) {
    EXPECT_TRUE(std::holds_alternative<Objection>(compile(dials)));
  }
}

TEST(TwoLobes, RWeightsTheSecondLobe) {
  TwoLobes model;
  model.r = 0.25;
  model.g1 = 0.8;
  model.g2 = -0.3;
  model.thickness = PlainExtinction{{{4e-3, 8e-3, 1e-3}}};
  const Medium medium = medium_of(with(model));
  ASSERT_EQ(medium.species.size(), 2u);
  EXPECT_EQ(medium.species[0].scattering, (Spectrum{{3e-3, 6e-3, 0.75e-3}}));
  EXPECT_EQ(medium.species[1].scattering, (Spectrum{{1e-3, 2e-3, 0.25e-3}}));
  EXPECT_DOUBLE_EQ(mean_cosine_at(medium, {})[1], 0.75 * 0.8 - 0.25 * 0.3);
  model.r = 1.0;
  EXPECT_DOUBLE_EQ(mean_cosine_at(medium_of(with(model)), {})[0], -0.3);
}

TEST(StatedSpecies, TakesOnePairOrTheOther) {
  StatedSpecies s;
  EXPECT_TRUE(objection_to(s));
  s.scattering = Spectrum::grey(1e-3);
  EXPECT_FALSE(objection_to(s));
  s.density = PlainExtinction{};
  EXPECT_EQ(objection_to(s)->field, "density");
  s.density.reset();
  s.albedo = Spectrum::grey(0.5);
  EXPECT_EQ(objection_to(s)->field, "albedo");
}

TEST(StatedSpecies, DensityAndAlbedoGiveBothCoefficients) {
  StatedSpecies s;
  s.density = MeanFreePath{Spectrum::grey(100.0)};
  s.albedo = Spectrum{{0.25, 0.5, 1.0}};
  const Medium medium = medium_of({std::nullopt, std::nullopt, {s}});
  ASSERT_EQ(medium.species.size(), 1u);
  EXPECT_EQ(medium.species[0].scattering, (Spectrum{{0.0025, 0.005, 0.01}}));
  EXPECT_EQ(medium.species[0].absorption, (Spectrum{{0.0075, 0.005, 0.0}}));
}

TEST(Units, LengthsAndInverseLengthsScaleAndNothingElseDoes) {
  Dice dice(7);
  for (int i = 0; i < 2000; ++i) {
    const MediumDials dials = dice.medium();
    for (const double meters_per_unit : {0.01, 1000.0, 0.3048}) {
      // The same medium, stated in another unit, is the same medium.
      const MediumDials other = in_metres(dials, 1.0 / meters_per_unit);
      const Medium expected = medium_of(dials), got = medium_of(in_metres(other, meters_per_unit));
      ASSERT_EQ(expected.species.size(), got.species.size());
      for (std::size_t k = 0; k < got.species.size(); ++k) {
        const Species &e = expected.species[k], &g = got.species[k];
        for (std::size_t c = 0; c < channel_count; ++c) {
          ASSERT_NEAR(g.scattering[c], e.scattering[c], 1e-14 * e.extinction()[c]);
          ASSERT_NEAR(g.absorption[c], e.absorption[c], 1e-14 * e.extinction()[c]);
        }
        ASSERT_EQ(numbers_of(g.phase), numbers_of(e.phase));
        const Vector p{0.5, 0.25, -0.5};
        ASSERT_NEAR(factor(g, p), factor(e, p), 1e-12 * factor(e, p));
      }
    }
  }
}

TEST(Compile, RefusesWhatOverflows) {
  EXPECT_TRUE(std::holds_alternative<Objection>(compile(with(simple(0.5, MeanFreePath{Spectrum::grey(1e-320)})))));
  Simple tall = simple(0.5, PlainExtinction{Spectrum::grey(1.0)});
  tall.profile = ExponentialProfile{1.0, 1e6};
  EXPECT_TRUE(std::holds_alternative<Objection>(compile(with(tall))));
}

}  // namespace
}  // namespace tyndall
