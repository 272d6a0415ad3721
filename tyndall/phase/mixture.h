#pragma once
// A weighted sum of any laws.
#include <string_view>
#include <tuple>
#include <vector>

#include "tyndall/number/field.h"
#include "tyndall/phase/lobe_sum.h"

namespace tyndall {

template <class T>
struct MixturePart;

/// p = sum_i weight_i p_i / sum_i weight_i. At least one part; weights >= 0, not all 0. Parts may be mixtures; all of
/// it flattens on lowering. (Weights per channel come from species: see medium/lowered_medium.h.)
template <class T>
struct Mixture {
  static constexpr std::string_view name = "mixture";
  static constexpr std::string_view text = "A weighted sum of other laws.";
  std::vector<MixturePart<T>> parts;
  static constexpr auto fields() {
    return std::tuple{Field{"parts", &Mixture::parts, any_number, "", "The laws that are added, each with its weight.",
                            Scaling::none, true}};
  }
  LobeSum<T> lower() const;  // in law.h, where a part's law is a complete type
};

}  // namespace tyndall
