// How far each law of the list is from the truth, in the numbers that C++ computes with; JSON lines for accuracy.py.
//   g++ -std=c++20 -O2 -ffp-contract=off -I. scripts/law_accuracy.cc -o law_accuracy && ./law_accuracy
// Lanes are those of the instruction set it is compiled for (-march=x86-64-v3, ...). The cases are those of the tests.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>
#include <string>

#include "tyndall/number/dual.h"
#include "tyndall/number/lanes.h"
#include "tyndall/number/symbol_value.h"
#include "tyndall/phase/law_as.h"
#include "tyndall/phase/law_cases_test.h"
#include "tyndall/phase/sphere_integral_test.h"

namespace tyndall {
namespace {

double lane(float x) { return static_cast<double>(x); }
double lane(double x) { return x; }
double lane(const Lanes& x) { return static_cast<double>(x.get(0)); }

/// Largest errors by name; a difference that is no number counts as infinite.
struct Worst {
  std::map<std::string, double> of;
  void add(const char* name, double error) {
    double& most = of[name];
    most = std::max(most, std::isnan(error) ? std::numeric_limits<double>::infinity() : std::fabs(error));
  }
  void relative(const char* name, double found, double expected) {
    add(name, found == expected ? 0.0 : (found - expected) / expected);
  }
};

/// How far the log-odds of the answer move when those of xi move by 1: in a gap between lobes the rounding of F counts
/// that much more.
double condition_of_sampling(const Law<double>& law, const Deflection<double>& d, double xi) {
  if (xi == 0.0 || xi == 1.0) return 1.0;
  return std::max(1.0, xi * (1.0 - xi) / (std::numbers::pi * density(law, d) * d.one_minus * d.one_plus));
}

/// Deflections as floats have them, so that the error is that of the computation.
std::vector<Deflection<double>> float_deflections() {
  const auto rounded = [](double x) { return static_cast<double>(static_cast<float>(x)); };
  std::vector<Deflection<double>> out;
  for (const Deflection<double>& d : test_deflections())
    out.push_back({rounded(d.mu), rounded(d.one_minus), rounded(d.one_plus)});
  return out;
}

/// The double form against quadrature over the sphere, and its inverse against its own distribution.
void add_reference(const Law<double>& law, Worst& worst) {
  const LobeSum<double> lobes = lower(law);
  const std::vector<double> kinks = kinks_of(law);
  // The trapezoidal rule where all is smooth, which it integrates best.
  const auto integral = [&](auto f) { return kinks.empty() ? integral_over_sphere(f) : integral_over_sphere(kinks, f); };
  worst.add("integral", integral([&](const Deflection<double>& d) { return density(lobes, d); }) - 1.0);
  for (int l = 1; l <= 40; ++l) {
    const double quadrature =
        integral([&](const Deflection<double>& d) { return density(lobes, d) * legendre(l, d.mu); });
    worst.add(l == 1 ? "mean_cosine" : "moments", moment(law, l) - quadrature);
  }
  std::vector<double> all = test_xi();
  for (const double xi : {1e-100, 1e-30, 1e-15, 1.0 - 1e-15}) all.push_back(xi);
  for (const double xi : all) {
    const Deflection<double> d = sample(law, xi);
    worst.relative("inverse", cdf(law, d), xi);
    worst.relative("inverse", survival(law, d), 1.0 - xi);
  }
}

/// Another number against double: relative, samples relative to their condition.
template <class T>
void add_number(const Law<double>& law, Worst& worst) {
  const LobeSum<T> lobes = lobes_as<T>(lobes_as<float>(lower(law)));  // prepared in double, then rounded
  const auto number = [](double x) { return T(static_cast<float>(x)); };
  for (const Deflection<double>& d : float_deflections()) {
    const Deflection<T> rounded{number(d.mu), number(d.one_minus), number(d.one_plus)};
    worst.relative("density", lane(density(lobes, rounded)), density(law, d));
    worst.relative("cdf", lane(cdf(lobes, rounded)), cdf(law, d));
    worst.relative("cdf", lane(survival(lobes, rounded)), survival(law, d));
  }
  const Law<T> own = law_as<T>(law, [&](const std::string&, double x) { return number(x); });
  for (const double xi : test_xi()) {
    const Deflection<double> d = sample(law, xi);
    const Deflection<T> found = sample(own, number(xi));
    const double condition = condition_of_sampling(law, d, xi);
    worst.add("sample", (lane(found.mu) - d.mu) / condition);
    for (const auto& [end, expected] :
         {std::pair{lane(found.one_minus), d.one_minus}, {lane(found.one_plus), d.one_plus}})
      worst.add("sample", end == expected ? 0.0 : (end / expected - 1.0) / condition);
  }
}

/// Derivatives: of the distribution by mu against the density, of the sample by xi against 1 / (2 pi p).
void add_dual(const Law<double>& law, Worst& worst) {
  using D = Dual<double>;
  const Law<D> dual = law_as<D>(law);
  for (const Deflection<double>& d : test_deflections()) {
    const Deflection<D> moving{D(d.mu, {1.0}), D(d.one_minus, {-1.0}), D(d.one_plus, {1.0})};
    worst.relative("density", density(dual, moving).value, density(law, d));
    worst.relative("cdf", cdf(dual, moving).derivative[0], 2.0 * std::numbers::pi * density(law, d));
  }
  for (const double xi : {1e-4, 0.05, 0.3, 0.7, 0.95, 0.9999}) {
    const Deflection<D> d = sample(dual, D::parameter(xi));
    const Deflection<double> at{d.mu.value, d.one_minus.value, d.one_plus.value};
    const double slope = 1.0 / (2.0 * std::numbers::pi * density(law, at));
    // By the nearer end, which keeps its digits.
    worst.relative("sample", d.mu.value < 0.0 ? d.one_plus.derivative[0] : -d.one_minus.derivative[0], slope);
  }
}

/// The recorded expression, evaluated in double.
void add_symbol(const Law<double>& law, Worst& worst) {
  std::map<std::string, double> inputs;
  const Law<Symbol> recorded = law_as<Symbol>(law, [&](const std::string& name, double x) {
    inputs[name] = x;
    return Symbol::input(name);
  });
  const Deflection<Symbol> given{Symbol::input("d", 0), Symbol::input("d", 1), Symbol::input("d", 2)};
  const Symbol p = density(recorded, given), f = cdf(recorded, given);
  const Deflection<Symbol> sampled = sample(recorded, Symbol::input("xi"));
  const std::vector<double> all = test_xi();
  std::size_t i = 0;
  for (const Deflection<double>& d : test_deflections()) {
    const double xi = all[(7 * i++ + 3) % all.size()];
    inputs["d.0"] = d.mu;
    inputs["d.1"] = d.one_minus;
    inputs["d.2"] = d.one_plus;
    inputs["xi"] = xi;
    const SymbolValue value(inputs);
    worst.relative("density", value(p), density(law, d));
    worst.relative("cdf", value(f), cdf(law, d));
    const Deflection<double> expected = sample(law, xi);
    worst.relative("sample", value(sampled.one_minus), expected.one_minus);
    worst.relative("sample", value(sampled.one_plus), expected.one_plus);
  }
}

template <class L, class Add>
void print(const char* number, Add add) {
  Worst worst;
  const std::vector<Law<double>> cases = law_cases<L>();
  for (const Law<double>& law : cases) add(law, worst);
  std::printf("{\"law\": \"%s\", \"cases\": %zu, \"number\": \"%s\"", std::string(L::name).c_str(), cases.size(),
              number);
  for (const auto& [name, error] : worst.of) {
    if (std::isinf(error)) std::printf(", \"%s\": null", name.c_str());
    else std::printf(", \"%s\": %.3e", name.c_str(), error);
  }
  std::printf("}\n");
}

template <class... L>
void print_all(std::type_identity<std::variant<L...>>) {
  (print<L>("reference", add_reference), ...);
  (print<L>("float", add_number<float>), ...);
  (print<L>("Lanes", add_number<Lanes>), ...);
  (print<L>("Dual", add_dual), ...);
  (print<L>("Symbol", add_symbol), ...);
}

}  // namespace
}  // namespace tyndall

int main() { tyndall::print_all(std::type_identity<tyndall::Law<double>>{}); }
