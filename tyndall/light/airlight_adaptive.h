#pragma once
// Adaptive integration of airlight, for media without a closed form.
#include <span>
#include <vector>

#include "tyndall/color/spectrum.h"
#include "tyndall/light/gauss_legendre.h"

namespace tyndall {

/// int f over [breaks.front(), breaks.back()], f(x) -> Spectrum >= 0, smooth between neighbouring breaks (rising).
/// Panels no longer than `longest`, each compared with its two halves and halved again until they agree to `tolerance`
/// of the whole, per channel; a channel below 1e-6 of the brightest counts as that much. Kinks and roots at unmarked
/// places only cost time. At most `budget` panels are halved: the integral then stays as good as it is. From a
/// tolerance of 1e-3 on the panels are taken as they come, a third of the work.
template <class F>
Spectrum integrate_adaptively(std::span<const double> breaks, double longest, double tolerance, const F& f,
                              int budget = 20000) {
  struct Panel {
    double begin, end;
    int depth;
    Spectrum value;
  };
  std::vector<Panel> open;
  Spectrum whole;
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    const double length = breaks[i + 1] - breaks[i];
    if (!(length > 0.0)) continue;
    const int count = std::max(1, static_cast<int>(std::ceil(length / longest)));
    for (int k = 0; k < count; ++k) {
      const double begin = breaks[i] + length * k / count;
      const double end = k + 1 == count ? breaks[i + 1] : breaks[i] + length * (k + 1) / count;
      open.push_back({begin, end, 0, gauss_legendre_16(begin, end, f)});
      whole += open.back().value;
    }
  }
  if (tolerance >= 1e-3) return whole;
  Spectrum sum;
  while (!open.empty()) {
    const Panel p = open.back();
    open.pop_back();
    const double middle = 0.5 * (p.begin + p.end);
    const Spectrum left = gauss_legendre_16(p.begin, middle, f), right = gauss_legendre_16(middle, p.end, f);
    const Spectrum both = left + right;
    bool agree = p.depth >= 50 || budget <= 0;
    if (!agree) {
      agree = true;
      const double least = 1e-6 * largest(whole);
      for (std::size_t c = 0; c < channel_count; ++c) {
        const double allowed = tolerance * std::max({whole[c], sum[c], least});
        agree = agree && std::fabs(both[c] - p.value[c]) <= allowed;
      }
    }
    if (agree) {
      sum += both;
    } else {
      --budget;
      open.push_back({p.begin, middle, p.depth + 1, left});
      open.push_back({middle, p.end, p.depth + 1, right});
    }
  }
  return sum;
}

}  // namespace tyndall
