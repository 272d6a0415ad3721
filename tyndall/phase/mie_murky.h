#pragma once
// Mie-murky, the note's law for murky air.
#include <string_view>
#include <tuple>

#include "tyndall/phase/flat_and_power.h"

namespace tyndall {

/// p = (1/(4 pi)) (1/2 + 33/2 ((1 + mu)/2)^32): Hoobler's note after Nishita, Miyawaki and Nakamae 1987. Mean cosine
/// 8/17. The note prints the exponent 3, with which the integral would be 1/2 + 33/8 = 4.625 (energy from nothing);
/// only 32 gives (33/2)/33 = 1/2. A test holds both figures.
template <class T>
struct MieMurky {
  static constexpr std::string_view name = "mie_murky";
  static constexpr std::string_view text = "Dense mist: half isotropic, half a narrow forward lobe.";
  static constexpr int exponent = 32;
  static constexpr FlatAndPowerStart start{
      0.3,
      0.48,
      {0.99971, -0.00143993, -0.0102733, -0.0318356, -0.0280674, 0.00827054, 0.0137309},
      {0.979303, 0.0298094, -0.0143661, 0.00264411, 0.000714166, 0.0113696, -0.00956249}};
  static constexpr auto fields() { return std::tuple<>{}; }
  LobeSum<T> lower() const { return flat_and_power_lobes<T>(0.5, exponent); }
  Deflection<T> sample(const T& xi) const { return flat_and_power_sample<T>(0.5, exponent, start, xi); }
};

}  // namespace tyndall
