#pragma once
// Integrals over all directions that resolve any peak.
#include <cmath>
#include <numbers>

#include "tyndall/phase/deflection.h"

namespace tyndall {

/// The deflection with (1 + mu) / (1 - mu) = e^s.
inline Deflection<double> at_log_odds(double s) {
  return Deflection<double>::from_ends(2.0 / (1.0 + std::exp(s)), 2.0 / (1.0 + std::exp(-s)));
}

/// 2 pi int f dmu. With mu = tanh(s / 2), dmu = (1 - mu)(1 + mu)/2 ds, the integrand falls off exponentially on both
/// sides and the trapezoidal rule converges exponentially: a step of 1/16 is exact to double precision for peaks of any
/// width (their width in s is about 1) and degrees up to about 60.
template <class Function>
double integral_over_sphere(Function f) {
  constexpr int steps = 16 * 90;
  double sum = 0.0;
  for (int i = -steps; i <= steps; ++i) {
    const Deflection<double> d = at_log_odds(i / 16.0);
    sum += f(d) * d.one_minus * d.one_plus;
  }
  return sum * std::numbers::pi / 16.0;
}

/// P_l(mu) by its recurrence.
inline double legendre(int l, double mu) {
  double before = 1.0, now = mu;
  if (l == 0) return before;
  for (int k = 1; k < l; ++k) {
    const double next = ((2 * k + 1) * mu * now - k * before) / (k + 1);
    before = now;
    now = next;
  }
  return now;
}

}  // namespace tyndall
