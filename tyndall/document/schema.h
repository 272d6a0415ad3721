#pragma once
// JSON Schemas of described structs: what binding.h reads, in the words that editors and validators know.
//
// Draft-07: the newest draft that VS Code supports in full (of 2019-09 and 2020-12 only parts, with a warning), and
// that every validator knows. Nothing later would say more here. Two of its habits shape what is written: beside a
// "$ref" only annotations may stand, since constraints there are ignored; and choices are told apart by if/then rather
// than oneOf, so that a message is about the alternative that was meant and not about all of them.
//
//   SchemaBook book;
//   const OrderedJson schema = book.whole<Mine>("Title");     // self-contained, its definitions included
#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <typeindex>
#include <utility>
#include <vector>

#include "tyndall/artist/dials.h"
#include "tyndall/document/writing.h"
#include "tyndall/number/demand.h"
#include "tyndall/number/described.h"

namespace tyndall {

/// A number within its range.
OrderedJson number_schema(const FieldFacts& facts);
/// A whole number within its range and the int type.
OrderedJson integer_schema(const FieldFacts& facts);
/// A list of `count` numbers.
OrderedJson numbers_schema(const FieldFacts& facts, std::size_t count);
/// One of the words.
OrderedJson words_schema(const std::vector<std::string_view>& words);
/// Adds what a field's facts say to people: its sentence and unit.
void describe(OrderedJson& schema, const FieldFacts& facts);
/// Adds a demand to the schema of an object whose fields are already in it.
void add_demand(OrderedJson& schema, const Demand& demand);
/// The same for what is laid over a base: only what no base can put right.
void add_demand_on_part(OrderedJson& schema, const Demand& demand);

/// Whether a default-constructed T would be read back: then it may serve as an example.
template <Described T>
bool is_example() {
  const T value{};
  if constexpr (requires { objection_to(value); }) {
    if (objection_to(value)) return false;
  }
  return !unusable_number(value);
}

/// A described struct that is a file and may build on another one.
template <class T>
concept IsFile = requires {
  T::base_key;
};

/// The schemas of one file: choices and described structs are written once each, among the definitions, and may contain
/// themselves.
class SchemaBook {
 public:
  /// From now on a T need not have this field, because something other than binding completes it.
  template <Described T>
  void not_required(std::string_view field) {
    completed_.insert({typeid(T), field});
  }

  template <Described T>
  OrderedJson whole(std::string_view title, const OrderedJson& example = nullptr) {
    OrderedJson schema;
    schema["$schema"] = "http://json-schema.org/draft-07/schema#";
    schema["title"] = std::string(title);
    schema.update(object_schema<T>());
    if (!example.is_null()) schema["examples"].push_back(example);
    schema["definitions"] = definitions_;
    return schema;
  }

 private:
  template <class T>
  OrderedJson schema_of(const FieldFacts& facts) {
    if constexpr (std::is_same_v<T, double>) {
      return number_schema(facts);
    } else if constexpr (std::is_same_v<T, int>) {
      return integer_schema(facts);
    } else if constexpr (std::is_same_v<T, bool>) {
      return {{"type", "boolean"}};
    } else if constexpr (std::is_same_v<T, std::string> || std::is_same_v<T, NumberFile> ||
                         std::is_same_v<T, GridFile>) {
      return {{"type", "string"}};
    } else if constexpr (OneOf<T>) {
      constexpr auto words = words_of(T{});
      return words_schema({words.begin(), words.end()});
    } else if constexpr (std::is_same_v<T, Spectrum>) {
      // "minimum" and its like hold for the number, "items" for the list.
      OrderedJson schema = number_schema(facts);
      schema.update(numbers_schema(facts, channel_count));
      schema["type"] = {"number", "array"};
      return schema;
    } else if constexpr (std::is_same_v<T, Vector>) {
      return numbers_schema(facts, 3);
    } else if constexpr (ArrayMember<T>) {
      return numbers_schema(facts, std::tuple_size_v<T>);
    } else if constexpr (OptionalMember<T>) {
      return schema_of<typename T::value_type>(facts);
    } else if constexpr (ListMember<T>) {
      return {{"type", "array"}, {"items", schema_of<typename T::value_type>(facts)}};
    } else if constexpr (OneOrMoreMember<T>) {
      return defined<T>(facts.name);
    } else {
      return defined<T>(facts.name);
    }
  }

  /// A part of a file that has a base: nothing is required, null takes away what the base says.
  template <class T>
  OrderedJson part_of(const FieldFacts& facts) {
    if constexpr (ListMember<T>) {  // replaced whole
      partial_ = false;
      OrderedJson schema = schema_of<T>(facts);
      partial_ = true;
      return {{"anyOf", {std::move(schema), {{"type", "null"}}}}};
    } else if constexpr (OptionalMember<T>) {
      return part_of<typename T::value_type>(facts);
    } else {
      return {{"anyOf", {schema_of<T>(facts), {{"type", "null"}}}}};
    }
  }

