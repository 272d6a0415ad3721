#pragma once
// Henyey-Greenstein: one parameter from backward to forward.
#include <string_view>
#include <tuple>

#include "tyndall/number/field.h"
#include "tyndall/phase/lobe_sum.h"

namespace tyndall {

/// Henyey and Greenstein 1941 (henyey_greenstein_lobe.h). g is the mean cosine, -1 < g < 1, exclusive.
template <class T>
struct HenyeyGreenstein {
  static constexpr std::string_view name = "henyey_greenstein";
  static constexpr std::string_view text = "One lobe from backward (g < 0) over isotropic (0) to forward (g > 0).";
  T g = T(0.0);
  static constexpr auto fields() {
    return std::tuple{Field{"g", &HenyeyGreenstein::g, Range{-1.0, 1.0, true, true}, "1",
                            "Mean cosine of the deflection; positive scatters forward."}};
  }
  HenyeyGreensteinLobe<T> lobe() const { return HenyeyGreensteinLobe<T>::of(g); }
  LobeSum<T> lower() const { return {{{T(1.0), lobe()}}}; }
};

}  // namespace tyndall
