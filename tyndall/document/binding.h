#pragma once
// Reading described structs from JSON. This one mechanism reads every law, profile, artist model, light and camera.
//
// To read a struct of your own, describe it where it is declared (number/described.h says how) and write
//
//   const JsonText text = read_json(path);
//   const auto mine = read_as<Mine>(JsonCursor(text));
//   const auto in_si = in_metres(mine, meters_per_unit);      // artist/dials.h: scales what has a Scaling
//
// Members may be: double, int, bool, std::string, a one-of, Spectrum (a number means grey), Vector ([x,y,z]),
// std::array<double, N>, NumberFile and GridFile (read when it is named), std::optional, std::vector, OneOrMore, a
// described struct, or a choice (std::variant). Values are kept as written: nothing is scaled while reading. Every
// error is a Fault with file, line and pointer: wrong types, numbers out of range, missing and unknown keys (with the
// nearest spelling), and what objection_to() objects to.
#include <algorithm>
#include <cmath>
#include <limits>

#include "tyndall/color/spectrum.h"
#include "tyndall/document/json_text.h"
#include "tyndall/document/spelling.h"
#include "tyndall/geometry/vector.h"
#include "tyndall/number/demand.h"
#include "tyndall/number/described.h"
#include "tyndall/number/grid_file.h"
#include "tyndall/number/number_file.h"

