#pragma once
// A list of which one element may stand for itself: where several are the exception, files need no brackets.
#include <cassert>
#include <concepts>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

namespace tyndall {

/// 1 to `most` elements. In files one is written as itself, several as a list; a list of one is read too, and means the
/// same. A field's facts are those of its elements.
template <class T>
struct OneOrMore {
  static constexpr std::size_t most = 8;
  std::vector<T> all{T{}};

  OneOrMore() = default;
  /// One, from whatever becomes a T.
  template <std::convertible_to<T> U>
  requires(!std::same_as<std::remove_cvref_t<U>, OneOrMore>) OneOrMore(U&& one) : all{T(std::forward<U>(one))} {}
  /// Several; not none.
  OneOrMore(std::vector<T> several) : all(std::move(several)) { assert(!all.empty()); }

  bool operator==(const OneOrMore&) const = default;
};

}  // namespace tyndall
