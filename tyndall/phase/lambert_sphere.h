#pragma once
// Large matt spheres: coarse dust, snow grains, the moon.
#include <string_view>
#include <tuple>

#include "tyndall/phase/lobe_sum.h"

namespace tyndall {

/// p = 2/(3 pi^2) (sin t - t cos t), t the deflection (lambert_sphere_lobe.h): spheres that reflect by Lambert's law
/// (Schoenberg 1929; Blinn 1982). Mean cosine -4/9.
template <class T>
struct LambertSphere {
  static constexpr std::string_view name = "lambert_sphere";
  static constexpr std::string_view text = "Large matt spheres, which send most light back.";
  static constexpr auto fields() { return std::tuple<>{}; }
  LobeSum<T> lower() const { return {{{T(1.0), LambertSphereLobe<T>{}}}}; }
};

}  // namespace tyndall
