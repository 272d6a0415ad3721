#include <cmath>
#include <cstdio>

// [derivative]
#include "tyndall/number/dual.h"
#include "tyndall/phase/law_as.h"

// The g of Henyey-Greenstein that scatters `measured` [1/sr] sideways, by Newton's method on the logarithm.
double fit_sideways(double measured) {
  using Number = tyndall::Dual<double>;  // Dual<double, 2> carries derivatives by two parameters, and so on
  double g = 0.5;
  for (int i = 0; i < 20; ++i) {
    const tyndall::Law<Number> law = tyndall::HenyeyGreenstein<Number>{Number::parameter(g)};
    const Number p = tyndall::density(law, tyndall::Deflection<Number>::from_mu(0.0));
    const double step = std::log(p.value / measured) / (p.derivative[0] / p.value);
    g = std::fmin(g - step, 0.5 * (g + 1.0));  // never past 1
  }
  return g;
}
// [end]

int main() {
  const double g = fit_sideways(0.01);
  const tyndall::Law<double> law = tyndall::HenyeyGreenstein<double>{g};
  const double p = tyndall::density(law, tyndall::Deflection<double>::from_mu(0.0));
  std::printf("g = %.6f scatters %.6f 1/sr sideways\n", g, p);
  return std::fabs(p - 0.01) < 1e-12 ? 0 : 1;
}
