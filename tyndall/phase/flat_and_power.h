#pragma once
// A share of isotropic scattering, the rest a power lobe: the common text of the hazy and murky laws.
#include "tyndall/phase/lobe_sum.h"

namespace tyndall {

/// p = (1/(4 pi)) [a + (1 - a)(n + 1) u^n], u = (1 + mu)/2, with a = `flat` in (0, 1) the isotropic share: the n + 1 is
/// what makes the integral 1.
template <class T>
LobeSum<T> flat_and_power_lobes(double flat, int n) {
  return {{T(flat), IsotropicLobe<T>{}}, {T(1.0 - flat), PowerLobe<T>{n}}};
}

/// Solves F(u) = a u + (1 - a) u^(n+1) = xi, monotone in xi, xi in [0, 1]. Starting at min(xi/a, (xi/(1 -
/// a))^(1/(n+1)), 1), which is never below the root of this convex function, Halley's steps converge in 3 (float) or 5
/// (double). A last Newton step in v = 1 - u on a v + (1 - a)(1 - u^(n+1)) = 1 - xi, free of cancellation, keeps 1 - mu
/// relatively accurate at the peak.
template <class T>
Deflection<T> flat_and_power_sample(double flat, int n, const T& xi) {
  const T ratio = T(1.0 / flat - 1.0);  // of the power lobe's share to the flat one: u + ratio u^(n+1) = xi / a
  const T target = named("target", T(1.0 / flat) * xi), rest = named("rest", T(1.0 / flat) * (T(1.0) - xi));
  const T alone = named("alone", T(1.0 / (1.0 - flat)) * xi);
  const T start = min(min(target, T(1.0)), exp(log(max(alone, T(1e-37))) / T(n + 1.0)));
  const auto halley = [&](const std::array<T, 1>& state) -> std::array<T, 1> {
    const T u = named("u", state[0]);
    const T below = named("power", ratio * integer_power(u, n - 1));
    const T value = named("excess", fma(below * u, u, u) - target);
    const T slope = named("slope", fma(T(n + 1.0) * below, u, T(1.0)));
    const T curve = named("curve", T(n * (n + 1.0)) * below);
    const T step = named("halley", T(2.0) * value * slope / (T(2.0) * slope * slope - value * curve));
    return {max(T(0.0), u - step)};
  };
  const T u = named("root", min(T(1.0), iterate(is_double<T> ? 6 : 4, std::array<T, 1>{start}, halley)[0]));
  const T v = named("v", T(1.0) - u);
  const T above = named("above", ratio * one_minus_power(u, v, n + 1));
  const T slope = named("slope", fma(T(n + 1.0) * ratio, integer_power(u, n), T(1.0)));
  const T refined = named("refined", max(T(0.0), v - (v + above - rest) / slope));
  return Deflection<T>::from_halves(select(u < T(0.5), u, T(1.0) - refined), select(u < T(0.5), v, refined));
}

}  // namespace tyndall
