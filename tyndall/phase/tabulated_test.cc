// The tabulated law beyond what every law promises: how near a table comes to what it was taken from, gaps, size.
#include "tyndall/phase/tabulated.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tyndall/number/symbol_value.h"
#include "tyndall/phase/law_as.h"
#include "tyndall/phase/law_cases_test.h"
#include "tyndall/phase/merged_lobes.h"
#include "tyndall/phase/sphere_integral_test.h"

namespace tyndall {
namespace {

Tabulated<double> table(std::vector<double> angles, const std::vector<double>& values) {
  Tabulated<double> out{std::move(angles), {}, {}};
  for (const double x : values) out.values.push_back(Spectrum::grey(x));
  return out;
}

// A law's own values at `count` angles, even in the logarithm of the angle from `smallest` degrees on.
Tabulated<double> taken_from(const Law<double>& law, int count, double smallest) {
  std::vector<double> angles{0.0}, values;
  for (int i = 0; i + 2 < count; ++i) angles.push_back(smallest * std::pow(180.0 / smallest, i / (count - 2.0)));
  angles.push_back(180.0);
  for (const double angle : angles)
    values.push_back(density(law, Deflection<double>::from_angle(angle * std::acos(-1.0) / 180.0)));
  return table(angles, values);
}

double worst_error(const Law<double>& found, const Law<double>& exact, double from_degrees) {
  const LobeSum<double> lobes = lower(found);
  double worst = 0.0;
  for (double angle = from_degrees; angle < 180.0; angle *= 1.003) {
    const auto d = Deflection<double>::from_angle(angle * std::acos(-1.0) / 180.0);
    worst = std::max(worst, std::fabs(density(lobes, d) / density(exact, d) - 1.0));
  }
  return worst;
}

TEST(Tabulated, ComesNearerWithTheSquareOfTheNumberOfKnots) {
  for (const double g : {0.5, 0.9, 0.99}) {
    const Law<double> exact = HenyeyGreenstein<double>{g};
    double before = 0.0;
    for (const int count : {64, 128, 256, 512}) {
      const double error = worst_error(taken_from(exact, count, 2.0 * (1.0 - g)), exact, 0.01 * (1.0 - g));
      if (before > 0.0) {
        EXPECT_NEAR(before / error, 4.0, 0.5) << g << ", " << count;
      }
      before = error;
    }
    EXPECT_LT(before, 4e-4) << g;
  }
}

TEST(Tabulated, HasTheMomentsOfWhatItWasTakenFrom) {
  const Law<double> law = taken_from(HenyeyGreenstein<double>{0.9}, 20000, 0.01);
  const std::vector<double> all = moments(lower(law), 150);
  for (std::size_t l = 0; l < all.size(); ++l)
    EXPECT_NEAR(all[l], std::pow(0.9, static_cast<double>(l)), 2e-6) << "l = " << l;
}

TEST(Tabulated, IsNormalisedWhateverTheScaleAndTheSize) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (const std::size_t count : {2, 3, 1000, 100000}) {
    for (const double scale : {1e-300, 1.0, 1e300}) {
      std::vector<double> angles, values;
      for (std::size_t i = 0; i < count; ++i) {
        angles.push_back(180.0 * (static_cast<double>(i) + unit(random)) / static_cast<double>(count));
        values.push_back(scale * std::pow(10.0, -4.0 * unit(random)));
      }
      const Law<double> law = table(angles, values);
      const LobeSum<double> lobes = lower(law);
      const auto p = [&](const Deflection<double>& d) { return density(lobes, d); };
      EXPECT_NEAR(integral_over_sphere(kinks_of(law), p), 1.0, 1e-12) << count << " knots";
      double before = -1.0;
      for (int i = 0; i <= 5000; ++i) {
        const double xi = i / 5000.0;
        const Deflection<double> d = sample(lobes, xi);
        EXPECT_NEAR(cdf(lobes, d), xi, 2e-14 * xi);
        EXPECT_GE(d.mu, before);
        before = d.mu;
      }
    }
  }
}

TEST(Tabulated, HoldsItsFirstAndLastValue) {
  const Law<double> law = table({30.0, 120.0}, {5.0, 2.0});
  const auto at = [&](double degrees) {
    return density(law, Deflection<double>::from_angle(degrees * std::acos(-1.0) / 180.0));
  };
  EXPECT_NEAR(at(1.0), at(30.0), 1e-15);
  EXPECT_NEAR(at(179.0), at(120.0), 1e-15);
  EXPECT_NEAR(at(30.0) / at(120.0), 2.5, 1e-13);
}

TEST(Tabulated, NeverScattersIntoAGap) {
  const Law<double> law = table({0.0, 40.0, 50.0, 80.0, 90.0, 170.0, 180.0}, {9.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0});
  const LobeSum<double> lobes = lower(law);
  const double low = std::cos(80.0 * std::acos(-1.0) / 180.0), high = std::cos(50.0 * std::acos(-1.0) / 180.0);
  const double back = std::cos(170.0 * std::acos(-1.0) / 180.0);
  EXPECT_EQ(sample(lobes, 0.0).mu, -1.0);
  Deflection<double> before = sample(lobes, 0.0);
  for (int i = 1; i <= 20000; ++i) {
    const double xi = i / 20000.0;
    const Deflection<double> d = sample(lobes, xi);
    EXPECT_TRUE(d.mu >= back - 1e-15 && (d.mu <= low + 1e-12 || d.mu >= high - 1e-12)) << d.mu;
    EXPECT_NEAR(cdf(lobes, d), xi, 2e-14);
    EXPECT_GE(d.one_plus, before.one_plus);
    EXPECT_LE(d.one_minus, before.one_minus);
    before = d;
  }
  EXPECT_EQ(density(lobes, Deflection<double>::from_angle(1.1)), 0.0);
}

// Kolmogorov's distance of a million float samples from uniform, seen through the distribution in double. False alarm:
// 2 e^(-2 x^2) with x = 2.7, once in a million if the seed changed.
TEST(Tabulated, FloatSamplesHaveTheRightDistribution) {
  constexpr std::size_t count = 1000000;
  for (const Law<double>& law : law_cases<Tabulated<double>>()) {
    SCOPED_TRACE(words(law));
    const LobeSum<double> lobes = lower(law);
    const LobeSum<float> in_float = lobes_as<float>(lobes);
    std::mt19937 random(20261123);
    std::vector<double> found(count);
    for (double& f : found) {
      const Deflection<float> d = sample(in_float, (static_cast<float>(random() >> 9) + 0.5F) * 0x1p-23F);
      f = cdf(lobes, Deflection<double>{static_cast<double>(d.mu), static_cast<double>(d.one_minus),
                                        static_cast<double>(d.one_plus)});
    }
    std::sort(found.begin(), found.end());
    double distance = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      const double step = static_cast<double>(i) / count;
      distance = std::max({distance, found[i] - step, step + 1.0 / count - found[i]});
    }
    EXPECT_LT(distance, 2.7 / std::sqrt(static_cast<double>(count)));
  }
}

