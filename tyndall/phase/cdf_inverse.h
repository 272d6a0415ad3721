#pragma once
// Inversion of a cumulative distribution that has no inverse in closed form.
#include <array>

#include "tyndall/phase/deflection.h"

namespace tyndall {

/// As far as log-odds ln((1 + mu)/(1 - mu)) go: exp() of them is finite and the halves are normal numbers.
template <class T>
constexpr double log_odds_reach = is_double<T> ? 600.0 : 80.0;
/// The least share of light that is told from none.
template <class T>
constexpr double least_share = is_double<T> ? 1e-250 : 1e-34;

template <class T>
T log_odds(const Deflection<T>& d) {
  const T tiny = T(least_share<T>);
  return log(max(d.one_plus, tiny)) - log(max(d.one_minus, tiny));
}

/// The deflection with law.cdf(d) = xi, xi in [0, 1], between the log-odds `least` and `greatest`; xi = 0 gives mu =
/// -1, and the result never decreases with xi (but for rounding in the last digits).
///
/// In the log-odds s = ln((1 + mu)/(1 - mu)) the log-odds of F are nearly straight toward both ends and bent only where
/// one lobe takes over from another, so Newton's steps on ln(F/xi) = ln((1 - F)/(1 - xi)), with dF/ds = pi p (1 - mu)(1
/// + mu), are long and safe; where one is not, the bracket is halved. The count is fixed. The last step is applied to
/// 1 -+ mu themselves, so that they do not inherit the rounding of s.
template <class T, class Distribution>
Deflection<T> inverse_of_cdf(const Distribution& law, const T& xi, const T& least, const T& greatest, const T& start,
                             int steps) {
  const T tiny = T(least_share<T>);
  const T below_wanted = named("below_wanted", max(xi, tiny));
  const T above_wanted = named("above_wanted", max(T(1.0) - xi, tiny));

  const auto refine = [&](const std::array<T, 6>& state) -> std::array<T, 6> {
    const T low = named("low", state[0]), high = named("high", state[1]), s = named("s", state[2]);
    const T last = named("last", state[3]);
    const Deflection<T> d = Deflection<T>::from_ends(T(2.0) / (T(1.0) + exp(s)), T(2.0) / (T(1.0) + exp(-s)));
    const T below = named("below", max(law.cdf(d), tiny)), above = named("above", max(law.survival(d), tiny));
    const T excess = named("excess", log(below / below_wanted) - log(above / above_wanted));
    const T slope = named("slope", pi<T>() * law.density(d) * d.one_minus * d.one_plus);
    const T ds = named("ds", -excess * below * above / max(slope, tiny));

    const T new_low = named("new_low", select(excess < T(0.0), s, low));
    const T new_high = named("new_high", select(excess < T(0.0), high, s));
    const T middle = named("middle", T(0.5) * (new_low + new_high));
    // Newton's step counts if it stays inside and is at most half as long as the one before (or tiny): else it may go
    // to and fro between the two sides of a bend for ever.
    const T newton = named("newton", select(abs(ds) > max(T(0.5) * last, T(0.01)), middle, s + ds));
    const T next = named("next", select(newton < new_low, middle, select(newton > new_high, middle, newton)));
    const T small = named("small", T(0.5) * max(T(-0.01), min(T(0.01), ds)));
    return {new_low,
            new_high,
            next,
            abs(next - s),
            fma(d.one_minus, -small * d.one_plus, d.one_minus),
            fma(d.one_plus, small * d.one_minus, d.one_plus)};
  };
  const std::array<T, 6> initial{least, greatest, start, greatest - least, T(1.0), T(1.0)};
  const std::array<T, 6> end = iterate(steps, initial, refine);
  const T one_minus = named("minus", end[4]), one_plus = named("plus", end[5]);
  return Deflection<T>::from_ends(select(xi > T(0.0), select(xi < T(1.0), one_minus, T(0.0)), T(2.0)),
                                  select(xi > T(0.0), select(xi < T(1.0), one_plus, T(2.0)), T(0.0)));
}

}  // namespace tyndall
