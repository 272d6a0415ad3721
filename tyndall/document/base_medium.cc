#include "tyndall/document/base_medium.h"

#include <algorithm>
#include <memory>
#include <vector>

#include "tyndall/document/file_kind.h"
#include "tyndall/document/json_locator.h"
#include "tyndall/document/medium_file.h"
#include "tyndall/document/merged_json.h"
#include "tyndall/document/preset.h"
#include "tyndall/document/reference.h"
#include "tyndall/document/spelling.h"

namespace tyndall {
namespace {

namespace fs = std::filesystem;

std::string identity_of(const fs::path& path) {
  std::error_code error;
  const fs::path canonical = fs::weakly_canonical(path, error);
  return (error ? path : canonical).string();
}

/// The text of a base that stands at `where`, and what tells it from others.
std::pair<JsonText, std::string> base_named(const JsonText& json, const std::string& name, const std::string& where) {
  if (const Preset* preset = preset_named(name)) {
    return {parse_json(std::string(preset->text), title_of(*preset)), title_of(*preset)};
  }
  if (!json.references) {
    throw Fault(where, "the file name " + in_quotes(name, 100) + " in a text that stands in no folder",
                "a preset: " + one_of(name, preset_names()));
  }
  if (name.find_first_of("/.") == name.npos && !name.empty() &&
      !fs::exists(json.references->naming.parent_path() / name)) {
    throw Fault(where, in_quotes(name) + ", neither a preset nor a file",
                "a medium file, or " + one_of(name, preset_names()));
  }
  const fs::path path = referenced_file(json.references->naming, name, json.references->allow_path, where);
  refuse_other_kinds(path, FileKind::medium);
  JsonText text = read_json(path, json.references->allow_path);
  refuse_other_kinds(text, FileKind::medium);
  return {std::move(text), identity_of(path)};
}

/// The base's members, with lengths in units of `meters_per_unit`.
Json in_unit(const JsonText& base, const MediumFile& file, double meters_per_unit) {
  if (file.meters_per_unit == meters_per_unit) return base.root;
  MediumFile converted = in_metres(file, file.meters_per_unit / meters_per_unit);
  converted.meters_per_unit = meters_per_unit;
  return Json::parse(medium_to_json(converted));
}

/// Sources of what `upper` states itself are no longer sources of this medium.
void drop_overridden(Json& sources, const Json& upper) {
  if (!sources.is_array()) return;
  const auto overridden = [&](const Json& source) {
    const auto of = source.find("of");
    if (of == source.end() || !of->is_string()) return false;
    const std::string& pointer = of->get_ref<const std::string&>();
    if (pointer.empty() || pointer[0] != '/') return false;
    // Stated at that place, or replaced whole at a part that contains it.
    const Json* here = &upper;
    for (std::size_t begin = 1; begin <= pointer.size();) {
      const std::size_t end = std::min(pointer.find('/', begin), pointer.size());
      const auto next = here->find(pointer.substr(begin, end - begin));
      if (next == here->end()) return false;
      here = &*next;
      if (!here->is_object()) return true;
      begin = end + 1;
    }
    return true;
  };
  sources.erase(std::remove_if(sources.begin(), sources.end(), overridden), sources.end());
}

/// Whether a source is of something that stands in `medium`.
bool is_of_part(const Json& source, const Json& medium) {
  const auto of = source.find("of");
  try {
    return of != source.end() && of->is_string() && medium.contains(Json::json_pointer(of->get<std::string>()));
  } catch (const Json::parse_error&) {  // no pointer at all: for people only
    return false;
  }
}

void resolve(JsonText& json, const std::string& pointer, std::vector<std::string> chain) {
  const Json::json_pointer at(pointer);
  if (!json.root.contains(at)) return;
  Json& here = json.root[at];
  if (!here.is_object() || !here.contains("base")) return;
  const std::string key = joined(pointer, "base");
  const auto fault = [&](const std::string& found, const std::string& expected) {
    return Fault(place(json.file, line_of_pointer(json.text, key), key), found, expected);
  };
  const Json& name = here["base"];
  if (!name.is_string()) throw fault(described(name), "the name of a medium file or of a preset");
  const std::string where = fault("", "").where;
  auto [base, identity] = base_named(json, name.get_ref<const std::string&>(), where);
  if (std::find(chain.begin(), chain.end(), identity) != chain.end()) {
    throw fault("the base " + in_quotes(name.get_ref<const std::string&>(), 100) + ", which leads back to itself",
                "a medium that does not build on this one");
  }
  if (chain.size() > most_bases) {
    throw fault("more than " + std::to_string(most_bases) + " media that build on each other",
                "at most " + std::to_string(most_bases));
  }
  chain.push_back(identity);
  resolve(base, "", std::move(chain));
  const MediumFile file = medium_file_at(JsonCursor(base));

  const auto unit = here.find("meters_per_unit");
  const bool own_unit = unit != here.end() && unit->is_number() && unit->get<double>() > 0.0;
  Json below = in_unit(base, file, own_unit ? unit->get<double>() : file.meters_per_unit);
  below.erase("$schema");
  below.erase("format");  // each file says its own
  if (below.contains("sources")) drop_overridden(below["sources"], here);

  if (json.bases.empty()) json.own = json.root;
  Json upper = here;
  upper.erase("base");
  Json whole = merged_members<MediumFile>(below, upper);
  if (!upper.contains("sources") && whole.contains("sources") && whole["sources"].is_array()) {
    // Nor are there sources of what was taken away.
    Json& sources = whole["sources"];
    sources.erase(std::remove_if(sources.begin(), sources.end(),
                                 [&](const Json& s) { return is_of_part(s, below) && !is_of_part(s, whole); }),
                  sources.end());
  }
  here = std::move(whole);
  json.bases.emplace(pointer, std::make_shared<const JsonText>(std::move(base)));
}

}  // namespace

void resolve_base(JsonText& json, const std::string& pointer) {
  std::vector<std::string> chain;
  if (json.references && pointer.empty()) chain.push_back(identity_of(json.references->naming));
  resolve(json, pointer, std::move(chain));
}

}  // namespace tyndall
