#pragma once
// Field descriptions: each parameter says its name, range, unit and meaning once, as constexpr text in its owner's
// header. Reading, writing, checking, command-line help and reference pages all follow from it.
#include <limits>
#include <string_view>
#include <tuple>

namespace tyndall {

/// The numbers a field admits; an open end is excluded.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool open_low = false, open_high = false;
  constexpr bool contains(double x) const {
    return (open_low ? x > low : x >= low) && (open_high ? x < high : x <= high);
  }
};
constexpr Range any_number{};
constexpr Range not_negative{0.0, std::numeric_limits<double>::infinity(), false, false};
constexpr Range positive{0.0, std::numeric_limits<double>::infinity(), true, false};
constexpr Range unit_interval{0.0, 1.0, false, false};

/// How a value changes with meters_per_unit: metres = value x m, 1/m = value / m; `none` is never scaled (degrees,
/// W/sr, ...).
enum class Scaling { none, length, inverse_length };

/// One parameter of `Owner`. Its default is what a default-constructed owner holds. `Member` may be a number, a
/// spectrum (grey or RGB in files), an optional, a list, a text or another described struct; binding follows from its
/// type.
template <class Owner, class Member>
struct Field {
  std::string_view name;
  Member Owner::*member;
  Range range = any_number;
  std::string_view unit = "";  // as printed: "1", "m", "1/m", "degrees", ...
  std::string_view text = "";  // one sentence for artists
  Scaling scaling = Scaling::none;
  bool required = false;
};
template <class Owner, class Member, class... Rest>
Field(std::string_view, Member Owner::*, Rest...) -> Field<Owner, Member>;

/// Calls visit(field) for each field of a described struct, in the order of its list.
template <class Owner, class Visit>
constexpr void for_each_field(Visit&& visit) {
  std::apply([&](const auto&... field) { (visit(field), ...); }, Owner::fields());
}

}  // namespace tyndall
