#pragma once
// A lobe as plain numbers: what crosses from the program to a kernel, whose object shares no types with it.
#include "tyndall/phase/lobe_sum.h"

namespace tyndall {

/// The most numbers that a lobe may have as parameters.
inline constexpr std::size_t most_lobe_parameters = 4;

/// `kind` is the lobe's index in the Lobe list; parameters in the order of its members. A table is referred to, not
/// owned: the lobe that the record was made from must outlive it.
struct LobeRecord {
  int kind;
  float weight;
  float parameters[most_lobe_parameters];
  const ScatteringTable* table;
};

/// The index of a lobe in the list.
template <template <class> class L>
constexpr int lobe_kind() {
  return []<class... Each>(std::type_identity<std::variant<Each...>>) {
    int kind = 0;
    static_cast<void>(((std::is_same_v<Each, L<float>> || (++kind, false)) || ...));
    return kind;
  }(std::type_identity<Lobe<float>>{});
}

template <Scalar T>
LobeRecord lobe_record(const WeightedLobe<T>& part) {
  LobeRecord record{static_cast<int>(part.lobe.index()), static_cast<float>(part.weight), {}, nullptr};
  std::visit(
      [&]<template <class> class L>(const L<T>& lobe) {
        static_assert(std::tuple_size_v<decltype(L<T>::members())> <= most_lobe_parameters);
        std::size_t i = 0;
        for_each_parameter(lobe, lobe, [&]<class Member>(Member& x, Member&) {
          if constexpr (std::is_same_v<Member, const SharedTable>) {
            record.table = x.get();
          } else {
            record.parameters[i++] = static_cast<float>(x);
          }
        });
      },
      part.lobe);
  return record;
}

/// The lobe in another number, its parameters the same in every lane.
template <class T>
Lobe<T> lobe_of(const LobeRecord& record) {
  Lobe<T> lobe;
  int kind = 0;
  const auto fill = [&]<template <class> class L>(std::type_identity<L<T>>) {
    if (kind++ != record.kind) return;
    L<T> made;
    std::size_t i = 0;
    for_each_parameter(made, made, [&]<class Member>(Member& x, const Member&) {
      if constexpr (std::is_same_v<Member, SharedTable>) {
        x = SharedTable(SharedTable(), record.table);  // refers without owning: nothing is counted or freed
      } else {
        x = static_cast<Member>(record.parameters[i++]);
      }
    });
    lobe = made;
  };
  [&]<class... Each>(std::type_identity<std::variant<Each...>>) {
    (fill(std::type_identity<Each>{}), ...);
  }(std::type_identity<Lobe<T>>{});
  return lobe;
}

}  // namespace tyndall