TEST(Tabulated, KeepsThePeakInFloat) {
  const Law<double> law = taken_from(HenyeyGreenstein<double>{0.9999}, 400, 1e-4);
  const LobeSum<float> lobes = lobes_as<float>(lower(law));
  for (const float y : {1e-7F, 1e-5F, 1e-3F, 0.1F}) {
    const double one_minus = static_cast<double>(sample(lobes, 1.0F - y).one_minus);
    const double exact = sample(lower(law), static_cast<double>(1.0F - y)).one_minus;
    EXPECT_NEAR(one_minus, exact, 2e-6 * exact) << y;
  }
}

// What the shaders' table leaves out is at most what it says, everywhere between the knots too, and little.
TEST(Tabulated, SaysWhatItsShadersLeaveOut) {
  const Law<double> exact = HenyeyGreenstein<double>{0.97};
  const Tabulated<double> big = taken_from(exact, 5000, 0.01);
  const Law<Symbol> recorded = law_as<Symbol>(Law<double>(big));
  const double stated = std::get<Tabulated<Symbol>>(recorded).thinning_error(0);
  EXPECT_GT(stated, 0.0);
  EXPECT_LT(stated, 5e-4);
  const auto lobe = std::get<TableLobe<Symbol>>(lower(recorded).front().lobe);
  EXPECT_EQ(lobe.table->size(), 512U);
  const LobeSum<double> thin{{1.0, TableLobe<double>{lobe.table}}}, all = lower(Law<double>(big));
  double worst = 0.0;
  for (double angle = 0.001; angle < 180.0; angle *= 1.0007) {
    const auto d = Deflection<double>::from_angle(angle * std::acos(-1.0) / 180.0);
    const double scale = std::max(density(all, d), 1e-3 / (4.0 * std::acos(-1.0)));
    worst = std::max(worst, std::fabs(density(thin, d) - density(all, d)) / scale);
  }
  EXPECT_LE(worst, stated * (1.0 + 1e-9));
  EXPECT_GT(worst, 0.8 * stated);
  EXPECT_EQ(big.thinning_error(0), 0.0);
}

