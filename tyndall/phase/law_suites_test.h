#pragma once
// Test suites over the list of laws: one typed test is run for every law there is.
#include <gtest/gtest.h>

#include <string>
#include <variant>

#include "tyndall/phase/law.h"
#include "tyndall/phase/law_cases_test.h"

namespace tyndall {

/// The alternatives of a variant as another list of types: ListOf<Law<double>, ::testing::Types>::Type.
template <class Variant, template <class...> class List>
struct ListOf;
template <class... L, template <class...> class List>
struct ListOf<std::variant<L...>, List> {
  using Type = List<L...>;
};

/// Names for test suites over the laws.
struct LawNames {
  template <class L>
  static std::string GetName(int) {
    return std::string(L::name);
  }
};

/// All laws, as a list of types to test.
using EveryLaw = ListOf<Law<double>, ::testing::Types>::Type;

template <class L>
class LawCasesTest : public ::testing::Test {
 protected:
  /// Runs a check on each hard case of the law.
  template <class Check>
  void on_cases(Check check) {
    for (const Law<double>& law : law_cases<L>()) {
      SCOPED_TRACE(words(law));
      check(law);
    }
  }
};

}  // namespace tyndall
