#pragma once
// Fournier and Forand's law, of natural waters.
#include <string_view>
#include <tuple>

#include "tyndall/number/field.h"
#include "tyndall/phase/lobe_sum.h"

namespace tyndall {

/// Particles of many sizes, as many as diameter^-slope, of refractive index n relative to the water (Fournier and
/// Forand 1994; fournier_forand_lobe.h). n = 1.10, slope = 3.5835 is Petzold's average ocean (Mobley, Sundman and Boss
/// 2002): mean cosine 0.930, 1.83 % scattered backward.
template <class T>
struct FournierForand {
  static constexpr std::string_view name = "fournier_forand";
  static constexpr std::string_view text = "Natural waters: particles of all sizes, a very sharp forward peak.";
  T n = T(1.1);
  T slope = T(3.5835);
  static constexpr auto fields() {
    return std::tuple{Field{"n", &FournierForand::n, Range{1.01, 1.5}, "1",
                            "Refractive index of the particles over that of the water.", Scaling::none, true},
                      Field{"slope", &FournierForand::slope, Range{3.1, 4.9}, "1",
                            "How quickly larger particles get fewer (Junge's exponent).", Scaling::none, true}};
  }
  FournierForandLobe<T> lobe() const { return FournierForandLobe<T>::of(n, slope); }
  LobeSum<T> lower() const { return {{{T(1.0), lobe()}}}; }
};

}  // namespace tyndall