TEST(Tabulated, OfValuesPerChannelIsTheMeanOfItsChannels) {
  Tabulated<double> colored{{0.0, 60.0, 180.0}, {{{9.0, 4.0, 1.0}}, {{1.0, 2.0, 1.0}}, {{0.5, 1.0, 1.0}}}, {}};
  ASSERT_TRUE(colored.is_chromatic());
  const auto d = Deflection<double>::from_angle(0.7);
  double sum = 0.0;
  for (std::size_t c = 0; c < channel_count; ++c) {
    EXPECT_FALSE(colored.in_channel(c).is_chromatic());
    sum += density(Law<double>(colored.in_channel(c)), d);
  }
  EXPECT_NEAR(density(Law<double>(colored), d), sum / 3.0, 1e-15);
}

TEST(Tabulated, LobesAreMergedByContent) {
  const Law<double> a = table({0.0, 90.0, 180.0}, {3.0, 1.0, 2.0}), scaled = table({0.0, 90.0, 180.0}, {6.0, 2.0, 4.0});
  const Law<double> b = table({0.0, 90.0, 180.0}, {3.0, 1.0, 2.5});
  const Mixture<double> mixture{{{1.0, a}, {1.0, b}, {1.0, scaled}, {1.0, Isotropic<double>{}}}};
  EXPECT_EQ(merged(lower(Law<double>(mixture))).size(), 3U);
}

TEST(Tabulated, SaysWhatIsWrongWithIt) {
  const auto flaw = [](std::vector<double> angles, const std::vector<double>& values) {
    return flaw_of(table(std::move(angles), values));
  };
  EXPECT_FALSE(flaw({0.0, 180.0}, {1.0, 0.0}));
  EXPECT_TRUE(flaw({}, {})->whole);
  EXPECT_TRUE(flaw({0.0}, {1.0})->whole);
  EXPECT_TRUE(flaw({0.0, 1.0}, {0.0, 0.0})->whole);
  EXPECT_EQ(flaw({0.0, 50.0, 50.0}, {1.0, 1.0, 1.0})->knot, 2U);
  EXPECT_EQ(flaw({0.0, 50.0, 40.0}, {1.0, 1.0, 1.0})->knot, 2U);
  EXPECT_EQ(flaw({0.0, 50.0, 181.0}, {1.0, 1.0, 1.0})->knot, 2U);
  EXPECT_EQ(flaw({0.0, std::nan("")}, {1.0, 1.0})->knot, 1U);
  EXPECT_EQ(flaw({0.0, 1.0}, {1.0, -1.0})->channel, 0U);
  EXPECT_EQ(flaw({0.0, 1.0}, {std::nan(""), 1.0})->knot, 0U);
  EXPECT_EQ(flaw({0.0, 1.0}, {1.0, HUGE_VAL})->knot, 1U);
  std::vector<double> many(most_table_knots + 1), ones(most_table_knots + 1, 1.0);
  for (std::size_t i = 0; i < many.size(); ++i) many[i] = 180.0 * static_cast<double>(i) / most_table_knots;
  EXPECT_TRUE(flaw(many, ones)->whole);
}

}  // namespace
}  // namespace tyndall
