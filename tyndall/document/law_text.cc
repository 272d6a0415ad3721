#include "tyndall/document/law_text.h"

#include <algorithm>
#include <charconv>

#include "tyndall/artist/stated_species.h"
#include "tyndall/document/binding.h"

namespace tyndall {
namespace {

std::string_view before_colon(std::string_view text) { return text.substr(0, text.find(':')); }

/// What a person names on the command line is looked for where the command was given, and may be anywhere.
const ReferenceRule anywhere{"", true};

/// A number where it is one, else the text itself: binding then says what it should have been.
Json value_of(std::string_view text) {
  double x = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), x);
  if (error == std::errc() && end == text.data() + text.size() && std::isfinite(x)) return x;
  return std::string(text);
}

}  // namespace

std::vector<std::string_view> law_names() {
  std::vector<std::string_view> names;
  for_each_alternative<Law<double>>([&]<class L>(std::type_identity<L>) { names.push_back(L::name); });
  return names;
}

bool is_law_text(std::string_view text) {
  const auto names = law_names();
  return text.substr(0, 1) == "{" || std::find(names.begin(), names.end(), before_colon(text)) != names.end();
}

Law<double> law_from_text(const std::string& text) {
  const std::string name = "law " + in_quotes(text, 80);
  if (text.substr(0, 1) == "{") {
    JsonText json = parse_json(text, name);
    json.references = anywhere;
    return read_as<Law<double>>(JsonCursor(json));
  }
  JsonText json{name, "", Json::object(), anywhere};
  const std::string_view law = before_colon(text);
  json.root["law"] = law;
  std::string_view rest = std::string_view(text).substr(std::min(law.size() + 1, text.size()));
  if (rest.empty() && law.size() < text.size()) throw Fault(name, "nothing after the colon", "parameter=value");
  while (!rest.empty()) {
    const std::string_view pair = rest.substr(0, rest.find(','));
    const bool more = pair.size() < rest.size();
    rest.remove_prefix(pair.size() + (more ? 1 : 0));
    const std::size_t equals = pair.find('=');
    if (equals == std::string_view::npos || (more && rest.empty())) {
      throw Fault(name, in_quotes(equals == std::string_view::npos ? pair : ","), "parameter=value");
    }
    const std::string key(pair.substr(0, equals));
    if (json.root.contains(key)) throw Fault(name, in_quotes(key) + " a second time", "each parameter once");
    json.root[key] = value_of(pair.substr(equals + 1));
  }
  return read_as<Law<double>>(JsonCursor(json));
}

}  // namespace tyndall
