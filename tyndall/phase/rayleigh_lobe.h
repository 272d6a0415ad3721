#pragma once
// The lobe of Rayleigh scattering with depolarisation.
#include <tuple>

#include "tyndall/phase/deflection.h"

namespace tyndall {

/// p = 3 / (16 pi (1 + 2 gamma)) [(1 + 3 gamma) + (1 - gamma) mu^2] (Chandrasekhar 1950; Bucholtz 1995, eq. 12), with
/// gamma = rho / (2 - rho) of the depolarisation ratio rho in [0, 1). gamma = 0 is the classical 3/(16 pi) (1 + mu^2).
template <class T>
struct RayleighLobe {
  T gamma = T(0.0);

  static constexpr auto members() { return std::tuple{&RayleighLobe::gamma}; }

  T density(const Deflection<T>& d) const { return fma(square_term(), d.mu * d.mu, constant_term()); }

  /// F = 2 pi (1 + mu) [A + B (1 - mu + mu^2) / 3] for p = A + B mu^2: the factor 1 + mu keeps digits at mu = -1.
  T cdf(const Deflection<T>& d) const { return d.one_plus * mean_below(d.mu); }
  T survival(const Deflection<T>& d) const { return d.one_minus * mean_below(-d.mu); }

  /// F(mu) = xi is the cubic mu^3 + 3 c mu = 2 q, whose one real root is 2 sqrt(c) sinh(asinh(q / (c sqrt c)) / 3): no
  /// cancellation anywhere. Both ends then follow from F itself, each relatively accurate: 1 + mu = xi /
  /// mean_below(mu).
  Deflection<T> sample(const T& xi) const {
    const T y = T(1.0) - xi;
    const T one_less = T(1.0) - gamma;
    const T c = named("c", (T(1.0) + T(3.0) * gamma) / one_less);
    const T q = named("q", T(2.0) * (T(1.0) + T(2.0) * gamma) * (xi - y) / one_less);
    const T root = named("root", sqrt(c));
    const T mu = named("cubic_root", T(2.0) * root * sinh(asinh(q / (c * root)) / T(3.0)));
    const T one_plus = xi / mean_below(mu), one_minus = y / mean_below(-mu);
    const Deflection<T> ends = Deflection<T>::from_ends(one_minus, one_plus);
    return {select(abs(mu) < T(0.5), mu, ends.mu), one_minus, one_plus};
  }

  /// chi_2 = (1 - gamma) / (10 (1 + 2 gamma)), all other l >= 1 vanish.
  T moment(int l) const {
    if (l == 0) return T(1.0);
    if (l != 2) return T(0.0);
    return (T(1.0) - gamma) / (T(10.0) + T(20.0) * gamma);
  }

 private:
  T scale() const { return named("scale", T(0.75) * inverse_four_pi<T>() / (T(1.0) + T(2.0) * gamma)); }
  T constant_term() const { return named("constant_term", scale() * (T(1.0) + T(3.0) * gamma)); }
  T square_term() const { return named("square_term", scale() * (T(1.0) - gamma)); }
  /// 2 pi times the mean of p over [-1, mu].
  T mean_below(const T& mu) const {
    const T cubic = named("mean_square", fma(mu, mu, T(1.0) - mu) / T(3.0));
    return T(2.0) * pi<T>() * fma(square_term(), cubic, constant_term());
  }
};

}  // namespace tyndall