  /// A reference to T's definition, which is written at its first use and named after that use.
  template <class T>
  OrderedJson defined(std::string_view use) {
    const auto known = names_.find({typeid(T), partial_});
    if (known != names_.end()) return {{"$ref", "#/definitions/" + known->second}};
    const std::string wish = std::string(use) + (partial_ ? "_part" : "");
    std::string name = wish;
    for (int n = 2; definitions_.contains(name); ++n) name = wish + '_' + std::to_string(n);
    names_.emplace(std::pair{std::type_index(typeid(T)), partial_}, name);
    definitions_[name] = nullptr;  // its place and name, while it is being written
    OrderedJson schema;
    if constexpr (OneOrMoreMember<T>) {
      schema = one_or_more_schema<T>(use);
    } else if constexpr (NamedChoice<T>) {
      schema = named_choice_schema<T>();
    } else if constexpr (Choice<T>) {
      schema = formed_choice_schema<T>();
    } else {
      schema = object_schema<T>();
    }
    definitions_[name] = std::move(schema);
    return {{"$ref", "#/definitions/" + name}};
  }

  /// A file of its own, or what differs from its base.
  template <Described T>
  OrderedJson object_schema(const std::string& tag = "", const OrderedJson& word = nullptr) {
    if constexpr (IsFile<T>) {
      OrderedJson schema{{"type", "object"}}, variant;
      schema["if"] = {{"required", {T::base_key}}};
      partial_ = true;
      variant = plain_object_schema<T>();
      partial_ = false;
      variant["properties"][std::string(T::base_key)] = {{"type", "string"}, {"description", T::base_text}};
      schema["then"] = std::move(variant);
      schema["else"] = plain_object_schema<T>();
      return schema;
    } else {
      return plain_object_schema<T>(tag, word);
    }
  }

  /// An object with the fields of T and, where it is an alternative of a named choice, the key that names it.
  template <Described T>
  OrderedJson plain_object_schema(const std::string& tag = "", const OrderedJson& word = nullptr) {
    OrderedJson schema{{"type", "object"}};
    if constexpr (requires { T::text; }) schema["description"] = std::string(T::text);
    OrderedJson properties = OrderedJson::object(), required = OrderedJson::array();
    if (!tag.empty()) {
      properties[tag] = word;
      if (!partial_) required.push_back(tag);
    }
    const T defaults{};
    for_each_field<T>([&](const auto& field) {
      const FieldFacts facts = facts_of(field);
      const auto& value = defaults.*field.member;
      using Member = std::remove_cvref_t<decltype(value)>;
      // What a file with a base requires is what the file itself does, not its parts.
      const bool in_part = partial_ && !(field.required && IsFile<T>);
      OrderedJson property = in_part ? part_of<Member>(facts) : schema_of<Member>(facts);
      describe(property, facts);
      if (in_part) {
        properties[std::string(field.name)] = std::move(property);
        return;
      }
      if (field.required && !completed_.contains({typeid(T), field.name})) {
        required.push_back(std::string(field.name));
      } else if constexpr (ListMember<Member> || std::is_same_v<Member, std::string>) {
        if (!value.empty()) property["default"] = written(value);
      } else if constexpr (!OptionalMember<Member>) {
        property["default"] = written(value);
      }
      properties[std::string(field.name)] = std::move(property);
    });
    schema["properties"] = std::move(properties);
    if (!required.empty()) schema["required"] = std::move(required);
    schema["additionalProperties"] = false;
    if constexpr (requires { demands_of(defaults); }) {
      for (const Demand& demand : demands_of(defaults)) {
        partial_ ? add_demand_on_part(schema, demand) : add_demand(schema, demand);
      }
    }
    return schema;
  }

  /// A list of whole ones, in a file with a base too; or one.
  template <OneOrMoreMember T>
  OrderedJson one_or_more_schema(std::string_view use) {
    using Element = typename decltype(T::all)::value_type;
    const std::string one = "one_" + std::string(use);
    OrderedJson single = defined<Element>(one);
    const bool was_partial = std::exchange(partial_, false);
    OrderedJson schema{{"type", {"object", "array"}}, {"items", defined<Element>(one)}};
    partial_ = was_partial;
    schema["minItems"] = 1;
    schema["maxItems"] = T::most;
    schema["if"] = {{"type", "object"}};
    schema["then"] = std::move(single);
    return schema;
  }

  /// An object of a choice. In a file with a base, what another alternative has may be taken away.
  template <Described A>
  OrderedJson alternative_schema(const std::string& tag = "", const OrderedJson& word = nullptr) {
    OrderedJson schema = object_schema<A>(tag, word);
    if (partial_) schema["additionalProperties"] = {{"type", "null"}};
    return schema;
  }

