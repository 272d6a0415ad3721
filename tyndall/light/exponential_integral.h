#pragma once
// The complex exponential integral, for closed forms of airlight. Double, host only.
#include <cmath>
#include <complex>
#include <limits>

namespace tyndall {

/// e^z E1(z) on the principal branch, for any complex z != 0 (0 gives infinity): E1(z) = int_z^inf e^-s / s ds
/// (Abramowitz and Stegun 5.1.1), scaled so that it neither over- nor underflows, |z e^z E1(z)| ~ 1 for large z. On the
/// negative real axis the sign of a zero imaginary part chooses the side of the cut. Relative error of the modulus
/// below 4e-15 (measured against 40 digits, exponential_integral_test.cc); a real or imaginary part much smaller than
/// the other has that absolute error.
inline std::complex<double> scaled_exponential_integral(std::complex<double> z) {
  const double x = z.real(), y = z.imag(), squared = x * x + y * y;
  const double radius = squared > 1e-290 && squared < 1e290 ? std::sqrt(squared) : std::hypot(x, y);
  if (radius == 0.0) return std::numeric_limits<double>::infinity();
  const auto size = [](const std::complex<double>& w) { return std::fabs(w.real()) + std::fabs(w.imag()); };
  // Both remedies depend on m = |z| + Re z only. The power series loses e^m of its digits; the continued fraction
  // converges like exp(-4 Re sqrt(2 n z)) = exp(-4 sqrt(n m)), which asks for n = 190 / m terms in practice.
  const double m = x >= 0.0 ? radius + x : y * y / (radius - x);
  if (m >= 2.0) {
    // A&S 5.1.22 contracted to its even part: 1/(z + 1 - 1/(z + 3 - 4/(z + 5 - ...))), from the far end; divisions
    // written out, as numerators stay far from overflow.
    const double bounded = m < 1e4 ? m : 1e4;
    double real = 0.0, imaginary = 0.0;
    for (int k = static_cast<int>(200.0 / bounded) + 5; k >= 0; --k) {
      const double a = x + 2.0 * k + 1.0 + real, b = y + imaginary;
      const double scale = (k == 0 ? 1.0 : -static_cast<double>(k) * k) / (a * a + b * b);
      real = scale * a;
      imaginary = -scale * b;
    }
    return {real, imaginary};
  }
  if (radius > 38.0) {
    // Beside the negative axis, where neither works: the asymptotic series (A&S 5.1.51), whose smallest term is e^-|z|.
    const std::complex<double> inverse = 1.0 / z;
    std::complex<double> term = inverse, sum = inverse;
    for (int k = 1; k < radius && size(term) > 1e-18 * size(sum); ++k) {
      term *= -static_cast<double>(k) * inverse;
      sum += term;
    }
    return sum;
  }
  // A&S 5.1.11: E1(z) = -gamma - ln z - sum_{k >= 1} (-z)^k / (k k!).
  constexpr double euler = 0.57721566490153286061;
  std::complex<double> power = 1.0, sum = 0.0;
  for (int k = 1; k < 200; ++k) {
    power *= -z / static_cast<double>(k);
    const std::complex<double> term = power / static_cast<double>(k);
    sum += term;
    if (k > radius && size(term) < 1e-17 * size(sum)) break;
  }
  return std::exp(z) * (-euler - std::log(z) - sum);
}

}  // namespace tyndall
