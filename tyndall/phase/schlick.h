#pragma once
// Schlick's law: one lobe, forward or backward.
#include <string_view>
#include <tuple>

#include "tyndall/number/field.h"
#include "tyndall/phase/lobe_sum.h"

namespace tyndall {

/// p = (1 - k^2) / (4 pi (1 - k mu)^2) (Blasi, Le Saec and Schlick 1993). k is not the mean cosine, which is
/// [(1 - k^2) ln((1 - k)/(1 + k)) + 2k] / (2 k^2). The triplets published for mental ray and by Glassner are lobes of
/// this law.
template <class T>
struct Schlick {
  static constexpr std::string_view name = "schlick";
  static constexpr std::string_view text = "One lobe, forward or backward, cheaper than Henyey-Greenstein.";
  T k = T(0.0);
  static constexpr auto fields() {
    return std::tuple{Field{"k", &Schlick::k, Range{-1.0, 1.0, true, true}, "1",
                            "Lengthening of the lobe: above 0 forward, below 0 backward.", Scaling::none, true}};
  }
  SchlickLobe<T> lobe() const { return SchlickLobe<T>::of(k); }
  LobeSum<T> lower() const { return {{{T(1.0), lobe()}}}; }
};

}  // namespace tyndall
