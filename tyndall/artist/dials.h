#pragma once
// Walking the numbers of described structs: units, and what lies between two settings of the same dials.
#include <cmath>
#include <string>

#include "tyndall/color/spectrum.h"
#include "tyndall/geometry/vector.h"
#include "tyndall/number/described.h"
#include "tyndall/number/grid_file.h"
#include "tyndall/number/number_file.h"

namespace tyndall {

/// Calls visit(number, facts, path) for every floating-point number in a value, in the order of its fields, whatever it
/// is made of (binding.h lists the kinds). `path` is a JSON pointer; `facts` are those of the field that holds it.
template <class T, class Visit>
void for_each_number(T& value, const FieldFacts& facts, const std::string& path, Visit&& visit) {
  using U = std::remove_const_t<T>;
  if constexpr (std::is_same_v<U, double>) {
    visit(value, facts, path);
  } else if constexpr (std::is_same_v<U, Spectrum>) {
    for (std::size_t i = 0; i < channel_count; ++i) visit(value[i], facts, path);
  } else if constexpr (std::is_same_v<U, Vector>) {
    visit(value.x, facts, path);
    visit(value.y, facts, path);
    visit(value.z, facts, path);
  } else if constexpr (OptionalMember<U>) {
    if (value) for_each_number(*value, facts, path, visit);
  } else if constexpr (OneOrMoreMember<U>) {
    if (value.all.size() == 1) return for_each_number(value.all.front(), facts, path, visit);
    for_each_number(value.all, facts, path, visit);
  } else if constexpr (ListMember<U> || ArrayMember<U>) {
    std::size_t i = 0;
    for (auto& element : value) for_each_number(element, facts, path + '/' + std::to_string(i++), visit);
  } else if constexpr (Choice<U>) {
    std::visit([&](auto& chosen) { for_each_number(chosen, facts, path, visit); }, value);
  } else if constexpr (Described<U>) {
    for_each_field<U>([&](const auto& field) {
      for_each_number(value.*field.member, facts_of(field), path + '/' + std::string(field.name), visit);
    });
  } else {
    static_assert(OneOf<U> || std::is_integral_v<U> || std::is_same_v<U, std::string> ||
                      std::is_same_v<U, NumberFile> || std::is_same_v<U, GridFile>,
                  "a type without description");
  }
}

/// The same value with every length and inverse length, given in units of `meters_per_unit` metres, in metres and 1/m.
template <class T>
T in_metres(T value, double meters_per_unit) {
  for_each_number(value, FieldFacts{}, "", [&](double& x, const FieldFacts& facts, const std::string&) {
    if (facts.scaling == Scaling::length) x *= meters_per_unit;
    if (facts.scaling == Scaling::inverse_length) x /= meters_per_unit;
  });
  return value;
}

/// The first number of a described value that is not finite or outside its field's range, or a length above 0 whose
/// reciprocal is not finite. Reading has checked what was written; this checks what became of it (a very small unit, a
/// setting made by a program).
template <class T>
requires Described<T> || OneOrMoreMember<T> std::optional<Objection> unusable_number(const T& value) {
  std::optional<Objection> objection;
  for_each_number(value, FieldFacts{}, "", [&](double x, const FieldFacts& facts, const std::string& path) {
    const bool divides = facts.scaling == Scaling::length && facts.range.open_low;
    if (objection || (std::isfinite(x) && facts.range.contains(x) && !(divides && !std::isfinite(1.0 / x)))) return;
    objection = Objection{path.substr(1), "a number that is " + short_number(x) + " in SI units", "one within range"};
  });
  return objection;
}

/// Whether two values are made alike: the same alternatives, the same optionals present, lists as long, the same words
/// and texts, what is whole equal. Then their numbers correspond one to one.
template <class T>
bool alike(const T& a, const T& b) {
  if constexpr (std::is_same_v<T, double> || std::is_same_v<T, Spectrum> || std::is_same_v<T, Vector>) {
    return true;
  } else if constexpr (OptionalMember<T>) {
    return a.has_value() == b.has_value() && (!a || alike(*a, *b));
  } else if constexpr (ArrayMember<T>) {
    return true;
  } else if constexpr (ListMember<T>) {
    bool all = a.size() == b.size();
    for (std::size_t i = 0; all && i < a.size(); ++i) all = alike(a[i], b[i]);
    return all;
  } else if constexpr (OneOrMoreMember<T>) {
    return alike(a.all, b.all);
  } else if constexpr (Choice<T>) {
    return a.index() == b.index() &&
           std::visit(
               [&](const auto& chosen) { return alike(chosen, std::get<std::remove_cvref_t<decltype(chosen)>>(b)); },
               a);
  } else if constexpr (Whole<T>) {
    return a == b;
  } else if constexpr (Described<T>) {
    bool all = true;
    for_each_field<T>([&](const auto& field) { all = all && alike(a.*field.member, b.*field.member); });
    return all;
  } else {
    return a == b;
  }
}

/// The numbers of a value, in the order of its fields.
template <class T>
std::vector<double> numbers_of(const T& value) {
  std::vector<double> numbers;
  for_each_number(value, FieldFacts{}, "",
                  [&](double x, const FieldFacts&, const std::string&) { numbers.push_back(x); });
  return numbers;
}
/// Whether two values are alike() and their numbers equal.
template <class T>
bool same(const T& a, const T& b) {
  return alike(a, b) && numbers_of(a) == numbers_of(b);
}

/// a (1 - t) + b t, exact at both ends and never outside them.
inline double between(double a, double b, double t) { return std::lerp(a, b, t); }
inline Spectrum between(const Spectrum& a, const Spectrum& b, double t) {
  Spectrum out;
  for (std::size_t i = 0; i < channel_count; ++i) out[i] = between(a[i], b[i], t);
  return out;
}

/// Makes every number of `out` that at t between those of a and b, all three alike(). Nothing allocates.
template <class T>
void set_between(T& out, const T& a, const T& b, double t) {
  if constexpr (std::is_same_v<T, double>) {
    out = between(a, b, t);
  } else if constexpr (std::is_same_v<T, Spectrum>) {
    for (std::size_t i = 0; i < channel_count; ++i) out[i] = between(a[i], b[i], t);
  } else if constexpr (std::is_same_v<T, Vector>) {
    out = {between(a.x, b.x, t), between(a.y, b.y, t), between(a.z, b.z, t)};
  } else if constexpr (OptionalMember<T>) {
    if (out) set_between(*out, *a, *b, t);
  } else if constexpr (OneOrMoreMember<T>) {
    set_between(out.all, a.all, b.all, t);
  } else if constexpr (ListMember<T> || ArrayMember<T>) {
    for (std::size_t i = 0; i < out.size(); ++i) set_between(out[i], a[i], b[i], t);
  } else if constexpr (Choice<T>) {
    std::visit([&]<class A>(A& chosen) { set_between(chosen, *std::get_if<A>(&a), *std::get_if<A>(&b), t); }, out);
  } else if constexpr (Described<T> && !Whole<T>) {
    for_each_field<T>([&](const auto& field) { set_between(out.*field.member, a.*field.member, b.*field.member, t); });
  } else {
    static_assert(Whole<T> || OneOf<T> || std::is_integral_v<T> || std::is_same_v<T, std::string> ||
                      std::is_same_v<T, NumberFile> || std::is_same_v<T, GridFile>,
                  "a type without description");
  }
}
/// Every number of two values that are alike() at t between them.
template <class T>
T between_dials(T a, const T& b, double t) {
  set_between(a, T(a), b, t);
  return a;
}

}  // namespace tyndall
