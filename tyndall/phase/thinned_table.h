#pragma once
// Fewer knots for the same table: shaders have no room for a hundred thousand.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <queue>
#include <vector>

#include "tyndall/phase/scattering_table.h"

namespace tyndall {

/// Knots of a table and what they leave out.
struct ThinnedKnots {
  TableKnots knots;
  /// The largest difference of density at any of the knots there were, relative to the density there (or to a
  /// thousandth of the isotropic one where that is more), both normalised; 0 when nothing was left out.
  double error = 0.0;
};

/// At most `most` (at least 2) of the knots: starting from both ends, the knot that the straight lines so far miss by
/// most comes next, by that measure. O(n log n) for tables that are not made to defeat it, O(n most) at worst.
inline ThinnedKnots thinned(const TableKnots& all, std::size_t most) {
  if (all.size() <= most) return {all, 0.0};
  double sum = 0.0;
  for (std::size_t k = 0; k + 1 < all.size(); ++k) sum += all.width(k) * 0.5 * (all.value[k] + all.value[k + 1]);
  const double floor = 1e-3 * 0.5 * sum;
  // From knot a to knot b in mu, seen from the end that keeps the digits.
  const auto between = [&](std::size_t a, std::size_t b) {
    return all.one_minus[a] < all.one_plus[a] ? all.one_minus[a] - all.one_minus[b] : all.one_plus[b] - all.one_plus[a];
  };
  const auto line_at = [&](std::size_t a, std::size_t b, std::size_t k) {
    const double left = between(a, k), right = between(k, b);
    return (all.value[a] * right + all.value[b] * left) / (left + right);
  };
  struct Gap {
    double error;
    std::size_t begin, end, worst;
    bool operator<(const Gap& other) const { return error < other.error; }
  };
  const auto gap = [&](std::size_t a, std::size_t b) {
    Gap out{-1.0, a, b, a};
    for (std::size_t k = a + 1; k < b; ++k) {
      const double error = std::fabs(line_at(a, b, k) - all.value[k]) / std::max(all.value[k], floor);
      if (error > out.error) out = {error, a, b, k};
    }
    return out;
  };
  std::vector<std::size_t> kept{0, all.size() - 1};
  std::priority_queue<Gap> gaps;
  gaps.push(gap(0, all.size() - 1));
  while (kept.size() < most) {
    const Gap widest = gaps.top();
    gaps.pop();
    kept.push_back(widest.worst);
    gaps.push(gap(widest.begin, widest.worst));
    gaps.push(gap(widest.worst, widest.end));
  }
  std::sort(kept.begin(), kept.end());

  ThinnedKnots out;
  for (const std::size_t k : kept) {
    out.knots.one_minus.push_back(all.one_minus[k]);
    out.knots.one_plus.push_back(all.one_plus[k]);
    out.knots.value.push_back(all.value[k]);
  }
  double thin_sum = 0.0;
  for (std::size_t i = 0; i + 1 < kept.size(); ++i)
    thin_sum += out.knots.width(i) * 0.5 * (out.knots.value[i] + out.knots.value[i + 1]);
  for (std::size_t i = 0; i + 1 < kept.size(); ++i) {
    for (std::size_t k = kept[i]; k <= kept[i + 1]; ++k) {
      const double here = k == kept[i] ? all.value[k] : line_at(kept[i], kept[i + 1], k);
      const double error = std::fabs(here * (sum / thin_sum) - all.value[k]) / std::max(all.value[k], floor);
      out.error = std::max(out.error, error);
    }
  }
  return out;
}

}  // namespace tyndall
