#pragma once
// The lobe of Draine: Henyey and Greenstein's times 1 + alpha mu^2.
#include <tuple>

#include "tyndall/phase/henyey_greenstein_lobe.h"

namespace tyndall {

/// p = h(mu) (1 + alpha mu^2) / N with Henyey and Greenstein's h and N = 1 + alpha (1 + 2 g^2)/3 (Draine 2003, eq. 2).
/// -1 < g < 1, alpha >= 0; `complement` is 1 - |g|. alpha = 0 is Henyey-Greenstein, 1 Cornette-Shanks; with g = 0,
/// alpha = 1 is Rayleigh.
template <class T>
struct DraineLobe {
  T g = T(0.0);
  T complement = T(1.0);
  T alpha = T(1.0);

  static DraineLobe of(const T& g, const T& alpha) { return {g, named("complement", T(1.0) - abs(g)), alpha}; }
  static constexpr auto members() { return std::tuple{&DraineLobe::g, &DraineLobe::complement, &DraineLobe::alpha}; }

  T density(const Deflection<T>& d) const { return base().density(d) * fma(alpha * d.mu, d.mu, T(1.0)) * share(); }

  /// F = H(mu) (1 + alpha m(mu)) / N: H is the cumulative distribution of h, m the mean of mu^2 below (mean_square).
  T cdf(const Deflection<T>& d) const {
    const T r = distance(d);
    const T below = one_minus(T(1.0)) * d.one_plus / (r * (one_plus(T(1.0)) + r));
    return below * fma(alpha, mean_square(T(1.0), d, r), T(1.0)) * share();
  }
  T survival(const Deflection<T>& d) const {
    const T r = distance(d);
    const T above = one_plus(T(1.0)) * d.one_minus / (r * (one_minus(T(1.0)) + r));
    return above * fma(alpha, mean_square(T(-1.0), {-d.mu, d.one_plus, d.one_minus}, r), T(1.0)) * share();
  }
  /// Both and the density, with two divisions for five.
  Passage<T> passage(const Deflection<T>& d) const {
    const T r = distance(d), minus = one_minus(T(1.0)), plus = one_plus(T(1.0)), a = fma(g, g, T(1.0));
    const T before = minus + r, behind = plus + r, here = T(1.0) / (r * before * behind);
    const T sum_below = fma(r, plus, a), sum_above = fma(r, minus, a), inverse = T(1.0) / (sum_below * sum_above);
    const T m = mean_square(T(1.0), d, r, inverse * sum_above);
    const T n = mean_square(T(-1.0), {-d.mu, d.one_plus, d.one_minus}, r, inverse * sum_below);
    const T scale = share(), inverse_r = before * behind * here;
    const T base = complement * (T(1.0) + abs(g)) * inverse_four_pi<T>() * scale * inverse_r;
    return {minus * scale * d.one_plus * (here * before) * fma(alpha, m, T(1.0)),
            plus * scale * d.one_minus * (here * behind) * fma(alpha, n, T(1.0)),
            base * (inverse_r * inverse_r) * fma(alpha * d.mu, d.mu, T(1.0))};
  }

  /// Solves t (1 + alpha m(mu(t))) = N xi for t, where mu(t) is the exact inverse of H; xi > 1/2 is solved in the
  /// mirror, so that both ends keep their digits. The left side is the integral of 1 + alpha mu(t)^2: nearly a cubic
  /// about the t0 where mu = 0. The cubic through t0 and the end of that side is the start; Halley's steps then need at
  /// most 4 in float and 5 in double for |g| <= 0.9999, alpha <= 1000 (one more is taken).
  Deflection<T> sample(const T& xi) const {
    const T y = T(1.0) - xi;
    const auto mirrored = xi > T(0.5);
    const T side = named("side", select(mirrored, T(-1.0), T(1.0)));  // times g: what is solved for
    const T minus = one_minus(side), plus = one_plus(side);
    const T wanted = named("wanted", normalisation() * select(mirrored, y, xi));
    const T least = named("least", wanted / (T(1.0) + alpha)), most = named("most", min(T(1.0), wanted));

    const T square = named("square", fma(g, g, T(1.0))), root = named("root", sqrt(square));
    const T middle = named("middle", minus / (root * (plus + root)));  // t0
    const T below = mean_square(side, {T(0.0), T(1.0), T(1.0)}, root);
    const T above = named("above", (fma(T(2.0) * g, g, T(1.0)) / T(3.0) - middle * below) / (T(1.0) - middle));
    const T at_middle = middle * fma(alpha, below, T(1.0));
    const T excess = named("excess", wanted - at_middle);
    const T span = named("span", select(excess < T(0.0), middle, T(1.0) - middle));
    // d + d^3/(3 c) = excess with alpha times the mean of mu^2 on that side = span^2/(3 c).
    const T c = named("c", span * span / max(T(3.0) * alpha * select(excess < T(0.0), below, above), T(1e-6)));
    const T root_c = named("root_c", sqrt(c));
    const T third = named("third", asinh(T(1.5) * excess / root_c) / T(3.0));
    const T start = fma(T(2.0) * root_c, sinh(third), middle);

    const auto halley = [&](const T& at) {
      const T t = named("t", at), rest = named("rest", T(1.0) - t);
      const T inverse = named("inverse", T(1.0) / fma(minus, rest, plus * t));
      const Deflection<T> d = ends_of(side, t, rest, minus * inverse, plus * inverse);
      const T r = named("distance", minus * plus * inverse);
      const T value = named("value", fma(alpha * mean_square(side, d, r), t, t) - wanted);
      const T slope = named("slope", fma(alpha * d.mu, d.mu, T(1.0)));
      const T curve = named("curve", T(4.0) * alpha * d.mu * r * r * r / (minus * plus));
      return t - named("halley", T(2.0) * value * slope / (T(2.0) * slope * slope - value * curve));
    };
    const auto inside = [&](const T& t) { return max(least, min(most, t)); };
    const auto turn = [&](const std::array<T, 1>& t) -> std::array<T, 1> { return {inside(halley(t[0]))}; };
    // The last step is free, so that derivatives are not those of the bounds.
    const T t = named("quantile", halley(iterate(is_double<T> ? 5 : 4, std::array<T, 1>{inside(start)}, turn)[0]));
    const T rest = named("rest", T(1.0) - t);
    const T inverse = named("inverse", T(1.0) / fma(minus, rest, plus * t));
    const Deflection<T> d = ends_of(side, t, rest, minus * inverse, plus * inverse);
    return Deflection<T>::from_ends(select(mirrored, d.one_plus, d.one_minus),
                                    select(mirrored, d.one_minus, d.one_plus));
  }

