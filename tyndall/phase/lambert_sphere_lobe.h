#pragma once
// The lobe of large spheres with a matt white surface.
#include <array>
#include <numbers>
#include <tuple>

#include "tyndall/phase/deflection.h"

namespace tyndall {

namespace lambert_sphere {

/// Gauss's series 2F1(1/2, 1/2; 5/2; v) = sum c_k v^k, c_k = c_{k-1} (2k - 1)^2 / (2k (2k + 3)), and c_k / (k + 5/2).
template <std::size_t N>
constexpr std::array<double, N> series(bool integrated) {
  std::array<double, N> c{};
  double term = 1.0;
  for (std::size_t k = 0; k < N; ++k) {
    const double n = static_cast<double>(k);
    if (k > 0) term *= (2.0 * n - 1.0) * (2.0 * n - 1.0) / (2.0 * n * (2.0 * n + 3.0));
    c[k] = integrated ? term / (n + 2.5) : term;
  }
  return c;
}

/// The first M Chebyshev terms over 0 <= v <= 1/2 of a power series, as a polynomial in v again: as good as a series of
/// three times the terms.
template <std::size_t M, std::size_t N>
constexpr std::array<double, M> economised(const std::array<double, N>& c) {
  // v = (1 + z)/4. Interpolation at the M zeros of Chebyshev's polynomial T_M in z, by Newton's divided differences.
  std::array<double, M> node{}, divided{}, out{};
  for (std::size_t i = 0; i < M; ++i) {
    // cos by its series, which compilers can evaluate.
    const double angle = std::numbers::pi * (static_cast<double>(i) + 0.5) / static_cast<double>(M);
    double cosine = 1.0, term = 1.0;
    for (int k = 1; k < 30; ++k) cosine += term *= -angle * angle / ((2.0 * k - 1.0) * (2.0 * k));
    node[i] = 0.25 * (1.0 + cosine);
    for (std::size_t k = N; k > 0; --k) divided[i] = divided[i] * node[i] + c[k - 1];
  }
  for (std::size_t order = 1; order < M; ++order) {
    for (std::size_t i = M - 1; i >= order; --i)
      divided[i] = (divided[i] - divided[i - 1]) / (node[i] - node[i - order]);
  }
  for (std::size_t i = M; i > 0; --i) {
    for (std::size_t k = M - 1; k > 0; --k) out[k] = out[k - 1] - node[i - 1] * out[k];
    out[0] = divided[i - 1] - node[i - 1] * out[0];
  }
  return out;
}

template <class T, std::size_t N>
T polynomial(const std::array<double, N>& c, const T& x) {
  T sum = T(c[N - 1]);
  for (std::size_t k = N - 1; k > 0; --k) sum = fma(sum, x, T(c[k - 1]));
  return sum;
}

}  // namespace lambert_sphere

/// p = 2/(3 pi^2) (sin t - t cos t), t the deflection in radians: spheres far larger than the wavelength whose surface
/// reflects all light by Lambert's law (Schoenberg 1929; Blinn 1982). Mean cosine -4/9: they send light back.
///
/// sin t - t cos t is (8/3) v^(3/2) 2F1(1/2, 1/2; 5/2; v) in v = (1 - mu)/2, where nothing cancels at t = 0; from the
/// other side, in u = 1 - v, the same function of u less pi mu. Whichever of u and v is at most 1/2 is `near` below.
template <class T>
struct LambertSphereLobe {
  static constexpr auto members() { return std::tuple<>{}; }

  T density(const Deflection<T>& d) const {
    const T near = near_end(d);
    return T(2.0 / (3.0 * square_of_pi)) * fma(T(std::numbers::pi), max(T(0.0), -d.mu), curl(near));
  }
  T cdf(const Deflection<T>& d) const {
    const T near = near_end(d), part = reach(near);
    return select(d.one_plus < d.one_minus, fma(d.one_plus * d.one_minus, T(2.0 / 3.0), part), T(1.0) - part);
  }
  T survival(const Deflection<T>& d) const {
    const T near = near_end(d), part = reach(near);
    return select(d.one_plus < d.one_minus, T(1.0) - fma(d.one_plus * d.one_minus, T(2.0 / 3.0), part), part);
  }

