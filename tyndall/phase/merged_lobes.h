#pragma once
// Equal lobes of a sum made one: a mixture may name the same lobe any number of times, and every lobe costs at every
// collision.
#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "tyndall/number/scalar.h"
#include "tyndall/phase/lobe_record.h"

namespace tyndall {

/// What tells lobes apart: kind and the bits of the parameters (0.0 and -0.0 being one value), of a table its
/// fingerprint. Bits, because they order whatever a parameter holds.
template <Scalar T>
std::array<std::uint64_t, most_lobe_parameters + 1> lobe_key(const Lobe<T>& lobe) {
  std::array<std::uint64_t, most_lobe_parameters + 1> key{lobe.index()};
  std::size_t i = 1;
  std::visit(
      [&](const auto& l) {
        for_each_parameter(l, l, [&]<class Member>(Member& x, Member&) {
          if constexpr (std::is_same_v<Member, const SharedTable>) {
            key[i++] = x->fingerprint();
          } else {
            key[i++] = std::bit_cast<std::uint64_t>(static_cast<double>(x) + 0.0);
          }
        });
      },
      lobe);
  return key;
}

/// Whether two lobes of equal keys are equal: fingerprints of different tables may coincide.
template <Scalar T>
bool same_tables(const Lobe<T>& a, const Lobe<T>& b) {
  const auto* const x = std::get_if<TableLobe<T>>(&a);
  const auto* const y = std::get_if<TableLobe<T>>(&b);
  return x == nullptr || y == nullptr || x->table == y->table || *x->table == *y->table;
}

/// The same sum with each lobe once, where it first stood, its weights added. Lobes are equal when kind and parameters
/// are, exactly. O(n log n). For plain numbers only: a number that carries derivatives or text has no value to compare.
template <Scalar T>
LobeSum<T> merged(LobeSum<T> lobes) {
  if (lobes.size() < 2) return lobes;
  using Place = std::pair<std::array<std::uint64_t, most_lobe_parameters + 1>, std::size_t>;
  std::vector<Place> places;
  places.reserve(lobes.size());
  for (std::size_t i = 0; i < lobes.size(); ++i) places.emplace_back(lobe_key<T>(lobes[i].lobe), i);
  std::sort(places.begin(), places.end());
  std::vector<bool> kept(lobes.size(), false);
  std::size_t first = 0;
  for (const auto& [key, place] : places) {  // of equal keys the one that stood first comes first
    if (place == places.front().second || key != lobe_key<T>(lobes[first].lobe) ||
        !same_tables<T>(lobes[first].lobe, lobes[place].lobe)) {
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
