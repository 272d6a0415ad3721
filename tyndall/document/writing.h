#pragma once
// Writing described structs as JSON that binding.h reads back to the same values: the same kinds of members, in the
// order of their fields. What has a value is written, defaults too, so that a file keeps its meaning.
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "tyndall/color/spectrum.h"
#include "tyndall/geometry/vector.h"
#include "tyndall/number/described.h"
#include "tyndall/number/grid_file.h"
#include "tyndall/number/number_file.h"

namespace tyndall {

using OrderedJson = nlohmann::ordered_json;

/// A number without a superfluous ".0"; not finite: null.
OrderedJson written_number(double x);

/// The shortest decimal text that reads back as x, which is finite: 0.1, 2e-5, 1e+30. At most 17 digits.
std::string number_text(double x);

/// JSON text for people: what fits in a line stands on one. Ends with a newline.
std::string pretty(const OrderedJson& value);

template <class T>
OrderedJson written(const T& value);

/// The fields of `value` as members of `out`.
template <Described T>
void write_fields(const T& value, OrderedJson& out) {
  for_each_field<T>([&](const auto& field) {
    const auto& member = value.*field.member;
    using Member = std::remove_cvref_t<decltype(member)>;
    if constexpr (OptionalMember<Member>) {
      if (member) out[std::string(field.name)] = written(*member);
    } else if constexpr (ListMember<Member>) {
      if (!member.empty() || field.required) out[std::string(field.name)] = written(member);
    } else {
      out[std::string(field.name)] = written(member);
    }
  });
}

template <class T>
OrderedJson written(const T& value) {
  if constexpr (std::is_same_v<T, double>) {
    return written_number(value);
  } else if constexpr (std::is_same_v<T, NumberFile> || std::is_same_v<T, GridFile>) {
    return value.name;
  } else if constexpr (OneOf<T>) {
    return std::string(words_of(value)[static_cast<std::size_t>(value)]);
  } else if constexpr (std::is_same_v<T, Spectrum>) {
    OrderedJson out = OrderedJson::array();
    if (value == Spectrum::grey(value[0])) return written_number(value[0]);
    for (const double x : value.value) out.push_back(written_number(x));
    return out;
  } else if constexpr (std::is_same_v<T, Vector>) {
    return {written_number(value.x), written_number(value.y), written_number(value.z)};
  } else if constexpr (ListMember<T> || ArrayMember<T>) {
    OrderedJson out = OrderedJson::array();
    for (const auto& element : value) out.push_back(written(element));
    return out;
  } else if constexpr (OneOrMoreMember<T>) {
    return value.all.size() == 1 ? written(value.all.front()) : written(value.all);
  } else if constexpr (NamedChoice<T>) {
    OrderedJson out = OrderedJson::object();
    std::visit(
        [&]<class A>(const A& chosen) {
          out[std::string(choice_key<T>)] = std::string(A::name);
          write_fields(chosen, out);
        },
        value);
    return out;
  } else if constexpr (Choice<T>) {
    return std::visit(
        []<class A>(const A& chosen) {
          if constexpr (is_bare<A>()) {
            return written(chosen.*std::get<0>(A::fields()).member);
          } else {
            return written(chosen);
          }
        },
        value);
  } else if constexpr (Described<T>) {
    OrderedJson out = OrderedJson::object();
    write_fields(value, out);
    return out;
  } else {
    return value;  // bool, int, text
  }
}

}  // namespace tyndall
