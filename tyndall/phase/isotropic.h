#pragma once
// Isotropic scattering: every direction alike.
#include <string_view>
#include <tuple>

#include "tyndall/phase/lobe_sum.h"

namespace tyndall {

/// p = 1 / (4 pi). No parameters.
template <class T>
struct Isotropic {
  static constexpr std::string_view name = "isotropic";
  static constexpr std::string_view text = "Scatters alike in all directions.";
  static constexpr auto fields() { return std::tuple<>{}; }
  LobeSum<T> lower() const { return {{{T(1.0), IsotropicLobe<T>{}}}}; }
};

}  // namespace tyndall
