#pragma once
// What kinds of member a field may have, recognised by type: the vocabulary shared by all that walks descriptions.
//
// A described struct lists its fields():           static constexpr auto fields() { return std::tuple{Field{...}, ...};
// } A one-of is an enum with its words beside it:    constexpr auto words_of(Air) { return std::array{"none"sv,
// "note"sv}; } A choice is a std::variant of described structs, told apart in files in one of two ways:
//   by name: a key names the alternative, which says its own name:  template <> inline constexpr std::string_view
//            choice_key<Profile> = "law";  and  static constexpr std::string_view name = "box";  in BoxProfile
//   by form (no choice_key): the alternative whose first field is present, as {"visibility": 600}; one that says
//            static constexpr bool bare = true;  is written as its first field's value alone, as 600
// A struct that is one thing, not dials that could stand between those of another, says
//   static constexpr bool whole = true;  and has ==
// A struct with demands that no single field can state has, found by argument-dependent lookup,
//   std::optional<Objection> objection_to(const TheStruct&);
//
// and beside it demands_of() (demand.h) for those of them that a JSON Schema can state.
#include <array>
#include <concepts>
#include <cstdio>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "tyndall/number/field.h"
#include "tyndall/number/one_or_more.h"

namespace tyndall {

/// What is wrong with a value as a whole: the field to name ("" for the struct itself; may be a path "veil/density"),
/// what was found and what was possible, in the words of messages.
struct Objection {
  std::string field, found, expected;
};

/// A number as messages say it: 600, 0.0001, 1.36e-05.
inline std::string short_number(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", x);
  return text;
}

/// A field's description without its owner's type.
struct FieldFacts {
  std::string_view name;
  Range range;
  std::string_view unit, text;
  Scaling scaling = Scaling::none;
  bool required = false;
};
template <class Owner, class Member>
constexpr FieldFacts facts_of(const Field<Owner, Member>& f) {
  return {f.name, f.range, f.unit, f.text, f.scaling, f.required};
}

/// The key whose text names the alternative of a choice; empty: told apart by form.
template <class Variant>
inline constexpr std::string_view choice_key{};

template <class T>
concept Described = requires {
  T::fields();
};
template <class T>
concept OneOf = std::is_enum_v<T> && requires(T x) {
  words_of(x);
};

template <class T>
concept Whole = requires {
  T::whole;
};

namespace kind {
template <class T>
inline constexpr bool is_optional = false;
template <class T>
inline constexpr bool is_optional<std::optional<T>> = true;
template <class T>
inline constexpr bool is_list = false;
template <class T>
inline constexpr bool is_list<std::vector<T>> = true;
template <class T>
inline constexpr bool is_one_or_more = false;
template <class T>
inline constexpr bool is_one_or_more<OneOrMore<T>> = true;
template <class T>
inline constexpr bool is_array = false;
template <class T, std::size_t N>
inline constexpr bool is_array<std::array<T, N>> = true;
template <class T>
inline constexpr bool is_choice = false;
template <class... T>
inline constexpr bool is_choice<std::variant<T...>> = true;
}  // namespace kind

template <class T>
concept OptionalMember = kind::is_optional<T>;
template <class T>
concept ListMember = kind::is_list<T>;
template <class T>
concept OneOrMoreMember = kind::is_one_or_more<T>;
template <class T>
concept ArrayMember = kind::is_array<T>;
template <class T>
concept Choice = kind::is_choice<T>;
template <class T>
concept NamedChoice = Choice<T> && !choice_key<T>.empty();

/// True for an alternative that may be written as the value of its first field alone.
template <class T>
constexpr bool is_bare() {
  if constexpr (requires { T::bare; }) {
    return T::bare;
  } else {
    return false;
  }
}

/// The type and the facts of a described struct's first field.
template <Described T>
using FirstMember = std::remove_cvref_t<decltype(std::declval<T&>().*(std::get<0>(T::fields()).member))>;
template <Described T>
constexpr std::string_view first_field_name() {
  return std::get<0>(T::fields()).name;
}

/// Calls visit(std::type_identity<Alternative>{}) for each alternative of a choice, in order.
template <Choice V, class Visit>
constexpr void for_each_alternative(Visit&& visit) {
  [&]<class... T>(std::type_identity<std::variant<T...>>) {
    (visit(std::type_identity<T>{}), ...);
  }(std::type_identity<V>{});
}

}  // namespace tyndall
