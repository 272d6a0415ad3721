#pragma once
// Integrals over all directions that resolve any peak.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "tyndall/phase/law.h"

namespace tyndall {

/// The deflection with (1 + mu) / (1 - mu) = e^s.
inline Deflection<double> at_log_odds(double s) {
  return Deflection<double>::from_ends(2.0 / (1.0 + std::exp(s)), 2.0 / (1.0 + std::exp(-s)));
}

/// Where a sum of lobes has kinks, as log-odds, rising: the knots of its tables.
inline std::vector<double> kinks_of(const LobeSum<double>& lobes) {
  std::vector<double> out;
  for (const auto& part : lobes) {
    const auto* const lobe = std::get_if<TableLobe<double>>(&part.lobe);
    for (std::size_t k = 1; lobe != nullptr && k + 1 < lobe->table->size(); ++k)
      out.push_back(std::log(lobe->table->one_plus(k) / lobe->table->one_minus(k)));
  }
  std::sort(out.begin(), out.end());
  return out;
}
inline std::vector<double> kinks_of(const Law<double>& law) { return kinks_of(lower(law)); }

/// 2 pi int f dmu of what is smooth between kinks: Gauss's rule of five points over pieces of at most 1/16 in s. f
/// gives a number or Channels.
template <class Function>
auto integral_over_sphere(const std::vector<double>& kinks, Function f) {
  static constexpr double node[3] = {0.0, 0.5384693101056831, 0.9061798459386640};
  static constexpr double weight[3] = {0.5688888888888889, 0.4786286704993665, 0.2369268850561891};
  const auto slope = [&](double s) {
    const Deflection<double> d = at_log_odds(s);
    return f(d) * (d.one_minus * d.one_plus);
  };
  std::vector<double> cuts{-90.0};
  cuts.insert(cuts.end(), kinks.begin(), kinks.end());
  cuts.push_back(90.0);
  decltype(slope(0.0)) sum{};
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    const int pieces = 1 + static_cast<int>((cuts[i + 1] - cuts[i]) * 16.0);
    const double half = 0.5 * (cuts[i + 1] - cuts[i]) / pieces;
    for (int k = 0; k < pieces; ++k) {
      const double middle = cuts[i] + (2 * k + 1) * half;
      auto piece = weight[0] * slope(middle);
      for (int n = 1; n < 3; ++n)
        piece += weight[n] * (slope(middle - half * node[n]) + slope(middle + half * node[n]));
      sum += piece * half;
    }
  }
  return sum * std::numbers::pi;
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
