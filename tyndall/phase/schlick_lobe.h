#pragma once
// Schlick's lobe, an ellipse in place of Henyey and Greenstein's power 3/2.
#include <tuple>

#include "tyndall/phase/deflection.h"

namespace tyndall {

/// p = (1 - k^2) / (4 pi (1 - k mu)^2) (Blasi, Le Saec and Schlick 1993), -1 < k < 1, k > 0 forward. `complement` is
/// 1 - |k|.
template <class T>
struct SchlickLobe {
  T k = T(0.0);
  T complement = T(1.0);

  static SchlickLobe of(const T& k) { return {k, named("complement", T(1.0) - abs(k))}; }
  static constexpr auto members() { return std::tuple{&SchlickLobe::k, &SchlickLobe::complement}; }

  T density(const Deflection<T>& d) const {
    const T reach = reach_of(d);
    return complement * (T(1.0) + abs(k)) * inverse_four_pi<T>() / (reach * reach);
  }
  /// F = (1 - k)(1 + mu) / (2 (1 - k mu)).
  T cdf(const Deflection<T>& d) const { return T(0.5) * one_minus_k() * d.one_plus / reach_of(d); }
  T survival(const Deflection<T>& d) const { return T(0.5) * one_plus_k() * d.one_minus / reach_of(d); }

  /// With y = 1 - xi and D = (1 - k) y + (1 + k) xi:  1 - mu = 2 y (1 - k)/D,  1 + mu = 2 xi (1 + k)/D.
  Deflection<T> sample(const T& xi) const {
    const T y = T(1.0) - xi, minus = one_minus_k(), plus = one_plus_k();
    const T factor = named("factor", T(2.0) / fma(minus, y, plus * xi));
    return Deflection<T>::from_ends(y * minus * factor, xi * plus * factor);
  }

  /// chi_l = l (Q_{l-1}(1/k) - Q_l(1/k) / k) with the Legendre functions of the second kind, since 1/(z - mu) = sum (2l
  /// + 1) Q_l(z) P_l(mu) and (z^2 - 1) Q_l' = l (z Q_l - Q_{l-1}). Their ratios Q_n = k R_n Q_{n-1} are the minimal
  /// solution of the recurrence, R_n = n / (2 n + 1 - (n + 1) k^2 R_{n+1}), so they are taken from far above, from
  /// R = 1/(1 + sqrt(1 - k^2)). Absolute error 1e-12 in double for |k| <= 0.9999.
  T moment(int l) const {
    if (l == 0) return T(1.0);
    const T square = named("square", k * k);
    const T far = T(1.0) / (T(1.0) + sqrt(complement * (T(1.0) + abs(k))));
    const int steps = is_double<T> ? 1200 : 600;
    const auto down = [&](const std::array<T, 2>& state) -> std::array<T, 2> {
      const T n = named("n", state[0]);
      return {n - T(1.0), n / (fma(T(2.0), n, T(1.0)) - (n + T(1.0)) * square * named("ratio", state[1]))};
    };
    T ratio = iterate(steps, std::array<T, 2>{T(static_cast<double>(l + steps)), far}, down)[1];  // R_{l+1}
    T product(1.0), last(0.0);
    for (int n = l; n > 0; --n) {
      ratio = named("ratio", T(static_cast<double>(n)) / (T(2.0 * n + 1.0) - T(n + 1.0) * square * ratio));
      if (n == l) {
        last = T(1.0) - ratio;
      } else {
        product = product * ratio * k;
      }
    }
    return T(static_cast<double>(l)) * last * product * k / (T(1.0) - square * ratio);  // Q_0(1/k) = k/(1 - k^2 R_1)
  }

 private:
  T one_minus_k() const { return named("one_minus_k", select(k < T(0.0), T(1.0) + abs(k), complement)); }
  T one_plus_k() const { return named("one_plus_k", select(k < T(0.0), complement, T(1.0) + abs(k))); }
  /// 1 - k mu as (1 - |k|) + |k| (1 -+ mu).
  T reach_of(const Deflection<T>& d) const {
    return named("reach", fma(abs(k), select(k < T(0.0), d.one_plus, d.one_minus), complement));
  }
};

}  // namespace tyndall
