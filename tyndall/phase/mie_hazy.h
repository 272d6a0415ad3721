#pragma once
// Mie-hazy, the note's law for hazy air.
#include <string_view>
#include <tuple>

#include "tyndall/phase/flat_and_power.h"

namespace tyndall {

/// p = (1/(4 pi)) (1/2 + 9/2 ((1 + mu)/2)^8): Nishita, Miyawaki and Nakamae 1987, as normalised in Hoobler's note. Mean
/// cosine 2/5, moments in power_lobe.h; moments beyond l = 8 vanish.
template <class T>
struct MieHazy {
  static constexpr std::string_view name = "mie_hazy";
  static constexpr std::string_view text = "Light haze: half isotropic, half a broad forward lobe.";
  static constexpr int exponent = 8;
  static constexpr FlatAndPowerStart start{
      0.1,
      0.38,
      {0.997269, -0.0125451, -0.0247435, -0.0243911, -0.0075407, 0.00577272, 0.00385275},
      {0.917812, 0.11216, -0.0446644, 0.0222215, -0.0132572, 0.00931597, -0.00359796}};
  static constexpr auto fields() { return std::tuple<>{}; }
  LobeSum<T> lower() const { return flat_and_power_lobes<T>(0.5, exponent); }
  Deflection<T> sample(const T& xi) const { return flat_and_power_sample<T>(0.5, exponent, start, xi); }
};

}  // namespace tyndall
