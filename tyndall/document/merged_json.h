#pragma once
// One JSON value laid over another, as described structs are read: what a file with a base says.
//
// Objects are merged member by member. A null takes the member away; one of a name that nothing has stays, for the
// reader to refuse. An object that names another alternative of a
// choice (another law, another form of density) replaces the base's, whose members would mean nothing in it. Of
// fields that exclude each other (demand.h, not_both), those of the upper object win. Lists and everything else are
// replaced whole.
#include <string>
#include <string_view>

#include "tyndall/document/json_text.h"
#include "tyndall/number/demand.h"
#include "tyndall/number/described.h"

namespace tyndall {

template <class T>
Json merged(const Json& base, const Json& upper);

/// Takes the nulls out of what replaces an object whole, where the object had something: it went with it.
inline void take_away(Json& out, const Json& base) {
  for (auto member = out.begin(); member != out.end();) {
    const auto below = base.find(member.key());
    if (below != base.end() && member->is_null()) {
      member = out.erase(member);
      continue;
    }
    if (below != base.end() && member->is_object() && below->is_object()) take_away(*member, *below);
    ++member;
  }
}

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
    Json result = value;
    bool taken_away = value.is_null() && base.contains(key);
    for_each_field<T>([&](const auto& field) {
      using Member = std::remove_cvref_t<decltype(std::declval<T&>().*field.member)>;
      if (field.name != key) return;
      taken_away = value.is_null();
      result = merged<Member>(out.contains(key) ? out.at(key) : Json(), value);
    });
    if (taken_away) {
      out.erase(key);
    } else {
      out[key] = std::move(result);
    }
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
  const bool replaced = !above.empty() && above != below;
  const std::string& chosen = replaced ? above : below;
  Json out = upper;
  bool known = false;
  for_each_alternative<V>([&]<class A>(std::type_identity<A>) {
    std::string name;
    if constexpr (NamedChoice<V>) {
      name = A::name;
    } else {
      name = first_field_name<A>();
    }
    if (name != chosen || known) return;
    known = true;
    out = merged_members<A>(replaced ? Json::object() : base, upper);
  });
  if (replaced) take_away(out, base);
  return out;
}

/// A value of a member of type T.
template <class T>
Json merged(const Json& base, const Json& upper) {
  if (!upper.is_object()) return upper;
  if (!base.is_object()) return merged<T>(Json::object(), upper);
  if constexpr (OptionalMember<T>) {
    return merged<typename T::value_type>(base, upper);
  } else if constexpr (OneOrMoreMember<T>) {
    return merged<typename decltype(T::all)::value_type>(base, upper);  // a list on either side is replaced whole
  } else if constexpr (Choice<T>) {
    return merged_choice<T>(base, upper);
  } else if constexpr (Described<T>) {
    return merged_members<T>(base, upper);
  } else {
    return upper;
  }
}

}  // namespace tyndall