namespace tyndall {

/// A number's range and unit: "a number from 0 to 1", "a number above 0 [m]".
std::string described(const FieldFacts& facts);

/// The number here; a Fault where it is none or outside the range.
double read_number(const JsonCursor& at, const FieldFacts& facts);
/// The whole number here, within the range and the int type.
int read_integer(const JsonCursor& at, const FieldFacts& facts);
/// The file of numbers that is named here.
NumberFile read_number_file(const JsonCursor& at, const FieldFacts& facts);
/// The file that is named here, its grid unread.
GridFile read_grid_file(const JsonCursor& at, const FieldFacts& facts);
/// Reads a grid of a file into it, of a sequence that with the number; "" is the only one. `at` is the object that
/// names both.
void load_grid(const JsonCursor& at, GridFile& file, const std::string& grid_name, int number);
/// The index of the text here among words.
std::size_t read_word(const JsonCursor& at, const std::vector<std::string_view>& words);
/// A Fault where this is not an object, or has a key that is neither among `keys` nor the tag. `resolved` is a key that
/// could have been written too, and has been followed by now.
void check_keys(const JsonCursor& at, std::vector<std::string_view> keys, std::string_view tag,
                std::string_view resolved = "");
/// A Fault where the object here has both of the keys that a demand excludes: an empty list beside a file, which once
/// read is as if it were not there.
void check_not_both(const JsonCursor& at, const Demand& demand);

/// What a field of type T may hold, for messages.
template <class T>
std::string expected_value(const FieldFacts& facts) {
  const std::string about =
      facts.text.empty() ? "" : " (" + std::string(facts.name) + ": " + std::string(facts.text) + ")";
  if constexpr (OptionalMember<T>) {
    return expected_value<typename T::value_type>(facts);
  } else if constexpr (std::is_same_v<T, double> || std::is_same_v<T, int>) {
    return described(facts) + about;
  } else if constexpr (std::is_same_v<T, Spectrum>) {
    return described(facts) + ", or a list of " + std::to_string(channel_count) + about;
  } else if constexpr (std::is_same_v<T, Vector>) {
    return "a list of 3: " + described(facts) + about;
  } else if constexpr (ArrayMember<T>) {
    return "a list of " + std::to_string(std::tuple_size_v<T>) + ": " + described(facts) + about;
  } else if constexpr (std::is_same_v<T, bool>) {
    return "true or false" + about;
  } else if constexpr (std::is_same_v<T, std::string>) {
    return "a text" + about;
  } else if constexpr (std::is_same_v<T, NumberFile> || std::is_same_v<T, GridFile>) {
    return "the name of a file" + about;
  } else if constexpr (OneOf<T>) {
    constexpr auto words = words_of(T{});
    return one_of("", {words.begin(), words.end()}) + about;
  } else if constexpr (ListMember<T>) {
    return "a list" + about;
  } else if constexpr (OneOrMoreMember<T>) {
    using Element = typename decltype(T::all)::value_type;
    FieldFacts plain = facts;
    plain.text = "";
    return expected_value<Element>(plain) + ", or a list of 1 to " + std::to_string(T::most) + " such" + about;
  } else if constexpr (NamedChoice<T>) {
    std::vector<std::string_view> names;
    for_each_alternative<T>([&]<class A>(std::type_identity<A>) { names.push_back(A::name); });
    return "an object whose \"" + std::string(choice_key<T>) + "\" is " + one_of("", names) + about;
  } else if constexpr (Choice<T>) {
    std::string text;
    std::vector<std::string_view> forms;
    bool first_is_required = false;
    for_each_alternative<T>([&]<class A>(std::type_identity<A>) {
      const FieldFacts first = facts_of(std::get<0>(A::fields()));
      if constexpr (is_bare<A>()) {
        text += (text.empty() ? "" : " or ") + expected_value<FirstMember<A>>({"", first.range, first.unit, ""});
      } else {
        forms.push_back(first.name);
        first_is_required = first.required;
      }
    });
    // What tells several objects apart says what they are; the first field of the only one need not.
    if (!forms.empty()) text += text.empty() ? "an object" : ", or an object";
    if (forms.size() > 1 || first_is_required) text += " with " + one_of("", forms);
    return text + about;
  } else {
    return "an object" + about;
  }
}

template <class T>
void read_value(const JsonCursor& at, const FieldFacts& facts, T& out);

/// Fills a struct from the object here. `tag` is a key that is allowed besides the fields.
template <Described T>
void read_object(const JsonCursor& at, T& out, std::string_view tag = "") {
  std::vector<std::string_view> keys;
  for_each_field<T>([&](const auto& field) { keys.push_back(field.name); });
  if constexpr (requires { T::base_key; }) {
    check_keys(at, keys, tag, T::base_key);
  } else {
    check_keys(at, keys, tag);
  }
  for_each_field<T>([&](const auto& field) {
    const FieldFacts facts = facts_of(field);
    if (at.value().contains(std::string(field.name))) {
      read_value(at.at(field.name), facts, out.*field.member);
    } else if (field.required) {
      using Member = std::remove_cvref_t<decltype(out.*field.member)>;
      throw at.fault("no key \"" + std::string(field.name) + '"', expected_value<Member>(facts));
    }
  });
  if constexpr (requires { load_grid(at, out.file, out.grid_name, out.first_frame); })
    load_grid(at, out.file, out.grid_name, out.first_frame);
  if constexpr (requires { objection_to(out); }) {
    if (const std::optional<Objection> objection = objection_to(out)) throw at.fault_below(*objection);
  }
  if constexpr (requires { demands_of(out); }) {
    for (const Demand& demand : demands_of(out)) check_not_both(at, demand);
  }
}

/// A choice told apart by a key that names the alternative.
template <NamedChoice V>
void read_named_choice(const JsonCursor& at, const FieldFacts& facts, V& out) {
  constexpr std::string_view key = choice_key<V>;
  std::vector<std::string_view> names;
  for_each_alternative<V>([&]<class T>(std::type_identity<T>) { names.push_back(T::name); });
  if (!at.value().is_object()) throw at.wrong_type(expected_value<V>(facts));
  if (!at.value().contains(std::string(key))) {
    throw at.fault("no key \"" + std::string(key) + '"', expected_value<V>(facts));
  }
  const std::size_t chosen = read_word(at.at(key), names);
  std::size_t index = 0;
  for_each_alternative<V>([&]<class T>(std::type_identity<T>) {
    if (index++ == chosen) read_object(at, out.template emplace<T>(), key);
  });
}

/// Whether a JSON value is of the kind that a bare alternative with this member starts from.
template <class T>
bool looks_like(const Json& value) {
  if constexpr (std::is_same_v<T, std::string> || OneOf<T>) {
    return value.is_string();
  } else if constexpr (std::is_same_v<T, Spectrum>) {
    return value.is_number() || value.is_array();
  } else if constexpr (std::is_arithmetic_v<T>) {
    return value.is_number();
  } else {
    return value.is_array();
  }
}

/// A choice told apart by its form.
template <Choice V>
void read_formed_choice(const JsonCursor& at, const FieldFacts& facts, V& out) {
  const Json& value = at.value();
  std::vector<std::string_view> forms;  // first fields of the alternatives that are objects
  std::size_t index = 0, matches = 0, chosen = 0, only_object = 0;
  for_each_alternative<V>([&]<class T>(std::type_identity<T>) {
    constexpr std::string_view first = first_field_name<T>();
    if constexpr (is_bare<T>()) {
      if (!value.is_object() && looks_like<FirstMember<T>>(value)) chosen = index, ++matches;
    } else {
      forms.push_back(first);
      only_object = index;
      if (value.is_object() && value.contains(std::string(first))) chosen = index, ++matches;
    }
    ++index;
  });
  // Where only one alternative is an object, what it lacks is the better message.
  if (value.is_object() && forms.size() == 1) chosen = only_object, matches = 1;
  if (matches == 0) {
    if (!value.is_object() || value.empty()) throw at.wrong_type(expected_value<V>(facts));
    const std::string key = value.begin().key();
    throw at.at(key).fault("the unknown key " + in_quotes(key), one_of(key, forms));
  }
  if (matches > 1) throw at.fault("an object of two forms", expected_value<V>(facts));
  index = 0;
  for_each_alternative<V>([&]<class T>(std::type_identity<T>) {
    if (index++ != chosen) return;
    T& alternative = out.template emplace<T>();
    if constexpr (is_bare<T>()) {
      constexpr auto field = std::get<0>(T::fields());
      read_value(at, facts_of(field), alternative.*field.member);
    } else {
      read_object(at, alternative);
    }
  });
}

template <class T>
void read_list(const JsonCursor& at, const FieldFacts& facts, std::vector<T>& out) {
  if (!at.value().is_array()) throw at.wrong_type(expected_value<std::vector<T>>(facts));
  out.clear();
  for (std::size_t i = 0; i < at.value().size(); ++i) read_value(at.at(i), facts, out.emplace_back());
}

/// One, or a list of one to most.
template <class T>
void read_one_or_more(const JsonCursor& at, const FieldFacts& facts, OneOrMore<T>& out) {
  if (!at.value().is_array()) {
    if (!at.value().is_object()) throw at.wrong_type(expected_value<OneOrMore<T>>(facts));
    out.all.assign(1, T{});
    return read_value(at, facts, out.all.front());
  }
  if (at.value().empty() || at.value().size() > OneOrMore<T>::most) {
    throw at.wrong_type(expected_value<OneOrMore<T>>(facts));
  }
  read_list(at, facts, out.all);
}

/// Exactly `count` numbers in a list.
template <class Put>
void read_numbers(const JsonCursor& at, const FieldFacts& facts, std::size_t count, const std::string& expected,
                  Put put) {
  if (!at.value().is_array() || at.value().size() != count) throw at.wrong_type(expected);
  for (std::size_t i = 0; i < count; ++i) put(i, read_number(at.at(i), facts));
}

/// Reads any member type from the value here; `facts` are those of the field that holds it.
template <class T>
void read_value(const JsonCursor& at, const FieldFacts& facts, T& out) {
  if constexpr (std::is_same_v<T, double>) {
    out = read_number(at, facts);
  } else if constexpr (std::is_same_v<T, int>) {
    out = read_integer(at, facts);
  } else if constexpr (std::is_same_v<T, bool>) {
    if (!at.value().is_boolean()) throw at.wrong_type(expected_value<T>(facts));
    out = at.value().template get<bool>();
  } else if constexpr (std::is_same_v<T, std::string>) {
    if (!at.value().is_string()) throw at.wrong_type(expected_value<T>(facts));
    out = at.value().template get_ref<const std::string&>();
  } else if constexpr (std::is_same_v<T, NumberFile>) {
    out = read_number_file(at, facts);
  } else if constexpr (std::is_same_v<T, GridFile>) {
    out = read_grid_file(at, facts);
  } else if constexpr (OneOf<T>) {
    constexpr auto words = words_of(T{});
    out = static_cast<T>(read_word(at, {words.begin(), words.end()}));
  } else if constexpr (std::is_same_v<T, Spectrum>) {
    if (at.value().is_number()) {
      out = Spectrum::grey(read_number(at, facts));
    } else {
      read_numbers(at, facts, channel_count, expected_value<T>(facts), [&](std::size_t i, double x) { out[i] = x; });
    }
  } else if constexpr (std::is_same_v<T, Vector>) {
    double xyz[3];
    read_numbers(at, facts, 3, expected_value<T>(facts), [&](std::size_t i, double x) { xyz[i] = x; });
    out = {xyz[0], xyz[1], xyz[2]};
  } else if constexpr (ArrayMember<T>) {
    read_numbers(at, facts, out.size(), expected_value<T>(facts), [&](std::size_t i, double x) { out[i] = x; });
  } else if constexpr (OptionalMember<T>) {
    read_value(at, facts, out.emplace());
  } else if constexpr (ListMember<T>) {
    read_list(at, facts, out);
  } else if constexpr (OneOrMoreMember<T>) {
    read_one_or_more(at, facts, out);
  } else if constexpr (NamedChoice<T>) {
    read_named_choice(at, facts, out);
  } else if constexpr (Choice<T>) {
    read_formed_choice(at, facts, out);
  } else {
    static_assert(Described<T>, "a member type that files cannot hold");
    read_object(at, out);
  }
}

/// The value here as a T that is otherwise default-constructed. Throws Fault.
template <class T>
T read_as(const JsonCursor& at) {
  T value{};
  read_value(at, FieldFacts{}, value);
  return value;
}

}  // namespace tyndall
