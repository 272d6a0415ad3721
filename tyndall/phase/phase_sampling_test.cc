// Samples are distributed as the density says: chi-square and Kolmogorov's test over a million of them, ten million in
// soak, hard parameters included.
//
// False alarms: each case may fail three times in a million if its random numbers were drawn anew
// (sample_histogram_test.h), so the 214 cases together seven times in ten thousand, in soak thrice as often. Seeds are
// fixed, so that a run that passed passes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "tests/cases.h"
#include "tyndall/phase/law_as.h"
#include "tyndall/phase/law_cases_test.h"
#include "tyndall/phase/law_suites_test.h"
#include "tyndall/phase/phase_kernels.h"
#include "tyndall/phase/sample_histogram_test.h"

namespace tyndall {
namespace {

double rounded(double x) { return static_cast<double>(static_cast<float>(x)); }

// Beyond the cases of every test: peaks as narrow as droplets', both ways; Draine's two parameters together; both sides
// of each seam between the fits of droplets; the hardest corners of Fournier and Forand.
template <class L>
std::vector<Law<double>> sampling_cases() {
  std::vector<Law<double>> cases = law_cases<L>();
  if constexpr (requires(L law) { law.alpha; }) {
    for (const double g : {0.0, 1e-6, 0.02, 0.05, 0.3, -0.3, 0.9, -0.9946, 0.9999})
      for (const double alpha : {1.0, 30.0, 250.0}) cases.push_back(L{rounded(g), alpha});
  } else if constexpr (requires(L law) { law.g; }) {
    for (const double g : {1e-4, 0.02, -0.3, 0.9946, -0.9946, 0.9999, -0.9999}) cases.push_back(L{rounded(g)});
  } else if constexpr (requires(L law) { law.diameter; }) {
    for (const double d : {0.0899, 0.1, 0.1101, 1.349, 1.5, 1.651, 4.49, 4.81, 5.0, 5.51, 20.0})
      cases.push_back(L{rounded(d)});
  } else if constexpr (requires(L law) { law.slope; }) {
    for (const double n : {1.01, 1.05, 1.5})
      for (const double slope : {3.1, 4.0, 4.9}) cases.push_back(L{rounded(n), rounded(slope)});
  } else if constexpr (std::is_same_v<L, Tabulated<double>>) {
    Tabulated<double> rainbow{{0.0, 5.0, 60.0, 137.0, 139.0, 142.0, 180.0}, {}, {}};
    for (const double x : {900.0, 40.0, 1.0, 0.7, 2.0, 0.9, 1.5})
      rainbow.values.push_back(Spectrum{{x, std::sqrt(x), 1.0 + 0.5 * x}});
    cases.push_back(rainbow);
  }
  return cases;
}

// Random numbers as an engine has them: 23 bits, never 0 or 1.
float uniform(std::mt19937& random) { return (static_cast<float>(random() >> 9) + 0.5F) * 0x1p-23F; }

struct Samples {
  std::vector<float> xi, mu, one_minus, one_plus;
  explicit Samples(std::size_t count) : xi(count), mu(count), one_minus(count), one_plus(count) {}
  void draw(const PhaseArrays& arrays, std::mt19937& random) {
    for (float& x : xi) x = uniform(random);
    arrays.sample(xi, {mu, one_minus, one_plus});
  }
};

// The histogram of `count` samples drawn in Lanes.
SampleHistogram histogram(const Law<double>& drawn, const Law<double>& expected, InstructionSet set, int count,
                          unsigned seed) {
  const LobeSum<double> lobes = lower(expected);
  SampleHistogram out([&](const Deflection<double>& d) { return density(lobes, d); });
  const PhaseArrays arrays(lobes_as<float>(lower(drawn)), set);
  std::mt19937 random(seed);
  Samples samples(8000);
  for (int done = 0; done < count; done += 8000) {
    samples.draw(arrays, random);
    for (std::size_t i = 0; i < samples.xi.size(); ++i) out.add(samples.one_minus[i], samples.one_plus[i]);
  }
  return out;
}

// That double draws the same deflections from the same numbers, within what a float's rounding of xi makes of it.
void expect_the_same_in_double(const Law<double>& law, unsigned seed) {
  std::mt19937 random(seed);
  Samples samples(400);
  samples.draw(PhaseArrays(lobes_as<float>(lower(law))), random);
  const LobeSum<double> lobes = lower(law);
  for (std::size_t i = 0; i < samples.xi.size(); ++i) {
    const double xi = static_cast<double>(samples.xi[i]);
    const Deflection<double> d = sample(lobes, xi);
    const double slope = std::numbers::pi * density(lobes, d) * d.one_minus * d.one_plus;
    const double allowed = float_error(law) * std::max(1.0, xi * (1.0 - xi) / slope);
    EXPECT_NEAR(static_cast<double>(samples.one_minus[i]), d.one_minus, allowed * d.one_minus) << "xi = " << xi;
    EXPECT_NEAR(static_cast<double>(samples.one_plus[i]), d.one_plus, allowed * d.one_plus) << "xi = " << xi;
  }
}

// check(law of one channel, seed) on each case.
template <class L, class Check>
void on_sampling_cases(Check check) {
  // Numbers of its own for each law.
  unsigned seed = 20220711 + 1000 * static_cast<unsigned>(Law<double>(L{}).index());
  for (const Law<double>& law : sampling_cases<L>()) {
    for (std::size_t c = 0; c < (is_chromatic(law) ? channel_count : 1); ++c) {
      SCOPED_TRACE(words(law) + ", channel " + std::to_string(c));
      check(in_channel(law, c), ++seed);
    }
  }
}

std::string short_text(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2g", x);
  return text;
}

template <class L>
class SamplesOf : public ::testing::Test {};
TYPED_TEST_SUITE(SamplesOf, EveryLaw, LawNames);

TYPED_TEST(SamplesOf, FollowTheDensity) {
  std::vector<double> chances;
  double least_kolmogorov = 1.0;
  on_sampling_cases<TypeParam>([&](const Law<double>& law, unsigned seed) {
    const SampleHistogram found = histogram(law, law, best_instruction_set(), 1000000, seed);
    found.judge();
    chances.push_back(found.chi_square_probability());
    least_kolmogorov = std::min(least_kolmogorov, found.kolmogorov_probability());
  });
  // Together they must look like chances: faults too small for each case shift them all. Once in a million.
  std::sort(chances.begin(), chances.end());
  double distance = 0.0;
  for (std::size_t i = 0; i < chances.size(); ++i) {
    const double n = static_cast<double>(chances.size()), below = static_cast<double>(i) / n;
    distance = std::max({distance, chances[i] - below, below + 1.0 / n - chances[i]});
  }
  if (chances.size() >= 5) {
    EXPECT_GT(tests::kolmogorov_survival(distance, static_cast<double>(chances.size())), 1e-6);
  }
  this->RecordProperty("cases", static_cast<int>(chances.size()));  // for docs/accuracy.md
  this->RecordProperty("least_chi_square", short_text(chances.front()));
  this->RecordProperty("least_kolmogorov", short_text(least_kolmogorov));
}

TYPED_TEST(SamplesOf, AreTheSameInDouble) {
  on_sampling_cases<TypeParam>([](const Law<double>& law, unsigned seed) { expect_the_same_in_double(law, seed); });
}

template <class L>
class SoakSamplesOf : public ::testing::Test {};
TYPED_TEST_SUITE(SoakSamplesOf, EveryLaw, LawNames);

TYPED_TEST(SoakSamplesOf, FollowTheDensityInEveryInstructionSet) {
  int cases = 0;
  on_sampling_cases<TypeParam>([&](const Law<double>& law, unsigned seed) {
    for (const InstructionSet set : {InstructionSet::baseline, InstructionSet::avx2, InstructionSet::avx512}) {
      if (set > best_instruction_set()) continue;
      SCOPED_TRACE(name_of(set));
      histogram(law, law, set, 10000000, seed * 4 + static_cast<unsigned>(set)).judge();
      ++cases;
    }
  });
  tests::say_cases(cases, "cases of ten million samples");
}

// A judge that never condemns is none: laws off by a few parts in a hundred are told apart by a million samples.
TEST(SampleHistogram, CondemnsSamplesOfALawNearby) {
  using Pair = std::pair<Law<double>, Law<double>>;
  for (const auto& [drawn, expected] :
       {Pair{HenyeyGreenstein<double>{0.7}, HenyeyGreenstein<double>{0.707}},
        Pair{HenyeyGreenstein<double>{0.9946}, HenyeyGreenstein<double>{0.9948}},
        Pair{Isotropic<double>{}, HenyeyGreenstein<double>{0.01}},
        Pair{Draine<double>{0.3, 250.0}, Draine<double>{0.3, 60.0}},
        Pair{FournierForand<double>{1.1, 3.58}, FournierForand<double>{1.1, 3.59}},
        Pair{Droplet<double>{10.0}, Droplet<double>{10.5}}, Pair{MieMurky<double>{}, NishitaMurky<double>{}}}) {
    SCOPED_TRACE(words(drawn) + " against " + words(expected));
    const SampleHistogram found = histogram(drawn, expected, best_instruction_set(), 1000000, 5);
    EXPECT_LT(found.chi_square_probability(), 1e-6);
    EXPECT_LT(found.kolmogorov_probability(), 1e-6);
  }
}

// Tables: Abramowitz and Stegun 26.8; Smirnov (1948).
TEST(GoodnessOfFit, ProbabilitiesAreThoseOfTheTables) {
  EXPECT_NEAR(tests::chi_square_survival(18.307038, 10), 0.05, 1e-8);
  EXPECT_NEAR(tests::chi_square_survival(149.449253, 100), 0.001, 1e-9);
  EXPECT_NEAR(tests::chi_square_survival(67.327563, 100), 0.995, 1e-8);
  EXPECT_NEAR(tests::chi_square_survival(10.827566, 1), 0.001, 1e-9);
  EXPECT_NEAR(tests::kolmogorov_survival(1.3580986e-7, 1e14), 0.05, 1e-7);
  EXPECT_NEAR(tests::kolmogorov_survival(1.9494746e-7, 1e14), 0.001, 1e-7);
  EXPECT_NEAR(tests::kolmogorov_survival(0.5711732e-7, 1e14), 0.9, 1e-6);
  EXPECT_NEAR(tests::kolmogorov_survival(0.9999999e-7, 1e14), tests::kolmogorov_survival(1.0000001e-7, 1e14), 1e-6);
  EXPECT_NEAR(tests::kolmogorov_survival(0.56328, 5), 0.05, 1e-3);  // five samples, exactly
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
