// What every law promises, asked of each law of the list in double precision.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tyndall/number/dual.h"
#include "tyndall/phase/law_as.h"
#include "tyndall/phase/law_cases_test.h"
#include "tyndall/phase/law_suites_test.h"
#include "tyndall/phase/merged_lobes.h"
#include "tyndall/phase/sphere_integral_test.h"

namespace tyndall {
namespace {

template <class L>
class EachLaw : public LawCasesTest<L> {};
TYPED_TEST_SUITE(EachLaw, EveryLaw, LawNames);

TYPED_TEST(EachLaw, IntegratesToOneOverTheSphere) {
  this->on_cases([](const Law<double>& law) {
    const LobeSum<double> lobes = lower(law);
    const auto p = [&](const Deflection<double>& d) { return density(lobes, d); };
    EXPECT_NEAR(integral_over_sphere(kinks_of(law), p), 1.0, 1e-10);
    if (kinks_of(law).empty()) {
      EXPECT_NEAR(integral_over_sphere(p), 1.0, 1e-10);
    }
  });
}

TYPED_TEST(EachLaw, HasItsLegendreMoments) {
  this->on_cases([](const Law<double>& law) {
    const LobeSum<double> lobes = lower(law);
    const std::vector<double> kinks = kinks_of(law), all = moments(lobes, 40);
    for (int l = 0; l <= 40; ++l) {
      const auto weighted_density = [&](const Deflection<double>& d) { return density(lobes, d) * legendre(l, d.mu); };
      EXPECT_NEAR(moment(law, l), integral_over_sphere(kinks, weighted_density), 1e-10) << "l = " << l;
      EXPECT_NEAR(all[static_cast<std::size_t>(l)], moment(law, l), 1e-12) << "l = " << l;
    }
    EXPECT_DOUBLE_EQ(mean_cosine(law), moment(law, 1));
  });
}

TYPED_TEST(EachLaw, IsNowhereNegative) {
  this->on_cases([](const Law<double>& law) {
    for (const Deflection<double>& d : test_deflections()) {
      EXPECT_GE(density(law, d), 0.0);
      EXPECT_TRUE(std::isfinite(density(law, d)));
    }
  });
}

// F' = 2 pi p and S' = -2 pi p by exact differentiation, so that with the ends F is the integral of p.
TYPED_TEST(EachLaw, CumulatesItsDensity) {
  using D = Dual<double>;
  this->on_cases([](const Law<double>& law) {
    const Law<D> by_mu = law_as<D>(law);
    for (const Deflection<double>& d : test_deflections()) {
      const Deflection<D> moving{D(d.mu, {1.0}), D(d.one_minus, {-1.0}), D(d.one_plus, {1.0})};
      const double slope = 2.0 * std::numbers::pi * density(law, d);
      EXPECT_NEAR(cdf(by_mu, moving).derivative[0], slope, 1e-11 * slope + 1e-15);
      EXPECT_NEAR(survival(by_mu, moving).derivative[0], -slope, 1e-11 * slope + 1e-15);
      EXPECT_NEAR(cdf(law, d) + survival(law, d), 1.0, 3e-14);
    }
    const auto back = Deflection<double>::from_ends(2.0, 0.0), front = Deflection<double>::from_ends(0.0, 2.0);
    EXPECT_EQ(cdf(law, back), 0.0);
    EXPECT_EQ(survival(law, front), 0.0);
    EXPECT_NEAR(cdf(law, front), 1.0, 3e-14);
    EXPECT_NEAR(survival(law, back), 1.0, 3e-14);
  });
}

// Relative to xi and to 1 - xi, whichever is small: the peaks' tails are as right as their middle.
TYPED_TEST(EachLaw, SamplesTheInverseOfItsCumulativeDistribution) {
  this->on_cases([](const Law<double>& law) {
    std::vector<double> all = test_xi();
    for (const double xi : {1e-100, 1e-30, 1e-15, 1.0 - 1e-15}) all.push_back(xi);
    for (const double xi : all) {
      const Deflection<double> d = sample(law, xi);
      EXPECT_NEAR(cdf(law, d), xi, 3e-14 * xi) << "xi = " << xi;
      EXPECT_NEAR(survival(law, d), 1.0 - xi, 3e-14 * (1.0 - xi)) << "xi = " << xi;
      EXPECT_NEAR(d.one_minus + d.one_plus, 2.0, 4e-15);
      EXPECT_NEAR(d.mu, 1.0 - d.one_minus, 2e-15);
    }
  });
}

TYPED_TEST(EachLaw, SamplesFromStraightBackToStraightOn) {
  this->on_cases([](const Law<double>& law) {
    const Deflection<double> back = sample(law, 0.0), front = sample(law, 1.0);
    EXPECT_EQ(back.mu, -1.0);
    EXPECT_EQ(back.one_plus, 0.0);
    EXPECT_NEAR(back.one_minus, 2.0, 4e-15);
    EXPECT_EQ(front.mu, 1.0);
    EXPECT_NEAR(front.one_plus, 2.0, 4e-15);
    EXPECT_EQ(front.one_minus, 0.0);
  });
}

TYPED_TEST(EachLaw, SamplesMonotonically) {
  this->on_cases([](const Law<double>& law) {
    Deflection<double> before = sample(law, 0.0);
    for (int i = 1; i <= 4096; ++i) {
      const Deflection<double> d = sample(law, i / 4096.0);
      EXPECT_GE(d.one_plus, before.one_plus);
      EXPECT_LE(d.one_minus, before.one_minus);
      before = d;
    }
  });
}

TEST(HenyeyGreenstein, MeanCosineIsG) {
  for (const double g : {-0.9999, -0.5, 0.0, 1e-6, 0.7, 0.9999})
    EXPECT_EQ(mean_cosine(Law<double>(HenyeyGreenstein<double>{g})), g);
}

TEST(HenyeyGreenstein, IsIsotropicWithoutG) {
  const Law<double> law = HenyeyGreenstein<double>{0.0};
  for (const Deflection<double>& d : test_deflections()) {
    EXPECT_DOUBLE_EQ(density(law, d), 1.0 / (4.0 * std::numbers::pi));
    EXPECT_DOUBLE_EQ(cdf(law, d), 0.5 * d.one_plus);
  }
}

TEST(HenyeyGreenstein, IsTheTextbooksFormula) {
  for (const double g : {-0.8, -0.2, 0.3, 0.75}) {
    for (double mu = -1.0; mu <= 1.0; mu += 0.125) {
      const double textbook = (1.0 - g * g) / (4.0 * std::numbers::pi * std::pow(1.0 + g * g - 2.0 * g * mu, 1.5));
      const double found = density(Law<double>(HenyeyGreenstein<double>{g}), Deflection<double>::from_mu(mu));
      EXPECT_NEAR(found, textbook, 1e-13 * textbook);
    }
  }
}

TEST(Rayleigh, IsTheClassicalLawWithoutDepolarisation) {
  const Law<double> law = Rayleigh<double>{0.0};
  for (double mu = -1.0; mu <= 1.0; mu += 0.125) {
    const double classical = 3.0 / (16.0 * std::numbers::pi) * (1.0 + mu * mu);
    EXPECT_NEAR(density(law, Deflection<double>::from_mu(mu)), classical, 1e-15);
  }
  EXPECT_DOUBLE_EQ(moment(law, 2), 0.1);
}

TEST(MieHazy, HasTheNotesMeanCosine) {
  EXPECT_NEAR(mean_cosine(Law<double>(MieHazy<double>{})), 0.4, 1e-15);
  EXPECT_NEAR(moment(Law<double>(MieHazy<double>{}), 2), 14.0 / 55.0, 1e-15);
  EXPECT_NEAR(mean_cosine(Law<double>(MieMurky<double>{})), 8.0 / 17.0, 1e-15);
}

// The note prints (1/(4 pi)) (1/2 + 33/2 u^3): that law would give out 4.625 times what it takes in.
TEST(MieMurky, TheNotesPrintedExponentCreatesEnergy) {
  const auto note = [](double exponent) {
    return integral_over_sphere([=](const Deflection<double>& d) {
      return (0.5 + 16.5 * std::pow(0.5 * d.one_plus, exponent)) / (4.0 * std::numbers::pi);
    });
  };
  EXPECT_NEAR(note(3.0), 4.625, 1e-12);
  EXPECT_NEAR(note(32.0), 1.0, 1e-12);
  const Law<double> murky = MieMurky<double>{};
  for (double mu = -1.0; mu <= 1.0; mu += 0.25) {
    const double with_32 = (0.5 + 16.5 * std::pow(0.5 * (1.0 + mu), 32.0)) / (4.0 * std::numbers::pi);
    EXPECT_NEAR(density(murky, Deflection<double>::from_mu(mu)), with_32, 1e-14 * with_32);
  }
}

TEST(Mixture, IsTheWeightedMeanOfItsParts) {
  const Law<double> a = HenyeyGreenstein<double>{0.6}, b = MieMurky<double>{};
  const Law<double> mixture = Mixture<double>{{{1.0, a}, {3.0, b}}};
  for (const Deflection<double>& d : test_deflections()) {
    EXPECT_NEAR(density(mixture, d), 0.25 * density(a, d) + 0.75 * density(b, d), 1e-15);
    EXPECT_NEAR(cdf(mixture, d), 0.25 * cdf(a, d) + 0.75 * cdf(b, d), 1e-15);
  }
  EXPECT_NEAR(moment(mixture, 3), 0.25 * moment(a, 3) + 0.75 * moment(b, 3), 1e-15);
}

TEST(Mixture, FlattensWhatIsNested) {
  const Mixture<double> inner{{{1.0, HenyeyGreenstein<double>{0.2}}, {1.0, HenyeyGreenstein<double>{0.4}}}};
  const Law<double> nested = Mixture<double>{{{1.0, inner}, {2.0, Isotropic<double>{}}}};
  const LobeSum<double> lobes = lower(nested);
  ASSERT_EQ(lobes.size(), 3U);
  EXPECT_NEAR(lobes[0].weight, 1.0 / 6.0, 1e-15);
  EXPECT_NEAR(lobes[1].weight, 1.0 / 6.0, 1e-15);
  EXPECT_NEAR(lobes[2].weight, 2.0 / 3.0, 1e-15);
}

TEST(MergedLobes, KeepEachLobeOnceWhereItFirstStood) {
  using Forward = HenyeyGreensteinLobe<double>;
  const LobeSum<double> sum = merged(LobeSum<double>{{0.125, Forward::of(0.5)},
                                                     {0.25, PowerLobe<double>{8}},
                                                     {0.0625, RayleighLobe<double>{0.5}},
                                                     {0.25, Forward::of(0.5)},
                                                     {0.0625, IsotropicLobe<double>{}},
                                                     {0.125, PowerLobe<double>{8}},
                                                     {0.125, IsotropicLobe<double>{}}});
  ASSERT_EQ(sum.size(), 4U);
  EXPECT_EQ(std::get<Forward>(sum[0].lobe).g, 0.5);
  EXPECT_EQ(sum[0].weight, 0.375);
  EXPECT_EQ(std::get<PowerLobe<double>>(sum[1].lobe).n, 8);
  EXPECT_EQ(sum[1].weight, 0.375);
  EXPECT_EQ(std::get<RayleighLobe<double>>(sum[2].lobe).gamma, 0.5);
  EXPECT_EQ(sum[2].weight, 0.0625);
  EXPECT_TRUE(std::holds_alternative<IsotropicLobe<double>>(sum[3].lobe));
  EXPECT_EQ(sum[3].weight, 0.1875);
}

TEST(MergedLobes, LeaveApartWhatDiffersInTheLastBit) {
  using Forward = HenyeyGreensteinLobe<double>;
  const LobeSum<double> sum{{0.25, Forward::of(0.5)},
                            {0.25, Forward::of(std::nextafter(0.5, 1.0))},
                            {0.25, RayleighLobe<double>{0.5}},
                            {0.25, Forward::of(-0.5)}};
  EXPECT_EQ(merged(sum).size(), 4U);
  EXPECT_EQ(merged(LobeSum<double>{{0.5, Forward::of(0.0)}, {0.5, Forward::of(-0.0)}}).size(), 1U);
  EXPECT_TRUE(merged(LobeSum<double>{}).empty());
}

TEST(MergedLobes, ScatterAsEveryLawDidBefore) {
  for (const Law<double>& law : law_cases<Mixture<double>>()) {
    SCOPED_TRACE(words(law));
    const LobeSum<double> all = lower(law), few = merged(all);
    EXPECT_LE(few.size(), all.size());
    for (const Deflection<double>& d : test_deflections()) {
      EXPECT_NEAR(density(few, d), density(all, d), 1e-14 * density(all, d));
      EXPECT_NEAR(survival(few, d), survival(all, d), 1e-14 * survival(all, d));
    }
  }
}

TEST(Deflection, CarriesItsEndsWithAllTheirDigits) {
  const auto nearly_straight = Deflection<float>::from_angle(1e-4F);
  EXPECT_NEAR(static_cast<double>(nearly_straight.one_minus), 5e-9, 5e-9 * 3e-7);
  EXPECT_EQ(nearly_straight.mu, 1.0F);
  EXPECT_NEAR(static_cast<double>(nearly_straight.sine()), 1e-4, 1e-4 * 3e-7);
}

}  // namespace
}  // namespace tyndall
