#pragma once
// Gauss-Legendre quadrature, fixed and adaptive.
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace tyndall {

/// Positive nodes and weights of 16-point Gauss-Legendre on [-1, 1] (Abramowitz and Stegun, table 25.4): exact for
/// polynomials up to degree 31.
inline constexpr std::array<double, 8> gauss_legendre_node = {
    0.095012509837637440, 0.28160355077925891, 0.45801677765722739, 0.61787624440264375,
    0.75540440835500303,  0.86563120238783174, 0.94457502307323258, 0.98940093499164993};
inline constexpr std::array<double, 8> gauss_legendre_weight = {
    0.18945061045506850, 0.18260341504492359,  0.16915651939500254,  0.14959598881657673,
    0.12462897125553387, 0.095158511682492785, 0.062253523938647893, 0.027152459411754095};

/// int_begin^end f by 4 points (Abramowitz and Stegun, table 25.4), for pieces over which f hardly bends.
template <class F>
auto gauss_legendre_4(double begin, double end, const F& f) {
  const double middle = 0.5 * (begin + end), half = 0.5 * (end - begin);
  const double inner = half * 0.33998104358485626, outer = half * 0.86113631159405258;
  auto sum = (f(middle - inner) + f(middle + inner)) * 0.65214515486254614;
  sum += (f(middle - outer) + f(middle + outer)) * 0.34785484513745386;
  return sum * half;
}

/// int_begin^end f by 16 points; f returns a number or Channels.
template <class F>
auto gauss_legendre_16(double begin, double end, const F& f) {
  const double middle = 0.5 * (begin + end), half = 0.5 * (end - begin);
  auto sum = (f(middle - half * gauss_legendre_node[0]) + f(middle + half * gauss_legendre_node[0])) *
             gauss_legendre_weight[0];
  for (std::size_t i = 1; i < gauss_legendre_node.size(); ++i) {
    const double step = half * gauss_legendre_node[i];
    sum += (f(middle - step) + f(middle + step)) * gauss_legendre_weight[i];
  }
  return sum * half;
}

/// An n-point rule on [0, 1], for any n >= 1: {node, weight} in rising order. Newton on the Legendre recurrence (A&S
/// 25.4.29).
struct QuadraturePoint {
  double node, weight;
};
inline std::vector<QuadraturePoint> gauss_legendre(int n) {
  std::vector<QuadraturePoint> rule(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) {
    double x = -std::cos(3.14159265358979323846 * (i + 0.75) / (n + 0.5)), slope = 1.0;
    for (int step = 0; step < 8; ++step) {
      double p = 1.0, before = 0.0;
      for (int k = 1; k <= n; ++k) {
        const double next = ((2.0 * k - 1.0) * x * p - (k - 1.0) * before) / k;
        before = p;
        p = next;
      }
      slope = n * (x * p - before) / (x * x - 1.0);
      x -= p / slope;
    }
    rule[static_cast<std::size_t>(i)] = {0.5 * (1.0 + x), 1.0 / ((1.0 - x * x) * slope * slope)};
  }
  return rule;
}

}  // namespace tyndall
