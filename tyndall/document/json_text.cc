#include "tyndall/document/json_text.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "tyndall/document/json_locator.h"
#include "tyndall/document/spelling.h"
#include "tyndall/document/whole_file.h"

namespace tyndall {
namespace {

/// Builds the tree from the parser's events and stops at the first thing we do not allow.
class Builder : public nlohmann::json_sax<Json> {
 public:
  struct Stop {
    std::string pointer, found, expected;  // expected may be empty: JSON
    std::size_t occurrence = 0;
    std::optional<std::size_t> byte;  // instead of the pointer
  };

  Json root;
  std::optional<Stop> stop;

  bool null() override { return add(nullptr); }
  bool boolean(bool x) override { return add(x); }
  bool number_integer(number_integer_t x) override { return add(x); }
  bool number_unsigned(number_unsigned_t x) override { return add(x); }
  bool number_float(number_float_t x, const string_t&) override { return add(x); }
  bool string(string_t& x) override { return add(std::move(x)); }
  bool binary(binary_t&) override { return false; }  // not JSON
  bool start_object(std::size_t) override { return open(Json::object()); }
  bool start_array(std::size_t) override { return open(Json::array()); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }

  bool key(string_t& name) override {
    if (levels_.back().value->contains(name)) {
      return refuse({joined(pointer(levels_.size() - 1), name),
                     "the key " + in_quotes(name) + " a second time",
                     "each key once",
                     1,
                     {}});
    }
    levels_.back().key = std::move(name);
    return true;
  }

  bool parse_error(std::size_t byte, const std::string&, const nlohmann::detail::exception& error) override {
    if (error.id == 406) return refuse({next(), "a number too large for double precision", "finite numbers", 0, byte});
    return refuse({levels_.empty() ? "" : pointer(levels_.size() - 1),
                   "text that is not JSON (" + reason(error.what()) + ")", "", 0, byte});
  }

 private:
  struct Level {
    Json* value;
    std::string key;  // of the member that comes next
  };

  bool refuse(Stop why) {
    stop = std::move(why);
    return false;
  }

  /// Pointer to the open object or list of level `depth`, counted from 0.
  std::string pointer(std::size_t depth) const {
    std::string text;
    for (std::size_t i = 0; i < depth; ++i) {
      const Level& level = levels_[i];
      // A list's open element, being the last one, is already in it.
      const std::size_t last = level.value->is_array() ? level.value->size() - 1 : 0;
      text = joined(text, level.value->is_array() ? std::to_string(last) : level.key);
    }
    return text;
  }

  /// Pointer to the value that comes next.
  std::string next() const {
    if (levels_.empty()) return "";
    const Level& level = levels_.back();
    return joined(pointer(levels_.size() - 1),
                  level.value->is_array() ? std::to_string(level.value->size()) : level.key);
  }

  Json* place(Json value) {
    if (levels_.empty()) return &(root = std::move(value));
    Json& parent = *levels_.back().value;
    if (parent.is_array()) return &parent.emplace_back(std::move(value));
    return &(parent[levels_.back().key] = std::move(value));
  }

  template <class T>
  bool add(T&& value) {
    place(Json(std::forward<T>(value)));
    return true;
  }

  bool open(Json empty) {
    Json* const value = place(std::move(empty));
    levels_.push_back({value, {}});
    if (levels_.size() <= deepest_json) return true;
    return refuse({pointer(levels_.size() - 1),
                   "more than " + std::to_string(deepest_json) + " levels of nesting",
                   "at most " + std::to_string(deepest_json),
                   0,
                   {}});
  }

  bool close() {
    levels_.pop_back();
    return true;
  }

  /// The parser's own words without its preamble and without the piece of the text that it quotes. That piece is
  /// anything: what follows it counts only as one of the phrases that the parser ends its messages with.
  static std::string reason(std::string text) {
    const std::size_t quote = text.find("; last read:");
    if (quote != std::string::npos) {
      std::string expected;
      for (const char* const phrase : {"'['", "'{'", "']'", "'}'", "':'", "','", "end of input", "string literal",
                                       "number literal", "'[', '{', or a literal"}) {
        const std::string end = std::string("'; expected ") + phrase;
        if (text.ends_with(end)) expected = end.substr(1);
      }
      text = text.substr(0, quote) + expected;
    }
    for (const char* const lead : {" while parsing", "column ", "] "}) {
      const std::size_t at = text.find(lead);
      if (at == std::string::npos) continue;
      const std::size_t begin = lead[0] == 'c' ? text.find(": ", at) : at;
      if (begin != std::string::npos) return text.substr(begin + (lead[0] == ' ' ? 1 : 2));
    }
    return text;
  }

