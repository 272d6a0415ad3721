// Samples are distributed as the density says: chi-square over a million of them, hard parameters included.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "tyndall/phase/law_as.h"
#include "tyndall/phase/law_cases_test.h"
#include "tyndall/phase/law_suites_test.h"
#include "tyndall/phase/sphere_integral_test.h"

namespace tyndall {
namespace {

constexpr int bins = 128;

// Probability between two log-odds by integrating the density alone (Gauss-Legendre, 5 points on pieces of 1/64), so
// that neither the cumulative distribution nor its inverse is its own judge.
double probability(const LobeSum<double>& lobes, double from, double to) {
  static constexpr double node[3] = {0.0, 0.5384693101056831, 0.9061798459386640};
  static constexpr double weight[3] = {0.5688888888888889, 0.4786286704993665, 0.2369268850561891};
  const auto slope = [&](double s) {
    const Deflection<double> d = at_log_odds(s);
    return std::numbers::pi * density(lobes, d) * d.one_minus * d.one_plus;
  };
  const int pieces = 1 + static_cast<int>((to - from) * 64.0);
  const double half = 0.5 * (to - from) / pieces;
  double sum = 0.0;
  for (int i = 0; i < pieces; ++i) {
    const double middle = from + (2 * i + 1) * half;
    sum += weight[0] * slope(middle);
    for (int k = 1; k < 3; ++k) sum += weight[k] * (slope(middle - half * node[k]) + slope(middle + half * node[k]));
  }
  return sum * half;
}

// The chi-square value that `degrees` degrees of freedom exceed once in a million (Wilson and Hilferty 1931).
double one_in_a_million(int degrees) {
  const double z = 4.7534, part = 2.0 / (9.0 * degrees);
  return degrees * std::pow(1.0 - part + z * std::sqrt(part), 3);
}

// Cuts the log-odds where a bin holds about 1/128 of the samples, tails open.
std::vector<double> cuts(const Law<double>& law) {
  std::vector<double> out;
  for (int i = 1; i < bins; ++i) {
    const Deflection<double> d = sample(law, static_cast<double>(i) / bins);
    const double s = std::log(d.one_plus / d.one_minus);
    if (out.empty() || s > out.back() + 1e-3) out.push_back(s);
  }
  return out;
}

void expect_chi_square(const Law<double>& law, int count) {
  // Lowered once: tables are long.
  const Law<float> in_float = law_as<float>(law);
  const LobeSum<float> lobes_in_float = lower(in_float);
  const LobeSum<double> lobes = lower(law);
  const auto inverse = [&](float xi) {
    return std::holds_alternative<Tabulated<float>>(in_float) ? sample(lobes_in_float, xi) : sample(in_float, xi);
  };
  const std::vector<double> edges = cuts(law);
  std::vector<int> found(edges.size() + 1);
  std::mt19937 random(20220711);
  for (int i = 0; i < count; ++i) {
    const float xi = (static_cast<float>(random() >> 9) + 0.5F) * 0x1p-23F;
    const Deflection<float> d = inverse(xi);
    const double s = std::log(static_cast<double>(d.one_plus) / static_cast<double>(d.one_minus));
    ++found[static_cast<std::size_t>(std::upper_bound(edges.begin(), edges.end(), s) - edges.begin())];
  }
  double chi_square = 0.0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const double from = i == 0 ? -60.0 : edges[i - 1], to = i == edges.size() ? 60.0 : edges[i];
    const double expected = count * probability(lobes, from, to);
    chi_square += (found[i] - expected) * (found[i] - expected) / expected;
  }
  EXPECT_LT(chi_square, one_in_a_million(static_cast<int>(edges.size())));
}

template <class L>
class SamplesOf : public ::testing::Test {};
TYPED_TEST_SUITE(SamplesOf, EveryLaw, LawNames);

// False alarm: once in a million per case if xi were redrawn; the seed is fixed.
TYPED_TEST(SamplesOf, FollowTheDensity) {
  // Laws that are inverted step by step take microseconds a sample: their later cases get fewer.
  constexpr bool slow = std::is_same_v<TypeParam, FournierForand<double>> ||
                        std::is_same_v<TypeParam, Droplet<double>> || std::is_same_v<TypeParam, Mixture<double>>;
  int cases = 0;
  for (const Law<double>& law : law_cases<TypeParam>()) {
    SCOPED_TRACE(words(law));
    expect_chi_square(law, slow && ++cases > 3 ? 100000 : 1000000);
  }
}

// Random mixtures of two to five lobes, g from -0.9999 to 0.9999 and weights over three decades: the fixed number of
// steps suffices in float and double.
TEST(SumInverse, ConvergesForRandomMixtures) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int i = 0; i < 20000; ++i) {
    LobeSum<double> lobes;
    double total = 0.0;
    for (int k = 2 + static_cast<int>(random() % 4); k > 0; --k) {
      const double weight = std::pow(10.0, -3.0 * unit(random)), complement = std::pow(10.0, -4.0 * unit(random));
      const int kind = static_cast<int>(random() % 6);
      Lobe<double> lobe = HenyeyGreensteinLobe<double>{kind == 5 ? complement - 1.0 : 1.0 - complement, complement};
      if (kind == 0) lobe = IsotropicLobe<double>{};
      if (kind == 1) lobe = RayleighLobe<double>{unit(random)};
      if (kind == 2) lobe = PowerLobe<double>{random() % 2 == 0 ? 8 : 32};
      lobes.push_back({weight, lobe});
      total += weight;
    }
    for (auto& part : lobes) part.weight /= total;
    const double u = unit(random), tail = std::pow(10.0, -7.0 * unit(random));
    const double xi = static_cast<double>(static_cast<float>(i % 3 == 0 ? u : i % 3 == 1 ? tail : 1.0 - tail));
    if (xi <= 0.0 || xi >= 1.0) continue;

    const Deflection<double> d = sample(lobes, xi);
    ASSERT_NEAR(cdf(lobes, d), xi, 4e-14 * xi) << "i = " << i;
    ASSERT_NEAR(survival(lobes, d), 1.0 - xi, 4e-14 * (1.0 - xi)) << "i = " << i;

    // u^33 multiplies the rounding of u to float by 33.
    const Deflection<float> in_float = sample(lobes_as<float>(lobes), static_cast<float>(xi));
    const auto found =
        Deflection<double>::from_ends(static_cast<double>(in_float.one_minus), static_cast<double>(in_float.one_plus));
    ASSERT_NEAR(cdf(lobes, found), xi, 4e-6 * xi) << "i = " << i;
    ASSERT_NEAR(survival(lobes, found), 1.0 - xi, 4e-6 * (1.0 - xi)) << "i = " << i;
  }
}

// Two lobes between whose steep sides Newton's method alone goes to and fro for ever.
TEST(SumInverse, IsNotCaughtBetweenTwoBends) {
  const LobeSum<double> lobes{{0.0073805131848160522, HenyeyGreensteinLobe<double>::of(0.99983041368207326)},
                              {0.98882670131684924, PowerLobe<double>{8}},
                              {0.0037927854983346404, RayleighLobe<double>{0.22461676179944928}}};
  for (double xi = 0.03; xi < 0.05; xi += 1e-4) EXPECT_NEAR(cdf(lobes, sample(lobes, xi)), xi, 1e-14);
}

}  // namespace
}  // namespace tyndall
