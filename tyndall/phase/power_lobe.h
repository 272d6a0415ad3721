#pragma once
// The forward lobe ((1 + mu)/2)^n of the hazy and murky laws.
#include <tuple>

#include "tyndall/phase/deflection.h"

namespace tyndall {

/// x^n for n >= 0 by squaring; straight-line for every number since n is a host integer.
template <class T>
T integer_power(T x, int n) {
  T result(1.0);
  bool any = false;
  for (; n > 0; n /= 2) {
    if (n % 2 == 1) {
      result = any ? result * x : x;
      any = true;
    }
    if (n > 1) x = x * x;
  }
  return result;
}

/// 1 - u^n from v = 1 - u without cancellation, by 1 - u^(2k) = (1 - u^k)(1 + u^k) and 1 - u^(k+1) = v + u (1 - u^k). n
/// >= 1.
template <class T>
T one_minus_power(const T& u, const T& v, int n) {
  if (n == 1) return v;
  if (n % 2 == 1) return fma(u, one_minus_power(u, v, n - 1), v);
  return one_minus_power(u, v, n / 2) * (T(1.0) + integer_power(u, n / 2));
}

/// p = (n + 1) / (4 pi) u^n with u = (1 + mu) / 2 (Nishita, Miyawaki and Nakamae 1987, normalised). n >= 0.
template <class T>
struct PowerLobe {
  int n = 0;

  static constexpr auto members() { return std::tuple{&PowerLobe::n}; }

  T density(const Deflection<T>& d) const { return T(n + 1.0) * inverse_four_pi<T>() * integer_power(u_of(d), n); }
  /// F = u^(n+1).
  T cdf(const Deflection<T>& d) const { return integer_power(u_of(d), n + 1); }
  T survival(const Deflection<T>& d) const { return one_minus_power(u_of(d), named("v", T(0.5) * d.one_minus), n + 1); }

  /// u = xi^(1/(n+1)); 1 - u comes from expm1 so that the peak keeps its digits. xi = 0 gives mu = -1.
  Deflection<T> sample(const T& xi) const {
    const T exponent = named("exponent", logarithm(xi, T(1.0) - xi) / T(n + 1.0));
    const T u = exp(exponent), v = -expm1(exponent);
    return Deflection<T>::from_halves(select(xi > T(0.0), u, T(0.0)), select(xi > T(0.0), v, T(1.0)));
  }

  /// chi_l = prod_{j=1..l} (n + 1 - j) / (n + 1 + j): zero beyond l = n.
  T moment(int l) const {
    double product = 1.0;
    for (int j = 1; j <= l; ++j) product *= (n + 1.0 - j) / (n + 1.0 + j);
    return T(product);
  }

 private:
  /// ln xi from y = 1 - xi too: near 1 as -2 artanh(y / (2 - y)), because the logarithms of shaders keep no digits
  /// there.
  static T logarithm(const T& xi, const T& y) {
    const T z = named("z", y / (T(2.0) - y)), z2 = named("z2", z * z);
    T series = T(is_double<T> ? 1.0 / 21.0 : 1.0 / 11.0);
    for (int odd = is_double<T> ? 19 : 9; odd > 1; odd -= 2) series = fma(series, z2, T(1.0 / odd));
    return select(y < T(0.25), T(-2.0) * fma(series * z2, z, z), log(max(xi, T(1e-37))));
  }
  static T u_of(const Deflection<T>& d) { return named("u", T(0.5) * d.one_plus); }
};

}  // namespace tyndall
