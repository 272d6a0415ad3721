#pragma once
// JSON files as text with places: parsed strictly, and able to say on which line a value stands.
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "tyndall/document/fault.h"
#include "tyndall/number/described.h"
#include "tyndall/number/grid_file.h"
#include "tyndall/number/number_file.h"

namespace tyndall {

using Json = nlohmann::json;

inline constexpr std::size_t deepest_json = 64;
inline constexpr std::size_t largest_json = std::size_t{16} << 20;  // bytes

/// The files of numbers that one text names: each is read once; and how many numbers they stand for, counted each time
/// that one is named, which is work each time. Grids by path, a zero byte and their name, and the bytes they take.
struct NamedNumbers {
  std::map<std::string, std::shared_ptr<const NumberRows>> files;
  std::size_t count = 0;
  std::map<std::string, GridFile> grids;
  std::uint64_t grid_bytes = 0;
};
inline constexpr std::size_t most_named_numbers = 8000000;

/// Where the files that a text names are looked for (reference.h).
struct ReferenceRule {
  std::filesystem::path naming;  // the file that the text is, or will be
  bool allow_path = false;       // files outside its folder too
  std::shared_ptr<NamedNumbers> numbers = std::make_shared<NamedNumbers>();
};

/// A parsed text that remembers where it came from.
struct JsonText {
  std::string file;  // its name in messages
  std::string text;
  Json root;
  std::optional<ReferenceRule> references = {};  // none: the text stands in no folder and can name no files
  // Where values of other texts were put under this one's (base_medium.h): by pointer, the text below the value there;
  // and the root as this text alone has it.
  std::map<std::string, std::shared_ptr<const JsonText>> bases = {};
  Json own = {};
  std::uint64_t base_bytes = 0;  // of text that was laid under this one, counted each time that it was
};

/// Parses UTF-8 JSON (RFC 8259) with no duplicate keys, at most deepest_json levels and only numbers that a double can
/// hold. Throws Fault for anything else. `name` is what messages call the text.
JsonText parse_json(std::string text, std::string name);

/// Reads and parses a file of at most largest_json bytes; its path is its name, and references start from its folder.
/// Throws Fault.
JsonText read_json(const std::filesystem::path& file, bool allow_path = false);

/// The text that states a value of `text`, and its place there: the text itself, or one of its bases where only that
/// has it. The place is that of the deepest part of the pointer that the text has.
struct JsonOrigin {
  const JsonText* text;
  std::string pointer;
};
JsonOrigin origin_of(const JsonText& text, const std::string& pointer);

/// One value of a JsonText and the way to it. Refers to the JsonText, which must outlive it.
class JsonCursor {
 public:
  explicit JsonCursor(const JsonText& text) : text_(&text), value_(&text.root) {}

  const Json& value() const { return *value_; }
  /// RFC 6901, "" for the root.
  const std::string& pointer() const { return pointer_; }
  const std::string& file() const { return text_->file; }
  const std::optional<ReferenceRule>& references() const { return origin_of(*text_, pointer_).text->references; }

  /// A member of an object, an element of a list: it must exist.
  JsonCursor at(std::string_view key) const;
  JsonCursor at(std::size_t index) const;

  /// A Fault about this value, with file, line and pointer.
  Fault fault(std::string found, std::string expected) const;
  /// The fault that an objection to this value amounts to. Its field is a path below this value; the place is that of
  /// the deepest part of the path that is written here.
  DemandFault fault_below(const Objection& objection) const;
  /// A Fault about this value having the wrong type: found is described() of it.
  Fault wrong_type(std::string expected) const;

 private:
  JsonCursor(const JsonText* text, const Json* value, std::string pointer)
      : text_(text), value_(value), pointer_(std::move(pointer)) {}

  const JsonText* text_;
  const Json* value_;
  std::string pointer_;
};

/// A value as a message may name it: "the number 5", "the text \"abc\"", "a list of 2", "an object", "true", "null".
std::string described(const Json& value);

/// `pointer` extended by a key, escaped as RFC 6901 says.
std::string joined(const std::string& pointer, std::string_view key);

}  // namespace tyndall
