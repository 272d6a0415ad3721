#pragma once
// Property tests: rapidcheck under gtest, the same cases in every run. What fails is shrunk to a small case and
// printed.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <optional>
#include <sstream>

#include "tests/cases.h"

namespace tyndall::tests {

/// Holds `property` (drawing with *generator, stating with RC_ASSERT) to `cases` random cases of a fixed seed.
template <class Property>
void expect_property(int cases, Property&& property) {
  rc::detail::TestParams params;
  params.seed = 1;
  params.maxSuccess = cases;
  params.maxDiscardRatio = 10;
  const rc::detail::TestResult result =
      rc::detail::checkTestable(std::forward<Property>(property), rc::detail::TestMetadata{}, params);
  if (result.template is<rc::detail::SuccessResult>()) return say_cases(cases, "random cases");
  std::ostringstream text;
  rc::detail::printResultMessage(result, text);
  ADD_FAILURE() << text.str();
}

/// A number of [low, high], ends included; shrinks towards low.
inline rc::Gen<double> real(double low, double high) {
  constexpr int steps = 1 << 20;
  return rc::gen::map(rc::gen::inRange(0, steps + 1), [=](int i) { return low + (high - low) * i / steps; });
}
/// A number spread evenly over magnitudes from low to high; shrinks towards low.
inline rc::Gen<double> magnitude(double low, double high) {
  return rc::gen::map(real(std::log(low), std::log(high)), [](double x) { return std::exp(x); });
}
/// None, or one of `some`.
template <class T>
rc::Gen<std::optional<T>> maybe(rc::Gen<T> some) {
  return rc::gen::oneOf(rc::gen::just(std::optional<T>()),
                        rc::gen::map(std::move(some), [](T x) { return std::optional<T>(std::move(x)); }));
}

}  // namespace tyndall::tests