  /// chi_l = (g^l + alpha M_l) / N, where mu^2 P_l = A P_{l+2} + B P_l + C P_{l-2} gives M_l = A g^{l+2} + B g^l + C
  /// g^{l-2}.
  T moment(int l) const {
    const double below = 2.0 * l - 1.0, here = 2.0 * l + 1.0, above = 2.0 * l + 3.0;
    const double a = (l + 1.0) * (l + 2.0) / (here * above), c = l * (l - 1.0) / (here * below);
    const double b = (l + 1.0) * (l + 1.0) / (here * above) + (l > 0 ? l * l / (here * below) : 0.0);
    T mean = T(a) * base().moment(l + 2) + T(b) * base().moment(l);
    if (l > 1) mean = mean + T(c) * base().moment(l - 2);
    return fma(alpha, mean, base().moment(l)) / normalisation();
  }

 private:
  HenyeyGreensteinLobe<T> base() const { return {g, complement}; }
  T normalisation() const { return named("normalisation", fma(alpha, fma(T(2.0) * g, g, T(1.0)) / T(3.0), T(1.0))); }
  /// 1 -+ side g for side = 1 or, in the mirror, -1.
  T share() const { return named("share", T(1.0) / normalisation()); }
  T one_minus(const T& side) const {
    return named("one_minus_g", select(side * sign() < T(0.0), T(1.0) + abs(g), complement));
  }
  T one_plus(const T& side) const {
    return named("one_plus_g", select(side * sign() < T(0.0), complement, T(1.0) + abs(g)));
  }
  T sign() const { return select(g < T(0.0), T(-1.0), T(1.0)); }
  /// r with r^2 = 1 + g^2 - 2 g mu as a sum of positive terms.
  T distance(const Deflection<T>& d) const {
    const T from_peak = named("from_peak", select(g < T(0.0), d.one_plus, d.one_minus));
    return named("r", sqrt(fma(T(2.0) * abs(g), from_peak, complement * complement)));
  }
  /// The inverse of H at t = 1 - rest (henyey_greenstein_lobe.h), toward_back = (1 - g)/D, toward_front = (1 + g)/D.
  Deflection<T> ends_of(const T& side, const T& t, const T& rest, const T& toward_back, const T& toward_front) const {
    const T a = abs(g);
    const auto negative = side * sign() < T(0.0);
    const T inner_minus = named("inner_minus", select(negative, fma(a, rest, complement), fma(a, t, T(1.0))));
    const T inner_plus = named("inner_plus", select(negative, fma(a, rest, T(1.0)), fma(a, t, complement)));
    return Deflection<T>::from_ends(named("minus", T(2.0) * rest * toward_back * toward_back * inner_minus),
                                    named("plus", T(2.0) * t * toward_front * toward_front * inner_plus));
  }

  /// The mean of mu^2 under h over [-1, mu]. In A = 1 + g^2 and q = r (1 + g) it is
  ///   [ (1 - mu) s (q + 3 A)/3 + mu (A - q/3) ] / (A + q),  s = (A (1 - mu) - 2 g mu)/(A + q):
  /// the integral of mu^2 over the quantile is a polynomial in r, from which g^2 has been taken out by hand: the
  /// textbook's difference divided by g^3 has no digits left at small g. At g = 0 it is (1 - mu + mu^2)/3.
  T mean_square(const T& side, const Deflection<T>& d, const T& r) const {
    const T a = named("a", fma(g, g, T(1.0))), q = named("q", r * one_plus(side));
    return mean_square(side, d, r, named("inverse_sum", T(1.0) / (a + q)));
  }
  T mean_square(const T& side, const Deflection<T>& d, const T& r, const T& inverse_sum) const {
    const T plus = one_plus(side);
    const T a = named("a", fma(g, g, T(1.0))), q = named("q", r * plus);
    const T s = named("s", fma(-d.mu, plus * plus, a) * inverse_sum);
    const T wide = named("wide", s * fma(T(1.0 / 3.0), q, a)), narrow = named("narrow", fma(T(-1.0 / 3.0), q, a));
    return named("mean_square", fma(d.mu, narrow - wide, wide) * inverse_sum);
  }
};

}  // namespace tyndall
