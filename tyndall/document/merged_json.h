#pragma once
// One JSON value laid over another, as described structs are read: what a file with a base says.
//
// Objects are merged member by member. A null takes the member away. An object that names another alternative of a
// choice (another law, another form of density) replaces the base's, whose members would mean nothing in it. Of
// fields that exclude each other (demand.h, not_both), those of the upper object win. Lists and everything else are
// replaced whole.
#include <string>
#include <string_view>

#include "tyndall/document/json_text.h"
#include "tyndall/number/demand.h"
#include "tyndall/number/described.h"

namespace tyndall {

/// `upper` without the members that are null, at any depth of objects.
Json without_nulls(const Json& upper);

template <class T>
Json merged(const Json& base, const Json& upper);

/// The members of a described struct; members that it does not have are taken from both, for the reader to refuse.
template <Described T>
Json merged_members(const Json& base, const Json& upper) {
  Json out = base;
  if constexpr (requires { demands_of(T{}); }) {
    const auto states = [&](std::string_view key) {
      const auto found = upper.find(std::string(key));
      return found != upper.end() && !found->is_null();
    };
    for (const Demand& demand : demands_of(T{})) {
      if (demand.kind != Demand::Kind::not_both) continue;
      if (states(demand.names[0]) && !states(demand.names[1])) out.erase(std::string(demand.names[1]));
      if (states(demand.names[1]) && !states(demand.names[0])) out.erase(std::string(demand.names[0]));
    }
  }
  for (const auto& member : upper.items()) {
    const std::string& key = member.key();
    const Json& value = member.value();
    if (value.is_null()) {
      out.erase(key);
      continue;
    }
    Json result = without_nulls(value);
    if (out.contains(key)) {
      for_each_field<T>([&](const auto& field) {
        using Member = std::remove_cvref_t<decltype(std::declval<T&>().*field.member)>;
        if (field.name == key) result = merged<Member>(out.at(key), value);
      });
    }
    out[key] = std::move(result);
  }
  return out;
}

/// The alternative that an object is, by its tag or by the first field that it has; "" where it does not say.
template <Choice V>
std::string alternative_of(const Json& object) {
  std::string found;
  if constexpr (NamedChoice<V>) {
    const auto tag = object.find(std::string(choice_key<V>));
    if (tag != object.end() && tag->is_string()) found = tag->template get<std::string>();
  } else {
    for_each_alternative<V>([&]<class A>(std::type_identity<A>) {
      const std::string first(first_field_name<A>());
      const auto member = object.find(first);
      if (member != object.end() && !member->is_null()) found = first;
    });
  }
  return found;
}

template <Choice V>
Json merged_choice(const Json& base, const Json& upper) {
  const std::string below = alternative_of<V>(base), above = alternative_of<V>(upper);
  if (!above.empty() && above != below) return without_nulls(upper);
  Json out = base;
  bool known = false;
  for_each_alternative<V>([&]<class A>(std::type_identity<A>) {
    std::string name;
    if constexpr (NamedChoice<V>) {
      name = A::name;
    } else {
      name = first_field_name<A>();
    }
    if (name != below || known) return;
    known = true;
    out = merged_members<A>(base, upper);
  });
  return known ? out : without_nulls(upper);
}

/// A value of a member of type T.
template <class T>
Json merged(const Json& base, const Json& upper) {
  if (!base.is_object() || !upper.is_object()) return without_nulls(upper);
  if constexpr (OptionalMember<T>) {
    return merged<typename T::value_type>(base, upper);
  } else if constexpr (OneOrMoreMember<T>) {
    return merged<typename decltype(T::all)::value_type>(base, upper);  // a list on either side is replaced whole
  } else if constexpr (Choice<T>) {
    return merged_choice<T>(base, upper);
  } else if constexpr (Described<T>) {
    return merged_members<T>(base, upper);
  } else {
    return without_nulls(upper);
  }
}

}  // namespace tyndall
