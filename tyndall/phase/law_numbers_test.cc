// Each law of the list in float, Dual and Symbol, against the same text in double. (Lanes: phase_kernels_test.cc.
// Printed and executed: export/law_functions_test.cc.)
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "tyndall/number/dual.h"
#include "tyndall/number/symbol_value.h"
#include "tyndall/phase/law_as.h"
#include "tyndall/phase/law_cases_test.h"
#include "tyndall/phase/law_suites_test.h"

namespace tyndall {
namespace {

template <class L>
class EachLawIn : public LawCasesTest<L> {};
TYPED_TEST_SUITE(EachLawIn, EveryLaw, LawNames);

template <class U>
Deflection<U> deflection_as(const Deflection<double>& d) {
  return {U(d.mu), U(d.one_minus), U(d.one_plus)};
}

TYPED_TEST(EachLawIn, FloatEqualsDoubleToAMillionth) {
  this->on_cases([](const Law<double>& law) {
    // As renderers do: parameters are prepared in double, then rounded.
    const LobeSum<float> lobes = lobes_as<float>(lower(law));
    for (const Deflection<double>& d : test_deflections()) {
      const Deflection<float> rounded = deflection_as<float>(d);
      const auto near = [&](float found, double expected, const char* what) {
        EXPECT_NEAR(static_cast<double>(found), expected, float_error(law) * expected)
            << what << " at 1 - mu = " << d.one_minus;
      };
      near(density(lobes, rounded), density(law, d), "density");
      near(cdf(lobes, rounded), cdf(law, d), "cdf");
      near(survival(lobes, rounded), survival(law, d), "survival");
    }
    for (int l = 0; l <= 8; ++l) EXPECT_NEAR(static_cast<double>(moment(lobes, l)), moment(law, l), float_error(law));
  });
}

// Where the lobes leave a gap in mu, the rounding of F to float moves the answer by that times the gap's steepness: the
// tolerance grows with d(log-odds of the answer) / d(log-odds of xi).
TYPED_TEST(EachLawIn, FloatSamplesWhatDoubleSamples) {
  this->on_cases([](const Law<double>& law) {
    const Law<float> in_float = law_as<float>(law);
    for (const double xi : test_xi()) {
      const Deflection<double> d = sample(law, xi);
      const Deflection<float> found = sample(in_float, static_cast<float>(xi));
      const double slope = std::numbers::pi * density(law, d) * d.one_minus * d.one_plus;
      const double condition = xi > 0.0 && xi < 1.0 ? std::max(1.0, xi * (1.0 - xi) / slope) : 1.0;
      EXPECT_NEAR(static_cast<double>(found.mu), d.mu, float_error(law) * condition) << "xi = " << xi;
      EXPECT_NEAR(static_cast<double>(found.one_minus), d.one_minus, float_error(law) * condition * d.one_minus)
          << "xi = " << xi;
      EXPECT_NEAR(static_cast<double>(found.one_plus), d.one_plus, float_error(law) * condition * d.one_plus)
          << "xi = " << xi;
    }
  });
}

TYPED_TEST(EachLawIn, FloatSamplesMonotonically) {
  this->on_cases([](const Law<double>& law) {
    const Law<float> in_float = law_as<float>(law);
    Deflection<float> before = sample(in_float, 0.0F);
    for (int i = 1; i <= 1024; ++i) {
      const Deflection<float> d = sample(in_float, static_cast<float>(i) / 1024.0F);
      // Strictly at the near end; at the far one, where mu is all but 1, to rounding.
      EXPECT_GE(d.one_plus, before.one_plus * (d.mu < 0.0F ? 1.0F : 1.0F - 1e-6F)) << i;
      EXPECT_LE(d.one_minus, before.one_minus * (d.mu > 0.0F ? 1.0F : 1.0F + 1e-6F)) << i;
      before = d;
    }
  });
}

// Everything a law gives, with the name of each value.
template <class T>
std::map<std::string, T> everything(const Law<T>& law, const Deflection<T>& d, const T& xi) {
  const Deflection<T> sampled = sample(law, xi);
  return {{"density", density(law, d)},         {"cdf", cdf(law, d)},
          {"survival", survival(law, d)},       {"sampled 1 - mu", sampled.one_minus},
          {"sampled 1 + mu", sampled.one_plus}, {"sampled mu", sampled.mu},
          {"mean cosine", mean_cosine(law)},    {"second moment", moment(law, 2)},
          {"fifth moment", moment(law, 5)}};
}

// Derivatives by each parameter of the law in turn, against central differences.
TYPED_TEST(EachLawIn, DualDifferentiatesByEachParameter) {
  using D = Dual<double>;
  this->on_cases([](const Law<double>& law) {
    std::vector<double> values;
    std::vector<std::string> names;
    law_as<double>(law, [&](const std::string& name, double x) {
      names.push_back(name);
      values.push_back(x);
      return x;
    });
    const auto d = Deflection<double>::from_angle(0.4);
    const double xi = 0.3;
    for (std::size_t k = 0; k < values.size(); ++k) {
      SCOPED_TRACE("by " + names[k]);
      std::size_t i = 0;
      const Law<D> dual =
          law_as<D>(law, [&](const std::string&, double x) { return i++ == k ? D::parameter(x) : D(x); });
      const auto moved = [&](double by) {
        std::size_t j = 0;
        const auto shifted = law_as<double>(law, [&](const std::string&, double x) { return j++ == k ? x + by : x; });
        return everything(shifted, d, xi);
      };
      // Near the end of a range the step must stay inside it.
      const double size = std::fabs(values[k]);
      const double h = 1e-5 * (size <= 1.0 ? std::max(1e-5, 1.0 - size) : 1.0);
      if (values[k] - h < 0.0 && std::holds_alternative<Rayleigh<double>>(law)) continue;  // an end: no centre
      if (names[k].find("weight") == 0 && values[k] < h) continue;
      const auto up = moved(h), down = moved(-h);
      for (const auto& [what, value] : everything(dual, deflection_as<D>(d), D(xi))) {
        const double expected = (up.at(what) - down.at(what)) / (2.0 * h);
        const double noise = 4e-16 * std::fabs(value.value) / h;
        EXPECT_NEAR(value.derivative[0], expected, 1e-6 * std::fabs(expected) + 4.0 * noise + 1e-9) << what;
      }
    }
  });
}

// dmu/dxi = 1 / (2 pi p) at the sampled deflection.
TYPED_TEST(EachLawIn, DualDifferentiatesSamplingByXi) {
  using D = Dual<double>;
  this->on_cases([](const Law<double>& law) {
    const Law<D> dual = law_as<D>(law);
    for (const double xi : {1e-4, 0.05, 0.3, 0.7, 0.95, 0.9999}) {
      const Deflection<D> d = sample(dual, D::parameter(xi));
      const Deflection<double> at{d.mu.value, d.one_minus.value, d.one_plus.value};
      const double expected = 1.0 / (2.0 * std::numbers::pi * density(law, at));
      EXPECT_NEAR(d.one_plus.derivative[0], expected, 1e-9 * expected + 1e-13) << "xi = " << xi;
      EXPECT_NEAR(d.one_minus.derivative[0], -expected, 1e-9 * expected + 1e-13) << "xi = " << xi;
    }
  });
}

// dp/dg = p [-2 g / (1 - g^2) - 3 (g - mu) / (1 + g^2 - 2 g mu)].
TEST(HenyeyGreensteinInDual, HasItsClosedDerivative) {
  using D = Dual<double>;
  for (const double g : {-0.9, -0.3, 0.0, 1e-6, 0.5, 0.95}) {
    for (double mu = -1.0; mu <= 1.0; mu += 0.125) {
      const Law<D> law = HenyeyGreenstein<D>{D::parameter(g)};
      const D p = density(law, deflection_as<D>(Deflection<double>::from_mu(mu)));
      const double closed = p.value * (-2.0 * g / (1.0 - g * g) - 3.0 * (g - mu) / (1.0 + g * g - 2.0 * g * mu));
      EXPECT_NEAR(p.derivative[0], closed, 1e-12 * (p.value + std::fabs(closed))) << "g = " << g << ", mu = " << mu;
    }
  }
}

// Laws whose text has more terms in double than in float.
bool has_series(const Law<double>& law) {
  if (const auto* mixture = std::get_if<Mixture<double>>(&law)) {
    return std::any_of(mixture->parts.begin(), mixture->parts.end(),
                       [](const auto& part) { return has_series(part.phase); });
  }
  return std::holds_alternative<Schlick<double>>(law) || std::holds_alternative<LambertSphere<double>>(law) ||
         std::holds_alternative<FournierForand<double>>(law);
}

TYPED_TEST(EachLawIn, SymbolRecordsTheWholeLaw) {
  this->on_cases([](const Law<double>& law) {
    std::map<std::string, double> inputs;
    const Law<Symbol> recorded = law_as<Symbol>(law, [&](const std::string& name, double x) {
      inputs[name] = x;
      return Symbol::input(name);
    });
    const Deflection<Symbol> given{Symbol::input("d", 0), Symbol::input("d", 1), Symbol::input("d", 2)};
    const auto symbols = everything(recorded, given, Symbol::input("xi"));
    const auto deflections = test_deflections();
    const auto xis = test_xi();
    for (std::size_t i = 0; i < deflections.size(); i += 5) {
      const Deflection<double>& d = deflections[i];
      const double xi = xis[(7 * i + 3) % xis.size()];
      inputs["d.0"] = d.mu;
      inputs["d.1"] = d.one_minus;
      inputs["d.2"] = d.one_plus;
      inputs["xi"] = xi;
      const SymbolValue value(inputs);
      const auto expected = everything(law, d, xi);
      for (const auto& [what, symbol] : symbols) {
        // A recorded sampler iterates as far as float needs, here in double; so do series.
        const double tolerance = has_series(law) ? 3e-7 : what.find("sampled") == 0 ? 1e-9 : 1e-13;
        const double exact = expected.at(what);
        EXPECT_NEAR(value(symbol), exact, tolerance * std::max(std::fabs(exact), what == "sampled mu" ? 1.0 : 0.0))
            << what << ", xi = " << xi;
      }
    }
  });
}

}  // namespace
}  // namespace tyndall
