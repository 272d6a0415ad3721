#pragma once
// A deflection: the angle between directions of travel before and after scattering, as {mu, 1 - mu, 1 + mu}.
#include "tyndall/number/scalar.h"

namespace tyndall {

/// mu is the cosine of the deflection (+1 undeflected). All three numbers are carried because the forward peak lives in
/// 1 - mu: rounding mu alone to float changes a g = 0.99 Henyey-Greenstein density by 9e-4, a g = 0.9999 one by a
/// factor of 18.
template <class T>
struct Deflection {
  T mu, one_minus, one_plus;

  /// From mu alone [-1, 1]: exact in the sense of the number type, but knows no more about the peak than mu does.
  static Deflection from_mu(const T& mu) { return {mu, T(1.0) - mu, T(1.0) + mu}; }
  /// From 1 - mu and 1 + mu, each relatively accurate; they should sum to 2.
  static Deflection from_ends(const T& one_minus, const T& one_plus) {
    return {select(one_minus < one_plus, T(1.0) - one_minus, one_plus - T(1.0)), named("one_minus", one_minus),
            named("one_plus", one_plus)};
  }
  /// From u = (1 + mu) / 2 and v = 1 - u, each in [0, 1] and relatively accurate.
  static Deflection from_halves(const T& u, const T& v) { return from_ends(T(2.0) * v, T(2.0) * u); }
  /// From the angle in radians [0, pi]: 1 -+ mu = 2 sin^2, 2 cos^2 of the half angle.
  static Deflection from_angle(const T& angle) {
    const T s = sin(T(0.5) * angle), c = cos(T(0.5) * angle);
    return from_halves(c * c, s * s);
  }
  /// sin of the deflection, relatively accurate at both ends.
  T sine() const { return sqrt(one_minus * one_plus); }
};

/// Cumulative distribution, its complement and density [1/sr] at a deflection, of a lobe or added up over lobes.
template <class T>
struct Passage {
  T below, above, density;
};

}  // namespace tyndall
