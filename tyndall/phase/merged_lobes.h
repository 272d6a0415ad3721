#pragma once
// Equal lobes of a sum made one: a mixture may name the same lobe any number of times, and every lobe costs at every
// collision.
#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

#include "tyndall/number/scalar.h"
#include "tyndall/phase/lobe_sum.h"

namespace tyndall {

/// What tells lobes apart: kind and the bits of the parameters (0.0 and -0.0 being one value). Bits, because they order
/// whatever a parameter holds.
template <Scalar T>
std::array<std::uint64_t, 3> lobe_key(const Lobe<T>& lobe) {
  const auto bits = [](T x) { return std::bit_cast<std::uint64_t>(static_cast<double>(x) + 0.0); };
  std::array<std::uint64_t, 3> key{lobe.index(), 0, 0};
  std::visit(
      [&](const auto& l) {
        using Kind = std::decay_t<decltype(l)>;
        if constexpr (std::is_same_v<Kind, RayleighLobe<T>>) {
          key[1] = bits(l.gamma);
        } else if constexpr (std::is_same_v<Kind, HenyeyGreensteinLobe<T>>) {
          key[1] = bits(l.g);
          key[2] = bits(l.complement);
        } else if constexpr (std::is_same_v<Kind, PowerLobe<T>>) {
          key[1] = static_cast<std::uint64_t>(l.n);
        } else {
          static_assert(std::is_same_v<Kind, IsotropicLobe<T>>, "a new lobe says here what tells it apart");
        }
      },
      lobe);
  return key;
}

/// The same sum with each lobe once, where it first stood, its weights added. Lobes are equal when kind and parameters
/// are, exactly. O(n log n). For plain numbers only: a number that carries derivatives or text has no value to compare.
template <Scalar T>
LobeSum<T> merged(LobeSum<T> lobes) {
  if (lobes.size() < 2) return lobes;
  using Place = std::pair<std::array<std::uint64_t, 3>, std::size_t>;
  std::vector<Place> places;
  places.reserve(lobes.size());
  for (std::size_t i = 0; i < lobes.size(); ++i) places.emplace_back(lobe_key<T>(lobes[i].lobe), i);
  std::sort(places.begin(), places.end());
  std::vector<bool> kept(lobes.size(), false);
  std::size_t first = 0;
  for (const auto& [key, place] : places) {  // of equal keys the one that stood first comes first
    if (place == places.front().second || key != lobe_key<T>(lobes[first].lobe)) {
      first = place;
      kept[place] = true;
    } else {
      lobes[first].weight += lobes[place].weight;
    }
  }
  std::size_t count = 0;
  for (std::size_t i = 0; i < lobes.size(); ++i) {
    if (kept[i]) lobes[count++] = lobes[i];
  }
  lobes.erase(lobes.begin() + static_cast<std::ptrdiff_t>(count), lobes.end());
  return lobes;
}

}  // namespace tyndall
