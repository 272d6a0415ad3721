#pragma once
// The murky law as Nishita, Miyawaki and Nakamae printed it.
#include <string_view>
#include <tuple>

#include "tyndall/phase/flat_and_power.h"

namespace tyndall {

/// p = K/(4 pi) (1 + 50 ((1 + mu)/2)^32) with K = 33/83: Nishita, Miyawaki and Nakamae 1987, whose 1 + 50 cos^64(t/2)
/// leaves K open; 1 + 50/33 is its mean over the sphere. The note's mie_murky has 33 for the 50 and half its weight in
/// the lobe; this one has 50/83. Mean cosine (50/83)(32/34) = 0.5670.
template <class T>
struct NishitaMurky {
  static constexpr std::string_view name = "nishita_murky";
  static constexpr std::string_view text =
      "Murk as first published: a stronger forward lobe than the note's mie_murky.";
  static constexpr int exponent = 32;
  static constexpr double flat = 33.0 / 83.0;
  static constexpr FlatAndPowerStart start{
      0.3,
      0.42,
      {0.973779, -0.0727458, -0.0490024, 0.0212961, 0.0187654, -0.00936296, -0.00441778},
      {0.981032, 0.0263678, -0.0113132, 0.00306047, -0.000471368, 0.00652014, -0.00524351}};
  static constexpr auto fields() { return std::tuple<>{}; }
  LobeSum<T> lower() const { return flat_and_power_lobes<T>(flat, exponent); }
  Deflection<T> sample(const T& xi) const { return flat_and_power_sample<T>(flat, exponent, start, xi); }
};

}  // namespace tyndall
