#pragma once
// Demands on a struct as a whole that a JSON Schema can state. objection_to() is what refuses; where a struct has
//
//   constexpr auto demands_of(const TheStruct&) { return std::array{some_of("a", "b"), not_both("a", "b")}; }
//
// beside it, found by argument-dependent lookup, the generated schema (document/schema.h) says the same to editors. A
// test holds the two against each other.
#include <array>
#include <cstddef>
#include <string_view>

namespace tyndall {

struct Demand {
  enum class Kind {
    some_of,       // at least one of the fields is written
    not_both,      // the first is not written beside the second
    needs,         // where the first is written, so is the second
    not_all_zero,  // of a list of numbers
    counts,        // the list has an element whose number, the second field, is above 0
    one_word_of,   // a text is one of the words
    sized          // where the list is written, it has from `least` to `most` elements
  };
  Kind kind = Kind::some_of;
  std::array<std::string_view, 8> names{};  // of fields (the first for one_word_of); unused ones are empty
  const std::string_view* words = nullptr;
  std::size_t word_count = 0;
  std::size_t least = 0, most = 0;
};

template <class... Name>
constexpr Demand some_of(Name... names) {
  return {Demand::Kind::some_of, {std::string_view(names)...}};
}
constexpr Demand not_both(std::string_view a, std::string_view b) { return {Demand::Kind::not_both, {a, b}}; }
constexpr Demand needs(std::string_view field, std::string_view other) { return {Demand::Kind::needs, {field, other}}; }
constexpr Demand not_all_zero(std::string_view field) { return {Demand::Kind::not_all_zero, {field}}; }
constexpr Demand counts(std::string_view list, std::string_view number) {
  return {Demand::Kind::counts, {list, number}};
}
/// `words` must outlive the demand.
template <std::size_t N>
constexpr Demand one_word_of(std::string_view field, const std::array<std::string_view, N>& words) {
  return {Demand::Kind::one_word_of, {field}, words.data(), N};
}

constexpr Demand sized(std::string_view list, std::size_t least, std::size_t most) {
  return {Demand::Kind::sized, {list}, nullptr, 0, least, most};
}

}  // namespace tyndall
