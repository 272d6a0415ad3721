#pragma once
// Cornette and Shanks's law, of haze.
#include <string_view>
#include <tuple>

#include "tyndall/number/field.h"
#include "tyndall/phase/lobe_sum.h"

namespace tyndall {

/// p = (3/(8 pi)) (1 - g^2)/(2 + g^2) (1 + mu^2)/(1 + g^2 - 2 g mu)^(3/2) (Cornette and Shanks 1992, eq. 8): Draine's
/// law with alpha = 1. Goes over into Rayleigh's at g = 0. Mean cosine g (8 + 2 g^2)/5 / ((4 + 2 g^2)/3).
template <class T>
struct CornetteShanks {
  static constexpr std::string_view name = "cornette_shanks";
  static constexpr std::string_view text = "Henyey-Greenstein made to become Rayleigh's law for small particles.";
  T g = T(0.5);
  static constexpr auto fields() {
    return std::tuple{Field{"g", &CornetteShanks::g, Range{-1.0, 1.0, true, true}, "1",
                            "Lengthening of the lobe: above 0 forward, below 0 backward.", Scaling::none, true}};
  }
  DraineLobe<T> lobe() const { return DraineLobe<T>::of(g, T(1.0)); }
  LobeSum<T> lower() const { return {{{T(1.0), lobe()}}}; }
};

}  // namespace tyndall
