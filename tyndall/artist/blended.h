#pragma once
// The three ways to blend, by name.
#include <array>
#include <string_view>

#include "tyndall/artist/morph.h"

namespace tyndall {

/// The dials (blend.h), the media (mix.h), or as the eye judges thickness (morph.h).
enum class BlendHow { interpolate, mix, morph };
constexpr std::array<std::string_view, 3> words_of(BlendHow) { return {"interpolate", "mix", "morph"}; }

/// The dials at t in [0, 1] between those of a and b, all in units of `meters_per_unit` metres; exactly a at 0 and b at
/// 1.
inline Blend blended(const MediumDials& a, const MediumDials& b, double t, BlendHow how, double meters_per_unit = 1.0) {
  // interpolate needs no metres, and so dials stay the numbers that were typed.
  if (how == BlendHow::interpolate) return interpolate(a, b, t, meters_per_unit);
  if (t == 0.0) return a;
  if (t == 1.0) return b;
  Blend blend = (how == BlendHow::mix ? mix : morph)(in_metres(a, meters_per_unit), in_metres(b, meters_per_unit), t);
  if (auto* dials = std::get_if<MediumDials>(&blend)) *dials = in_metres(*dials, 1.0 / meters_per_unit);
  return blend;
}

}  // namespace tyndall
