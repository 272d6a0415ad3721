#pragma once
// Half isotropic, half a power lobe: the common text of the hazy and murky laws.
#include "tyndall/phase/lobe_sum.h"

namespace tyndall {

/// p = (1/(4 pi)) [1/2 + (n + 1)/2 u^n], u = (1 + mu)/2. The 1/2 and (n + 1)/2 are what makes the integral 1.
template <class T>
LobeSum<T> half_isotropic_lobes(int n) {
  return {{T(0.5), IsotropicLobe<T>{}}, {T(0.5), PowerLobe<T>{n}}};
}

/// Solves F(u) = (u + u^(n+1)) / 2 = xi, monotone in xi, xi in [0, 1]. Starting at min(2 xi, (2 xi)^(1/(n+1)), 1),
/// which is never below the root of this convex function, Halley's steps converge in 3 (float) or 5 (double). A last
/// Newton step in v = 1 - u on v + (1 - u^(n+1)) = 2 (1 - xi), free of cancellation, keeps 1 - mu relatively accurate
/// at the peak.
template <class T>
Deflection<T> half_isotropic_sample(int n, const T& xi) {
  const T target = named("target", T(2.0) * xi), rest = named("rest", T(2.0) * (T(1.0) - xi));
  const T start = min(min(target, T(1.0)), exp(log(max(target, T(1e-37))) / T(n + 1.0)));
  const auto halley = [&](const std::array<T, 1>& state) -> std::array<T, 1> {
    const T u = named("u", state[0]);
    const T below = named("power", integer_power(u, n - 1));
    const T value = named("excess", fma(below * u, u, u) - target);
    const T slope = named("slope", fma(T(n + 1.0) * below, u, T(1.0)));
    const T curve = named("curve", T(n * (n + 1.0)) * below);
    const T step = named("halley", T(2.0) * value * slope / (T(2.0) * slope * slope - value * curve));
    return {max(T(0.0), u - step)};
  };
  const T u = named("root", min(T(1.0), iterate(is_double<T> ? 6 : 4, std::array<T, 1>{start}, halley)[0]));
  const T v = named("v", T(1.0) - u);
  const T above = named("above", one_minus_power(u, v, n + 1));
  const T slope = named("slope", fma(T(n + 1.0), integer_power(u, n), T(1.0)));
  const T refined = named("refined", max(T(0.0), v - (v + above - rest) / slope));
  return Deflection<T>::from_halves(select(u < T(0.5), u, T(1.0) - refined), select(u < T(0.5), v, refined));
}

}  // namespace tyndall
