#pragma once
// The lobe of Henyey and Greenstein, in forms that keep their digits up to |g| = 0.9999 in float.
#include <tuple>

#include "tyndall/phase/deflection.h"

namespace tyndall {

/// p = (1 - g^2) / (4 pi (1 + g^2 - 2 g mu)^(3/2)) (Henyey and Greenstein 1941, eq. 2), -1 < g < 1, g > 0 forward.
/// `complement` is 1 - |g|, carried because in float it is all that is left of g near the peak.
template <class T>
struct HenyeyGreensteinLobe {
  T g = T(0.0);
  T complement = T(1.0);

  static HenyeyGreensteinLobe of(const T& g) { return {g, named("complement", T(1.0) - abs(g))}; }
  static constexpr auto members() { return std::tuple{&HenyeyGreensteinLobe::g, &HenyeyGreensteinLobe::complement}; }

  T density(const Deflection<T>& d) const {
    const T r2 = distance_squared(d);
    const T numerator = named("numerator", complement * (T(1.0) + abs(g)) * inverse_four_pi<T>());
    return numerator / (r2 * sqrt(r2));
  }

  /// F = (1 - g)(1 + mu) / (r (1 + g + r)), r^2 = 1 + g^2 - 2 g mu: the textbook difference of reciprocals divides by
  /// g.
  T cdf(const Deflection<T>& d) const {
    const T r = named("r", sqrt(distance_squared(d)));
    return one_minus_g() * d.one_plus / (r * (one_plus_g() + r));
  }
  /// 1 - F = (1 + g)(1 - mu) / (r (1 - g + r)): the mirror image.
  T survival(const Deflection<T>& d) const {
    const T r = named("r", sqrt(distance_squared(d)));
    return one_plus_g() * d.one_minus / (r * (one_minus_g() + r));
  }

  /// With y = 1 - xi and D = (1 - g) y + (1 + g) xi the inverse of F is
  ///   1 - mu = 2 y (1 - g)^2 (1 + g xi) / D^2,   1 + mu = 2 xi (1 + g)^2 (1 - g y) / D^2
  /// for every |g| < 1: no division by g, no cancellation once the inner factors are written from the smaller side.
  Deflection<T> sample(const T& xi) const {
    const T y = T(1.0) - xi;
    const T minus = one_minus_g(), plus = one_plus_g(), a = abs(g);
    const T inverse = named("factor", T(1.0) / fma(minus, y, plus * xi));
    const T toward_back = named("backward", minus * inverse), toward_front = named("forward", plus * inverse);
    const T inner_minus = named("inner_minus", select(g < T(0.0), fma(a, y, complement), fma(a, xi, T(1.0))));
    const T inner_plus = named("inner_plus", select(g < T(0.0), fma(a, y, T(1.0)), fma(a, xi, complement)));
    return Deflection<T>::from_ends(T(2.0) * y * toward_back * toward_back * inner_minus,
                                    T(2.0) * xi * toward_front * toward_front * inner_plus);
  }

  /// chi_l = g^l.
  T moment(int l) const {
    T power(1.0);
    for (int i = 0; i < l; ++i) power = power * g;
    return power;
  }

 private:
  T one_minus_g() const { return named("one_minus_g", select(g < T(0.0), T(1.0) + abs(g), complement)); }
  T one_plus_g() const { return named("one_plus_g", select(g < T(0.0), complement, T(1.0) + abs(g))); }
  /// 1 + g^2 - 2 g mu as (1 - |g|)^2 + 2 |g| (1 -+ mu): a sum of two positive terms.
  T distance_squared(const Deflection<T>& d) const {
    const T from_peak = named("from_peak", select(g < T(0.0), d.one_plus, d.one_minus));
    return named("distance_squared", fma(T(2.0) * abs(g), from_peak, complement * complement));
  }
};

}  // namespace tyndall
