#pragma once
// Draine's law, of interstellar and other dust.
#include <string_view>
#include <tuple>

#include "tyndall/number/field.h"
#include "tyndall/phase/lobe_sum.h"

namespace tyndall {

/// p = (1/(4 pi)) (1 - g^2)/(1 + g^2 - 2 g mu)^(3/2) (1 + alpha mu^2)/(1 + alpha (1 + 2 g^2)/3) (Draine 2003, eq. 2).
/// Mean cosine g (1 + alpha (3 + 2 g^2)/5)/(1 + alpha (1 + 2 g^2)/3).
template <class T>
struct Draine {
  static constexpr std::string_view name = "draine";
  static constexpr std::string_view text = "Henyey-Greenstein with something of Rayleigh's law, as for dust.";
  T g = T(0.5);
  T alpha = T(1.0);
  static constexpr auto fields() {
    return std::tuple{Field{"g", &Draine::g, Range{-1.0, 1.0, true, true}, "1",
                            "Lengthening of the lobe: above 0 forward, below 0 backward.", Scaling::none, true},
                      Field{"alpha", &Draine::alpha, Range{0.0, 1e6}, "1",
                            "Weight of the squared cosine: 0 Henyey-Greenstein, 1 Cornette-Shanks."}};
  }
  DraineLobe<T> lobe() const { return DraineLobe<T>::of(g, alpha); }
  LobeSum<T> lower() const { return {{{T(1.0), lobe()}}}; }
};

}  // namespace tyndall
