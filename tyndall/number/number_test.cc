// What a number must do, for Dual and Symbol against double; the elementary texts that shaders get.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tyndall/number/dual.h"
#include "tyndall/number/elementary.h"
#include "tyndall/number/every_operation_test.h"
#include "tyndall/number/field.h"
#include "tyndall/number/instruction_set.h"
#include "tyndall/number/symbol_value.h"

namespace tyndall {
namespace {

TEST(Dual, CarriesTheDerivativeThroughEveryOperation) {
  using D = Dual<double, 2>;
  for (const double a : {0.3, 1.7}) {
    for (const double b : {0.8, 2.5}) {
      const std::vector<D> found = every_operation(D::parameter(a, 0), D::parameter(b, 1));
      const std::vector<double> at = every_operation(a, b);
      const double h = 1e-5;
      for (std::size_t i = 0; i < at.size(); ++i) {
        EXPECT_DOUBLE_EQ(found[i].value, at[i]) << i;
        const double by_a = (every_operation(a + h, b)[i] - every_operation(a - h, b)[i]) / (2.0 * h);
        const double by_b = (every_operation(a, b + h)[i] - every_operation(a, b - h)[i]) / (2.0 * h);
        EXPECT_NEAR(found[i].derivative[0], by_a, 1e-8 * (1.0 + std::fabs(by_a))) << i;
        EXPECT_NEAR(found[i].derivative[1], by_b, 1e-8 * (1.0 + std::fabs(by_b))) << i;
      }
    }
  }
}

TEST(Dual, AConstantHasNoDerivative) {
  const Dual<float, 3> constant(2.5);
  EXPECT_EQ(constant.value, 2.5F);
  EXPECT_EQ(constant.derivative, (std::array<float, 3>{}));
}

TEST(ConstantArray, IsSearchedAtKnotsBetweenThemAndOutside) {
  const SharedArray array = constant_array("a", {9.0, 9.0, -3.0, 1.0, 1.0, 2.0, 5.0, 8.0, -9.0});
  const std::vector<double> stretch(array->values().begin() + 2, array->values().begin() + 8);
  for (std::size_t last = 0; last < stretch.size(); ++last) {
    for (double key = -5.0; key < 10.0; key += 0.5) {
      std::size_t expected = 0;
      for (std::size_t i = 0; i <= last; ++i)
        if (stretch[i] <= key) expected = i;
      EXPECT_EQ(last_not_above(array, 2.0, last, key), static_cast<double>(expected)) << last << ", " << key;
      EXPECT_EQ(last_not_above(array, 2.0F, last, static_cast<float>(key)), static_cast<float>(expected));
    }
  }
}

TEST(Symbol, RemembersEveryOperation) {
  const std::vector<Symbol> recorded = every_operation(Symbol::input("a"), Symbol::input("b"));
  for (const double a : {0.3, 1.7}) {
    for (const double b : {0.8, 2.5}) {
      const SymbolValue value({{"a", a}, {"b", b}});
      const std::vector<double> expected = every_operation(a, b);
      for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_DOUBLE_EQ(value(recorded[i]), expected[i]) << i;
    }
  }
}

TEST(Symbol, CopiesShareTheirNodes) {
  const Symbol x = Symbol::input("x");
  const Symbol y = exp(x);
  const Symbol copy = y;
  EXPECT_EQ(&copy.node(), &y.node());
  EXPECT_EQ(&y.node().operands[0].node(), &x.node());
}

TEST(Symbol, RunsALoopsBodyOnceHoweverOftenItTurns) {
  int runs = 0;
  const auto body = [&](const std::array<Symbol, 1>& state) -> std::array<Symbol, 1> {
    ++runs;
    return {state[0] * 2.0};
  };
  const std::array<Symbol, 1> doubled = iterate(10, std::array<Symbol, 1>{Symbol::input("x")}, body);
  EXPECT_EQ(runs, 1);
  EXPECT_EQ(SymbolValue({{"x", 3.0}})(doubled[0]), 3072.0);
}

TEST(Symbol, MembersOfATripleAreInputsOfTheirOwn) {
  const Symbol sum = Symbol::input("d", 0) + 10.0 * Symbol::input("d", 2);
  EXPECT_EQ(SymbolValue({{"d.0", 1.0}, {"d.2", 2.0}})(sum), 21.0);
  EXPECT_TRUE(std::isnan(SymbolValue({{"d.0", 1.0}})(sum)));
}

// The promise of elementary.h, in float. (Shaders are compared in export/law_functions_test.cc.)
TEST(Elementary, KeepsItsDigitsInFloat) {
  const auto check = [](const char* name, float x, float found, double exact) {
    EXPECT_NEAR(static_cast<double>(found), exact, 3e-7 * std::fabs(exact)) << name << " at " << x;
  };
  for (double size = 1e-18; size < 80.0; size *= 1.013) {
    for (const double sign : {1.0, -1.0}) {
      const float x = static_cast<float>(sign * size);
      const double exact = static_cast<double>(x);
      check("expm1", x, expm1_from_exp(x), std::expm1(exact));
      check("sinh", x, sinh_from_exp(x), std::sinh(exact));
      check("asinh", x, asinh_from_log(x), std::asinh(exact));
      check("cbrt", x, cbrt_from_exp(x), std::cbrt(exact));
    }
  }
  EXPECT_EQ(expm1_from_exp(0.0F), 0.0F);
  EXPECT_EQ(sinh_from_exp(0.0F), 0.0F);
  EXPECT_EQ(asinh_from_log(0.0F), 0.0F);
  EXPECT_EQ(cbrt_from_exp(0.0F), 0.0F);
}

extern "C" {
void lanes_check_baseline(const float*, const float*, float*, std::size_t);
void lanes_check_avx2(const float*, const float*, float*, std::size_t);
void lanes_check_avx512(const float*, const float*, float*, std::size_t);
void lane_functions_check_baseline(const float*, const float*, float*, std::size_t);
void lane_functions_check_avx2(const float*, const float*, float*, std::size_t);
void lane_functions_check_avx512(const float*, const float*, float*, std::size_t);
}

TEST(Lanes, ComputeWhatFloatComputes) {
  constexpr std::size_t count = 64;  // a multiple of every lane count
  alignas(64) float a[count], b[count];
  for (std::size_t i = 0; i < count; ++i) {
    a[i] = 1e-4F * std::exp2(0.23F * static_cast<float>(i));
    b[i] = 0.7F + 0.01F * static_cast<float>((i * 37) % count);
  }
  for (const InstructionSet set : {InstructionSet::baseline, InstructionSet::avx2, InstructionSet::avx512}) {
    if (set > best_instruction_set()) continue;
    const std::size_t operations = every_operation(a[0], b[0]).size();
    std::vector<float> found(count * operations);
    choose_kernel(set, lanes_check_baseline, lanes_check_avx2, lanes_check_avx512)(a, b, found.data(), count);
    for (std::size_t i = 0; i < count; ++i) {
      const auto expected = every_operation(static_cast<double>(a[i]), static_cast<double>(b[i]));
      for (std::size_t k = 0; k < operations; ++k) {
        EXPECT_NEAR(static_cast<double>(found[k * count + i]), expected[k], 1e-6 * std::fabs(expected[k]))
            << name_of(set) << ", operation " << k << " of " << a[i] << ", " << b[i];
      }
    }
  }
}

// Ours where xsimd's are slow or missing, over all of float: overflow, underflow, both sides of 0 and of 1.
TEST(Lanes, PairsHaveTheirFunctionsWithAllDigits) {
  std::vector<float> x, y;
  for (double size = 1e-9; size < 87.0; size *= 1.03) {
    for (const double sign : {1.0, -1.0}) {
      x.push_back(static_cast<float>(sign * size));
      const double shift = size < 0.5 ? 1.0 + sign * size : std::exp(sign * size);
      y.push_back(static_cast<float>(shift));
    }
  }
  while (x.size() % 32 != 0) {
    x.push_back(0.5F);
    y.push_back(1.0F);
  }
  const std::size_t count = x.size(), operations = every_operation(1.0F, 1.0F).size();
  const auto exactly = [](float value) { return static_cast<double>(value); };
  for (const InstructionSet set : {InstructionSet::baseline, InstructionSet::avx2, InstructionSet::avx512}) {
    if (set > best_instruction_set()) continue;
    std::vector<float> found(count * (7 + operations));
    choose_kernel(set, lane_functions_check_baseline, lane_functions_check_avx2, lane_functions_check_avx512)(
        x.data(), y.data(), found.data(), count);
    for (std::size_t i = 0; i < count; ++i) {
      SCOPED_TRACE(std::string(name_of(set)) + ", x = " + std::to_string(x[i]) + ", y = " + std::to_string(y[i]));
      const auto result = [&](std::size_t k) { return exactly(found[k * count + i]); };
      const auto near = [&](std::size_t k, double expected, double error) {
        EXPECT_NEAR(result(k), expected, error * std::fabs(expected)) << "function " << k;
      };
      near(0, std::exp(exactly(x[i])), 2e-7);
      near(1, std::expm1(exactly(x[i])), 3e-7);
      near(2, std::log(exactly(y[i])), 3e-7);
      near(3, std::exp(exactly(x[i])), 1e-4);
      EXPECT_NEAR(result(4), std::log(exactly(y[i])), 2e-5);
      if (set != InstructionSet::baseline) {  // which has no fused multiply-add
        EXPECT_EQ(result(5), exactly(std::fma(x[i], y[i], -(x[i] * y[i]))));
      }
      const double row = std::clamp(std::floor(exactly(x[i])), -12.0, 19.0);
      EXPECT_EQ(result(6), row * row);
      if (std::fabs(x[i]) > 20.0F || y[i] > 1e3F) continue;  // where every_operation() may overflow
      const auto expected = every_operation(std::fabs(exactly(x[i])), exactly(y[i] + 1.0F));
      for (std::size_t k = 0; k < operations; ++k) {
        EXPECT_NEAR(result(7 + k), expected[k], 2e-6 * std::fabs(expected[k]) + 1e-30) << "operation " << k;
      }
    }
  }
}

TEST(Range, AnOpenEndIsOutside) {
  const Range open{-1.0, 1.0, true, true};
  EXPECT_FALSE(open.contains(-1.0));
  EXPECT_FALSE(open.contains(1.0));
  EXPECT_TRUE(open.contains(0.999999));
  EXPECT_TRUE(unit_interval.contains(0.0));
  EXPECT_TRUE(unit_interval.contains(1.0));
  EXPECT_FALSE(unit_interval.contains(std::nextafter(1.0, 2.0)));
  EXPECT_FALSE(positive.contains(0.0));
  EXPECT_TRUE(not_negative.contains(0.0));
  EXPECT_FALSE(any_number.contains(std::nan("")));
}

struct Described {
  double first{1.0};
  std::string second;
  static constexpr auto fields() {
    return std::tuple{Field{"first", &Described::first, positive, "m", "A length.", Scaling::length},
                      Field{"second", &Described::second}};
  }
};

TEST(Field, ListsWhatAStructHoldsInOrder) {
  std::vector<std::string> names;
  for_each_field<Described>([&](const auto& field) { names.emplace_back(field.name); });
  EXPECT_EQ(names, (std::vector<std::string>{"first", "second"}));
  constexpr auto first = std::get<0>(Described::fields());
  static_assert(first.scaling == Scaling::length && first.unit == "m" && first.range.low == 0.0);
  Described owner;
  owner.*(first.member) = 5.0;
  EXPECT_EQ(owner.first, 5.0);
}

}  // namespace
}  // namespace tyndall
