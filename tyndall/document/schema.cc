#include "tyndall/document/schema.h"

#include <algorithm>
#include <limits>

#include "tyndall/document/binding.h"
#include "tyndall/document/medium_file.h"

namespace tyndall {
namespace {

void add_range(OrderedJson& schema, const Range& range) {
  if (std::isfinite(range.low)) schema[range.open_low ? "exclusiveMinimum" : "minimum"] = written_number(range.low);
  if (std::isfinite(range.high)) schema[range.open_high ? "exclusiveMaximum" : "maximum"] = written_number(range.high);
}

/// What is demanded of an object that has the field.
OrderedJson& beside(OrderedJson& schema, std::string_view field) { return schema["dependencies"][std::string(field)]; }

}  // namespace

OrderedJson number_schema(const FieldFacts& facts) {
  OrderedJson schema{{"type", "number"}};
  add_range(schema, facts.range);
  return schema;
}

OrderedJson integer_schema(const FieldFacts& facts) {
  Range range = facts.range;
  constexpr double least = std::numeric_limits<int>::min(), most = std::numeric_limits<int>::max();
  if (!(range.low >= least)) range.low = least, range.open_low = false;
  if (!(range.high <= most)) range.high = most, range.open_high = false;
  OrderedJson schema{{"type", "integer"}};
  add_range(schema, range);
  return schema;
}

OrderedJson numbers_schema(const FieldFacts& facts, std::size_t count) {
  return {{"type", "array"}, {"items", number_schema(facts)}, {"minItems", count}, {"maxItems", count}};
}

OrderedJson words_schema(const std::vector<std::string_view>& words) { return {{"type", "string"}, {"enum", words}}; }

void describe(OrderedJson& schema, const FieldFacts& facts) {
  std::string text(facts.text);
  if (!facts.unit.empty() && facts.unit != "1") {
    text += (text.empty() ? "[" : " [") + std::string(facts.unit);
    text += facts.scaling == Scaling::none ? "]" : ", m being this file's unit of length]";
  }
  if (!text.empty()) schema["description"] = text;
}

void add_demand(OrderedJson& schema, const Demand& demand) {
  const std::string first(demand.names[0]), second(demand.names[1]);
  const auto property = [&]() -> OrderedJson& { return schema["properties"].at(first); };
  switch (demand.kind) {
    case Demand::Kind::some_of:
      for (const std::string_view name : demand.names) {
        if (!name.empty()) schema["anyOf"].push_back({{"required", {std::string(name)}}});
      }
      break;
    case Demand::Kind::not_both:
      beside(schema, first)["properties"][second] = false;
      break;
    case Demand::Kind::needs:
      beside(schema, first)["required"].push_back(second);
      break;
    case Demand::Kind::not_all_zero:
      property()["contains"] = {{"not", {{"const", 0}}}};
      break;
    case Demand::Kind::counts:
      property()["contains"] = {{"properties", {{second, {{"exclusiveMinimum", 0}}}}}};
      break;
    case Demand::Kind::one_word_of:
      property()["enum"] = std::vector<std::string_view>(demand.words, demand.words + demand.word_count);
      break;
    case Demand::Kind::sized:
      property()["minItems"] = demand.least;
      property()["maxItems"] = demand.most;
      break;
  }
}

void add_demand_on_part(OrderedJson& schema, const Demand& demand) {
  if (demand.kind != Demand::Kind::not_both) return;
  // null takes away what the base has, so it may stand beside.
  const std::string first(demand.names[0]), second(demand.names[1]);
  const OrderedJson there{{"not", {{"type", "null"}}}}, gone{{"type", "null"}};
  schema["allOf"].push_back({{"if", {{"required", {first}}, {"properties", {{first, there}}}}},
                             {"then", {{"properties", {{second, gone}}}}}});
}

OrderedJson medium_schema() {
  const char* const example = R"({"format": "tyndall-medium/1", "name": "Harbour fog at dawn",
    "background": {"air": "note"},
    "conditions": {"model": "simple", "w": 0.7, "thickness": {"visibility": 600},
                   "profile": {"law": "exponential", "scale_height": 30}},
    "species": [{"name": "soot", "scattering": 2e-5, "absorption": 5e-5, "phase": {"law": "henyey_greenstein", "g": 0.47}}]})";
  medium_from_json(example, "the example of the schema");
  return SchemaBook().whole<MediumFile>("Tyndall medium, format 1 (name.medium.json)", OrderedJson::parse(example));
}

}  // namespace tyndall
