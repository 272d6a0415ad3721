#pragma once
// Rayleigh scattering: particles far smaller than the wavelength, air above all.
#include <string_view>
#include <tuple>

#include "tyndall/number/field.h"
#include "tyndall/phase/lobe_sum.h"

namespace tyndall {

/// Rayleigh's law with depolarisation (rayleigh_lobe.h). The colour of the sky is in the scattering coefficient, not
/// here.
template <class T>
struct Rayleigh {
  static constexpr std::string_view name = "rayleigh";
  static constexpr std::string_view text =
      "Scattering by particles far smaller than the wavelength, such as clear air.";
  T depolarisation = T(0.0);
  static constexpr auto fields() {
    return std::tuple{Field{"depolarisation", &Rayleigh::depolarisation, Range{0.0, 1.0, false, true}, "1",
                            "Depolarisation ratio; 0 for ideal molecules, about 0.028 for air."}};
  }
  RayleighLobe<T> lobe() const { return {named("gamma", depolarisation / (T(2.0) - depolarisation))}; }
  LobeSum<T> lower() const { return {{{T(1.0), lobe()}}}; }
};

}  // namespace tyndall
