// Lanes: each law of the list through the kernel of each instruction set that this machine has, against double and
// against the same text in float.
#include "tyndall/phase/phase_kernels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tyndall/phase/law_as.h"
#include "tyndall/phase/law_cases_test.h"
#include "tyndall/phase/law_suites_test.h"

namespace tyndall {
namespace {

std::vector<InstructionSet> sets_here() {
  std::vector<InstructionSet> sets{InstructionSet::baseline};
  for (const InstructionSet set : {InstructionSet::avx2, InstructionSet::avx512})
    if (set <= best_instruction_set()) sets.push_back(set);
  return sets;
}

struct Arrays {
  std::vector<float> mu, one_minus, one_plus;
  explicit Arrays(std::size_t count = 0) : mu(count), one_minus(count), one_plus(count) {}
  DeflectionArrays given() const { return {mu, one_minus, one_plus}; }
  DeflectionResults found() { return {mu, one_minus, one_plus}; }
};

Arrays deflections() {
  Arrays out;
  for (const Deflection<double>& d : test_deflections()) {
    out.mu.push_back(static_cast<float>(d.mu));
    out.one_minus.push_back(static_cast<float>(d.one_minus));
    out.one_plus.push_back(static_cast<float>(d.one_plus));
  }
  return out;
}

template <class L>
class LanesOf : public ::testing::Test {
 protected:
  // check(law, lobes in float, set)
  template <class Check>
  void on_cases_and_sets(Check check) {
    for (const Law<double>& law : law_cases<L>()) {
      for (const InstructionSet set : sets_here()) {
        SCOPED_TRACE(words(law) + ", " + std::string(name_of(set)));
        check(law, lobes_as<float>(lower(law)), set);
      }
    }
  }
};
TYPED_TEST_SUITE(LanesOf, EveryLaw, LawNames);

TYPED_TEST(LanesOf, DensityAndCdfEqualTheReference) {
  this->on_cases_and_sets([](const Law<double>& law, const LobeSum<float>& lobes, InstructionSet set) {
    const auto exact = test_deflections();
    const Arrays at = deflections();
    const PhaseArrays arrays(lobes, set);
    std::vector<float> p(exact.size()), cumulated(exact.size());
    arrays.density(at.given(), p);
    arrays.cdf(at.given(), cumulated);
    for (std::size_t i = 0; i < exact.size(); ++i) {
      const double expected_p = density(law, exact[i]), expected_f = cdf(law, exact[i]);
      EXPECT_NEAR(static_cast<double>(p[i]), expected_p, float_error(law) * expected_p) << exact[i].one_minus;
      EXPECT_NEAR(static_cast<double>(cumulated[i]), expected_f, float_error(law) * expected_f) << exact[i].one_minus;
      const Deflection<float> d{at.mu[i], at.one_minus[i], at.one_plus[i]};
      const float scalar = density(lobes, d);
      EXPECT_NEAR(p[i], scalar, 0.4F * static_cast<float>(float_error(law)) * scalar);
    }
  });
}

TYPED_TEST(LanesOf, SamplesEqualTheReference) {
  this->on_cases_and_sets([](const Law<double>& law, const LobeSum<float>& lobes, InstructionSet set) {
    const std::vector<double> exact = test_xi();
    const std::vector<float> xi(exact.begin(), exact.end());
    Arrays found(xi.size());
    PhaseArrays(lobes, set).sample(xi, found.found());
    for (std::size_t i = 0; i < xi.size(); ++i) {
      SCOPED_TRACE("xi = " + std::to_string(exact[i]));
      const Deflection<double> d = sample(law, exact[i]);
      const double slope = std::numbers::pi * density(law, d) * d.one_minus * d.one_plus;
      const bool inside = exact[i] > 0.0 && exact[i] < 1.0;
      const double condition = inside ? std::max(1.0, exact[i] * (1.0 - exact[i]) / slope) : 1.0;
      EXPECT_NEAR(static_cast<double>(found.mu[i]), d.mu, float_error(law) * condition);
      EXPECT_NEAR(static_cast<double>(found.one_minus[i]), d.one_minus, float_error(law) * condition * d.one_minus);
      EXPECT_NEAR(static_cast<double>(found.one_plus[i]), d.one_plus, float_error(law) * condition * d.one_plus);
    }
  });
}

// Arrays of any length, not only full registers; nothing is written past the end.
TEST(Lanes, LeaveWhatIsPastTheEndAlone) {
  const LobeSum<float> lobes = lobes_as<float>(lower(Law<double>(HenyeyGreenstein<double>{0.5})));
  for (const InstructionSet set : sets_here()) {
    const PhaseArrays arrays(lobes, set);
    for (std::size_t count = 0; count <= 70; ++count) {
      std::vector<float> xi(count);
      for (std::size_t i = 0; i < count; ++i) xi[i] = (static_cast<float>(i) + 0.5F) / 70.0F;
      Arrays found(count + 1);
      std::vector<float> p(count + 1, -5.0F);
      found.mu[count] = found.one_minus[count] = found.one_plus[count] = -5.0F;
      arrays.sample(xi, {std::span(found.mu).first(count), std::span(found.one_minus).first(count),
                         std::span(found.one_plus).first(count)});
      arrays.density({std::span(found.mu).first(count), std::span(found.one_minus).first(count),
                      std::span(found.one_plus).first(count)},
                     std::span(p).first(count));
      EXPECT_EQ(found.mu[count], -5.0F);
      EXPECT_EQ(found.one_minus[count], -5.0F);
      EXPECT_EQ(found.one_plus[count], -5.0F);
      EXPECT_EQ(p[count], -5.0F);
      for (std::size_t i = 0; i < count; ++i) {
        const Deflection<float> d{found.mu[i], found.one_minus[i], found.one_plus[i]};
        EXPECT_NEAR(p[i], density(lobes, d), 4e-7F * p[i]);
        EXPECT_NEAR(cdf(lobes, d), xi[i], 1e-6F);
      }
    }
  }
}

}  // namespace
}  // namespace tyndall