  /// The tag and its words first, for completion and for the message about an unknown word; then, for the word that is
  /// there, its alternative.
  template <NamedChoice V>
  OrderedJson named_choice_schema() {
    const std::string key(choice_key<V>);
    std::vector<std::string_view> words;
    std::string meanings;
    std::set<std::string> keys;
    OrderedJson alternatives = OrderedJson::array(), examples = OrderedJson::array();
    for_each_alternative<V>([&]<class A>(std::type_identity<A>) {
      words.push_back(A::name);
      meanings += (meanings.empty() ? "" : "\n") + std::string(A::name) + ": " + std::string(A::text);
      const OrderedJson named{{"properties", {{key, {{"const", std::string(A::name)}}}}}, {"required", {key}}};
      const OrderedJson word{{"const", std::string(A::name)}, {"description", std::string(A::text)}};
      alternatives.push_back({{"if", named}, {"then", alternative_schema<A>(key, word)}});
      for_each_field<A>([&](const auto& field) { keys.insert(std::string(field.name)); });
      if (is_example<A>() && !partial_) examples.push_back(written(V{A{}}));
    });
    OrderedJson word = words_schema(words);
    word["description"] = meanings;
    OrderedJson schema{{"type", "object"}, {"properties", {{key, word}}}};
    if (!partial_) {
      schema["required"] = {key};
    } else {
      keys.insert(key);
      schema["propertyNames"] = {{"enum", keys}};
    }
    schema["allOf"] = std::move(alternatives);
    if (!examples.empty()) schema["examples"] = std::move(examples);
    return schema;
  }

  /// The types that may be bare, each with its schema; and the objects, told apart by their first fields.
  template <Choice V>
  OrderedJson formed_choice_schema() {
    OrderedJson types = OrderedJson::array(), conditions = OrderedJson::array(), examples = OrderedJson::array();
    OrderedJson firsts = OrderedJson::object(), forms = OrderedJson::array();
    std::vector<OrderedJson> objects;
    OrderedJson more_keys = OrderedJson::array();
    for_each_alternative<V>([&]<class A>(std::type_identity<A>) {
      constexpr auto first = std::get<0>(A::fields());
      const FieldFacts facts = facts_of(first);
      const std::string name(first.name);
      OrderedJson value = schema_of<FirstMember<A>>(facts);
      if constexpr (is_bare<A>()) {
        const OrderedJson type = value.at("type");
        for (const OrderedJson& t : type.is_array() ? type : OrderedJson::array({type})) types.push_back(t);
        describe(value, facts);
        conditions.push_back({{"if", {{"type", type}}}, {"then", std::move(value)}});
      } else {
        for_each_field<A>([&](const auto& field) {
          if (field.name != name) more_keys.push_back(std::string(field.name));
        });
        describe(value, facts);
        firsts[name] = std::move(value);
        forms.push_back({{"required", {name}}});
        objects.push_back(alternative_schema<A>());
      }
      if (is_example<A>() && !partial_) examples.push_back(written(V{A{}}));
    });
    OrderedJson schema;
    if (!objects.empty()) types.push_back("object");
    schema["type"] = types.size() == 1 ? types[0] : types;
    if (objects.size() == 1) {
      conditions.push_back({{"if", {{"type", "object"}}}, {"then", objects[0]}});
    } else if (!objects.empty()) {
      schema["properties"] = firsts;
      OrderedJson keys = OrderedJson::array();  // each once, the forms' names first: editors propose them in this order
      for (const auto& first : firsts.items()) keys.push_back(first.key());
      for (const OrderedJson& key : more_keys) {
        if (std::find(keys.begin(), keys.end(), key) == keys.end()) keys.push_back(key);
      }
      const OrderedJson any_key{{"enum", keys}};
      OrderedJson form{{"propertyNames", any_key}};
      if (!partial_) form["anyOf"] = forms;
      conditions.push_back({{"if", {{"type", "object"}}}, {"then", std::move(form)}});
      for (std::size_t i = 0; i < objects.size(); ++i) {
        OrderedJson has = forms[i];
        has["type"] = "object";
        conditions.push_back({{"if", has}, {"then", objects[i]}});
      }
    }
    schema["allOf"] = std::move(conditions);
    if (!examples.empty()) schema["examples"] = std::move(examples);
    return schema;
  }

  std::map<std::pair<std::type_index, bool>, std::string> names_;
  std::set<std::pair<std::type_index, std::string_view>> completed_;
  OrderedJson definitions_ = OrderedJson::object();
  bool partial_ = false;  // within a file that has a base
};

/// The schema of medium files.
OrderedJson medium_schema();

}  // namespace tyndall
