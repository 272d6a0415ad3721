#pragma once
// Probabilities of the statistics that random samples are judged by.
#include <cmath>

namespace tyndall::tests {

/// The probability that a chi-square of `degrees` >= 1 degrees of freedom exceeds x >= 0: the regularised incomplete
/// gamma function Q(degrees/2, x/2) by its series or its continued fraction (Abramowitz and Stegun 6.5.29, 6.5.31).
inline double chi_square_survival(double x, int degrees) {
  const double a = 0.5 * degrees, half = 0.5 * x;
  if (!(half > 0.0)) return 1.0;
  const double scale = std::exp(a * std::log(half) - half - std::lgamma(a));
  if (half < a + 1.0) {
    double term = 1.0 / a, sum = term;
    for (double k = a + 1.0; term > 1e-17 * sum; k += 1.0) sum += term *= half / k;
    return 1.0 - scale * sum;
  }
  // Lentz's evaluation of 1/(x+ (1-a)/(1+ 1/(x+ ...))) in its even form.
  double b = half + 1.0 - a, c = 1e300, d = 1.0 / b, value = d;
  for (int i = 1; i < 100000; ++i) {
    const double n = -i * (i - a);
    b += 2.0;
    d = 1.0 / (n * d + b);
    c = b + n / c;
    value *= c * d;
    if (std::fabs(c * d - 1.0) < 1e-16) break;
  }
  return scale * value;
}

/// The probability that the largest distance between the empirical distribution of `count` samples and the true one
/// exceeds `distance`: Kolmogorov's limit with the correction of Stephens (1970), good to 1 % from 5 samples on.
inline double kolmogorov_survival(double distance, double count) {
  const double root = std::sqrt(count), x = distance * (root + 0.12 + 0.11 / root);
  if (x < 0.2) return 1.0;
  if (x < 1.0) {  // the theta function's other form converges there
    const double pi = std::acos(-1.0), step = -pi * pi / (8.0 * x * x);
    double sum = 0.0;
    for (int k = 1; k <= 9; k += 2) sum += std::exp(step * k * k);
    return 1.0 - std::sqrt(2.0 * pi) / x * sum;
  }
  double sum = 0.0;
  for (int k = 1; k <= 8; ++k) sum += (k % 2 == 1 ? 2.0 : -2.0) * std::exp(-2.0 * k * k * x * x);
  return sum;
}

}  // namespace tyndall::tests
