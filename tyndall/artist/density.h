#pragma once
// The ways a person may say how dense something is; each means an extinction coefficient.
#include <string_view>
#include <tuple>
#include <variant>

#include "tyndall/color/spectrum.h"
#include "tyndall/number/field.h"

namespace tyndall {

/// Extinction coefficient sigma_t per channel, as a number or triplet alone: 1e-3.
struct PlainExtinction {
  static constexpr bool bare = true;
  Spectrum extinction;
  static constexpr auto fields() {
    return std::tuple{Field{"extinction", &PlainExtinction::extinction, not_negative, "1/m",
                            "Share of light lost per length of path.", Scaling::inverse_length, true}};
  }
};

/// {"extinction": 1e-3}.
struct StatedExtinction {
  Spectrum extinction;
  static constexpr auto fields() {
    return std::tuple{Field{"extinction", &StatedExtinction::extinction, not_negative, "1/m",
                            "Share of light lost per length of path.", Scaling::inverse_length, true}};
  }
};

/// {"mean_free_path": 1000}: the mean distance light travels before it is scattered or absorbed, 1 / sigma_t.
struct MeanFreePath {
  Spectrum mean_free_path = Spectrum::grey(1.0);
  static constexpr auto fields() {
    return std::tuple{Field{"mean_free_path", &MeanFreePath::mean_free_path, positive, "m",
                            "Mean distance that light travels undisturbed.", Scaling::length, true}};
  }
};

/// {"visibility": 3000}: the distance at which the contrast of a black object has fallen to `contrast`, -ln(contrast) /
/// sigma_t (Koschmieder 1924). 0.05 gives the meteorological optical range, 0.02 Koschmieder's own.
struct Visibility {
  Spectrum visibility = Spectrum::grey(1.0);
  double contrast = 0.05;
  static constexpr auto fields() {
    return std::tuple{
        Field{"visibility", &Visibility::visibility, positive, "m", "How far one can see.", Scaling::length, true},
        Field{"contrast", &Visibility::contrast, Range{0.0, 1.0, true, true}, "1",
              "Contrast that is still seen: 0.05 or 0.02."}};
  }
};

/// The closed list, told apart by form (number/described.h).
using Density = std::variant<PlainExtinction, StatedExtinction, MeanFreePath, Visibility>;

/// Extinction coefficient [1/m when the density is in metres].
inline Spectrum extinction_of(const Density& density) {
  struct Of {
    Spectrum operator()(const PlainExtinction& d) const { return d.extinction; }
    Spectrum operator()(const StatedExtinction& d) const { return d.extinction; }
    Spectrum operator()(const MeanFreePath& d) const { return Spectrum::grey(1.0) / d.mean_free_path; }
    Spectrum operator()(const Visibility& d) const { return Spectrum::grey(-std::log(d.contrast)) / d.visibility; }
  };
  return std::visit(Of{}, density);
}

}  // namespace tyndall