  /// Five sixths of all light goes back. There (8/3) u (1 - u) + reach(u) = xi, forward reach(v) = 1 - xi: a polynomial
  /// start (2e-4 and 1e-5 off) and Newton's steps, the slope being the density's.
  Deflection<T> sample(const T& xi) const {
    const T y = T(1.0) - xi;
    const auto back = xi < T(5.0 / 6.0);
    const T wanted = named("wanted", select(back, xi, y));
    // reach(v) ~ (4/(3 pi)) (32/15) v^(5/2) for small v.
    const T power = named("power", exp(T(0.4) * log(max(y, T(tiny)) * T(45.0 * std::numbers::pi / 128.0))));
    const T ahead = named("ahead", fma(fma(T(-0.00341197), power, T(-0.01409346)), power, T(1.0)));
    static constexpr std::array back_start{0.4453844,   0.0921817,   0.03208795, 0.011967,
                                           0.004934148, 0.008279094, 0.005075275};
    const T behind =
        named("behind", lambert_sphere::polynomial(back_start, fma(T(2.4), min(wanted, T(5.0 / 6.0)), T(-1.0))));
    const T start = named("start", select(back, wanted * behind, power * ahead * ahead));
    const auto newton = [&](const std::array<T, 1>& state) -> std::array<T, 1> {
      const T near = named("near", state[0]), far = named("far", T(1.0) - near);
      const T value = named("value", reach(near) + select(back, T(8.0 / 3.0) * near * far, T(0.0)) - wanted);
      const T slope = named("slope", curl(near) + select(back, T(std::numbers::pi) * (far - near), T(0.0)));
      return {max(T(0.0), near - value / max(T(8.0 / (3.0 * std::numbers::pi)) * slope, T(tiny)))};
    };
    const T near = named("end", iterate(is_double<T> ? 3 : 1, std::array<T, 1>{start}, newton)[0]);
    const T zero(0.0), far = named("far", T(1.0) - near);
    return Deflection<T>::from_halves(select(back, select(xi > zero, near, zero), far),
                                      select(back, far, select(y > zero, near, zero)));
  }

  /// chi_1 = -4/9, no other odd ones; chi_l = 4 a_l / ((l - 1)^2 (l + 2)^2), a_l = ((l - 1)!!/l!!)^2: the even part of
  /// sin t - t cos t has the second derivative 1/sqrt(1 - mu^2), whose moments are pi a_l.
  T moment(int l) const {
    if (l % 2 == 1) return T(l == 1 ? -4.0 / 9.0 : 0.0);
    double a = 1.0;
    for (int k = 2; k <= l; k += 2) a *= (k - 1.0) * (k - 1.0) / (static_cast<double>(k) * k);
    return T(4.0 * a / ((l - 1.0) * (l - 1.0) * (l + 2.0) * (l + 2.0)));
  }

 private:
  static constexpr double square_of_pi = std::numbers::pi * std::numbers::pi;
  static constexpr double tiny = is_double<T> ? 1e-250 : 1e-36;
  /// At 1/2 the terms have fallen to 2^-k / k^2, those of Chebyshev to 6^-k / k^2.
  static constexpr std::size_t terms = is_double<T> ? 20 : 9;
  static constexpr std::array<double, terms> series(bool integrated) {
    return lambert_sphere::economised<terms>(lambert_sphere::series<60>(integrated));
  }

  static T near_end(const Deflection<T>& d) { return named("near", T(0.5) * min(d.one_plus, d.one_minus)); }
  /// Bounded away from 0, where the root has no derivative; x takes it to 0 all the same.
  static T root_of(const T& x) { return named("root", sqrt(max(x, T(tiny)))); }
  /// sin t - t cos t of the deflection with sin^2(t/2) = x <= 1/2.
  static T curl(const T& x) {
    static constexpr auto c = series(false);
    return named("curl", T(8.0 / 3.0) * x * root_of(x) * lambert_sphere::polynomial(c, x));
  }
  /// 4 pi times the integral of p from 0 to x of that part.
  static T reach(const T& x) {
    static constexpr auto c = series(true);
    return named("reach", T(64.0 / (9.0 * std::numbers::pi)) * x * x * root_of(x) * lambert_sphere::polynomial(c, x));
  }
};

}  // namespace tyndall