  std::vector<Level> levels_;
};

/// What JSON asks for where other formats are more lenient: the most frequent habits, told from the byte at which
/// the parser stopped.
std::string json_expected(std::string_view text, std::size_t at) {
  if (at >= text.size()) return "a whole JSON text";
  const std::string_view rest = text.substr(at), here = text.substr(at == 0 ? 0 : at - 1, 2);
  const std::size_t before = at == 0 ? text.npos : text.find_last_not_of(" \t\r\n", at - 1);
  if (here == "//" || here == "/*" || rest.starts_with("//") || rest.starts_with("/*"))
    return "JSON, which has no comments";
  if ((rest[0] == '}' || rest[0] == ']') && before != text.npos && text[before] == ',') {
    return "JSON, which has no comma after the last element";
  }
  if (rest[0] == '\'') return "JSON, which has texts between double quotes";
  return "JSON";
}

}  // namespace

JsonText parse_json(std::string text, std::string name) {
  if (text.size() > largest_json) {
    throw Fault(place(name), std::to_string(text.size()) + " bytes", "at most " + std::to_string(largest_json));
  }
  // Text in two or four bytes a character has a zero among the first, or a mark at its very beginning.
  if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff") || text.substr(0, 4).find('\0') != text.npos) {
    throw Fault(place(name, 1), "text in UTF-16 or UTF-32", "JSON in UTF-8");
  }
  Builder builder;
  const bool done = Json::sax_parse(text, &builder);
  if (!done) {
    if (!builder.stop) throw Fault(place(name), "text that is not JSON", "JSON");
    const Builder::Stop& stop = *builder.stop;
    const std::size_t byte = stop.byte && *stop.byte > 0 ? *stop.byte - 1 : 0;
    const std::size_t line =
        stop.byte ? line_of_byte(text, byte) : line_of_pointer(text, stop.pointer, stop.occurrence);
    throw Fault(place(name, line, stop.pointer), stop.found,
                stop.expected.empty() ? json_expected(text, byte) : stop.expected);
  }
  return {std::move(name), std::move(text), std::move(builder.root)};
}

JsonText read_json(const std::filesystem::path& file, bool allow_path) {
  JsonText json = parse_json(read_whole_text(file, largest_json), file.string());
  json.references = ReferenceRule{file, allow_path};
  return json;
}

JsonOrigin origin_of(const JsonText& text, const std::string& pointer) {
  for (const auto& [prefix, base] : text.bases) {
    const bool below =
        pointer.starts_with(prefix) && (pointer.size() == prefix.size() || pointer[prefix.size()] == '/');
    if (!below || text.own.contains(Json::json_pointer(pointer))) continue;
    std::string rest = pointer.substr(prefix.size());
    if (base->bases.empty()) {
      while (!rest.empty() && !base->root.contains(Json::json_pointer(rest))) rest.resize(rest.rfind('/'));
    }
    return origin_of(*base, rest);
  }
  return {&text, pointer};
}

JsonCursor JsonCursor::at(std::string_view key) const {
  return {text_, &value_->at(std::string(key)), joined(pointer_, key)};
}

JsonCursor JsonCursor::at(std::size_t index) const {
  return {text_, &value_->at(index), joined(pointer_, std::to_string(index))};
}

Fault JsonCursor::fault(std::string found, std::string expected) const {
  const JsonOrigin origin = origin_of(*text_, pointer_);
  return {place(origin.text->file, line_of_pointer(origin.text->text, origin.pointer), origin.pointer),
          std::move(found), std::move(expected)};
}

DemandFault JsonCursor::fault_below(const Objection& objection) const {
  JsonCursor cursor = *this;
  for (std::size_t begin = 0; begin < objection.field.size();) {
    const std::size_t end = std::min(objection.field.find('/', begin), objection.field.size());
    const std::string step = objection.field.substr(begin, end - begin);
    begin = end + 1;
    const Json& here = cursor.value();
    if (here.is_object() && here.contains(step)) {
      cursor = cursor.at(step);
    } else if (here.is_array() && !step.empty() && step.size() < 10 &&
               step.find_first_not_of("0123456789") == step.npos && std::stoul(step) < here.size()) {
      cursor = cursor.at(std::stoul(step));
    } else {
      break;
    }
  }
  return {cursor.fault("", "").where, objection.found, objection.expected};
}

Fault JsonCursor::wrong_type(std::string expected) const { return fault(described(*value_), std::move(expected)); }

std::string described(const Json& value) {
  switch (value.type()) {
    case Json::value_t::null:
    case Json::value_t::boolean:
      return value.dump();
    case Json::value_t::number_integer:
    case Json::value_t::number_unsigned:
    case Json::value_t::number_float:
      return "the number " + value.dump();
    case Json::value_t::string:
      return "the text " + in_quotes(value.get_ref<const std::string&>());
    case Json::value_t::array:
      return value.empty() ? "an empty list" : "a list of " + std::to_string(value.size());
    default:
      return "an object";
  }
}

std::string joined(const std::string& pointer, std::string_view key) {
  std::string out = pointer + '/';
  for (const char c : key) out += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
  return out;
}

}  // namespace tyndall
