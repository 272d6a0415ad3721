#pragma once
// A share of isotropic scattering, the rest a power lobe: the common text of the hazy and murky laws.
#include <array>

#include "tyndall/phase/lobe_sum.h"

namespace tyndall {

/// p = (1/(4 pi)) [a + (1 - a)(n + 1) u^n], u = (1 + mu)/2, with a = `flat` in (0, 1) the isotropic share: the n + 1 is
/// what makes the integral 1.
template <class T>
LobeSum<T> flat_and_power_lobes(double flat, int n) {
  return {{T(flat), IsotropicLobe<T>{}}, {T(1.0 - flat), PowerLobe<T>{n}}};
}

/// Where the search for a quantile of such a law starts: polynomials in xi, fitted at Chebyshev's points, both in z
/// from -1 to 1. Below `split` u is the straight line xi / flat times `low`, in z = -1 .. 1 for xi = straight .. split
/// (below `straight` as there); above it is `high`.
struct FlatAndPowerStart {
  double straight, split;
  std::array<double, 7> low, high;
};

/// Solves F(u) = a u + (1 - a) u^(n+1) = xi, monotone in xi, xi in [0, 1], from a start that is at most 3e-4 off: one
/// of Halley's steps is enough in float, three in double. A last Newton step in v = 1 - u on a v + (1 - a)(1 - u^(n+1))
/// = 1 - xi, free of cancellation, keeps 1 - mu relatively accurate at the peak.
template <class T>
Deflection<T> flat_and_power_sample(double flat, int n, const FlatAndPowerStart& from, const T& xi) {
  const T ratio = T(1.0 / flat - 1.0);  // of the power lobe's share to the flat one: u + ratio u^(n+1) = xi / a
  const T target = named("target", T(1.0 / flat) * xi), rest = named("rest", T(1.0 / flat) * (T(1.0) - xi));
  const auto polynomial = [](const std::array<double, 7>& c, const T& z) {
    T sum = T(c[6]);
    for (std::size_t k = 6; k > 0; --k) sum = fma(sum, z, T(c[k - 1]));
    return sum;
  };
  const auto place = [&](double begin, double end) {
    return fma(T(2.0 / (end - begin)), xi, T(-(begin + end) / (end - begin)));
  };
  const T low = named("low", max(T(-1.0), place(from.straight, from.split)));
  const T high = named("high", place(from.split, 1.0));
  const T start =
      named("start", select(xi < T(from.split), target * polynomial(from.low, low), polynomial(from.high, high)));
  const auto halley = [&](const std::array<T, 1>& state) -> std::array<T, 1> {
    const T u = named("u", state[0]);
    const T below = named("power", ratio * integer_power(u, n - 1));
    const T value = named("excess", fma(below * u, u, u) - target);
    const T slope = named("slope", fma(T(n + 1.0) * below, u, T(1.0)));
    const T curve = named("curve", T(n * (n + 1.0)) * below);
    const T step = named("halley", T(2.0) * value * slope / (T(2.0) * slope * slope - value * curve));
    return {max(T(0.0), u - step)};
  };
  const T u = named("root", min(T(1.0), iterate(is_double<T> ? 3 : 1, std::array<T, 1>{start}, halley)[0]));
  const T v = named("v", T(1.0) - u);
  const T above = named("above", ratio * one_minus_power(u, v, n + 1));
  const T slope = named("slope", fma(T(n + 1.0) * ratio, integer_power(u, n), T(1.0)));
  const T refined = named("refined", max(T(0.0), v - (v + above - rest) / slope));
  return Deflection<T>::from_halves(select(u < T(0.5), u, T(1.0) - refined), select(u < T(0.5), v, refined));
}

}  // namespace tyndall
