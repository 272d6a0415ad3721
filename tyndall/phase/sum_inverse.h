#pragma once
// Exact monotone sampling of a sum of lobes: the inverse of its cumulative distribution.
#include "tyndall/phase/cdf_inverse.h"
#include "tyndall/phase/lobe_sum.h"

namespace tyndall {

/// The deflection with cdf(lobes, d) = xi, xi in [0, 1]; xi = 0 gives mu = -1, and the result never decreases with xi
/// (but for rounding in the last digits). xi is 0 or at least 1e-12 (float) or 1e-100 (double); where the lobes leave a
/// gap in mu, rounding of F decides.
///
/// A mixture's quantile lies between the least and the greatest quantile of its parts, which brackets the root
/// (cdf_inverse.h). 13 steps in float, 25 in double: of 2,000,000 random mixtures up to |g| = 0.9999 seven were off
/// after 11 and none after 12.
template <class T>
Deflection<T> sample(const LobeSum<T>& lobes, const T& xi) {
  if (lobes.size() == 1) {
    return std::visit([&](const auto& lobe) { return lobe.sample(xi); }, lobes.front().lobe);
  }
  const T reach(log_odds_reach<T>);
  T least = reach, greatest = -reach;
  for (const auto& part : lobes) {
    const Deflection<T> d = std::visit([&](const auto& lobe) { return lobe.sample(xi); }, part.lobe);
    const T s = named("quantile", log_odds(d));
    least = min(least, s);
    greatest = max(greatest, s);
  }
  // With a margin, so that a root at an end (parts alike, or of no weight) is inside.
  least = named("least", max(-reach, least - T(0.01)));
  greatest = named("greatest", min(reach, greatest + T(0.01)));

  struct Sum {
    const LobeSum<T>& lobes;
    T density(const Deflection<T>& d) const { return tyndall::density(lobes, d); }
    T cdf(const Deflection<T>& d) const { return tyndall::cdf(lobes, d); }
    T survival(const Deflection<T>& d) const { return tyndall::survival(lobes, d); }
  };
  return inverse_of_cdf(Sum{lobes}, xi, least, greatest, T(0.5) * (least + greatest), is_double<T> ? 25 : 13);
}

}  // namespace tyndall
