#include "tyndall/document/merged_json.h"

namespace tyndall {

Json without_nulls(const Json& upper) {
  if (!upper.is_object()) return upper;
  Json out = Json::object();
  for (const auto& [key, value] : upper.items()) {
    if (!value.is_null()) out[key] = without_nulls(value);
  }
  return out;
}

}  // namespace tyndall
