#include "tyndall/document/json_locator.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace tyndall {
namespace {

/// Walks a JSON text value by value, never beyond its end. It trusts nothing: where the text is not as expected the
/// walk ends.
class Walk {
 public:
  explicit Walk(std::string_view text) : text_(text) {
    if (text_.substr(0, 3) == "\xEF\xBB\xBF") at_ = 3;  // byte order mark
  }

  std::size_t position() const { return at_; }

  char next() {
    while (at_ < text_.size() && std::string_view(" \t\r\n").find(text_[at_]) != std::string_view::npos) ++at_;
    return at_ < text_.size() ? text_[at_] : '\0';
  }
  bool take(char c) {
    if (next() != c) return false;
    ++at_;
    return true;
  }

  /// The string token that starts here, quotes included; empty when there is none.
  std::string_view take_string() {
    if (next() != '"') return {};
    const std::size_t begin = at_++;
    while (at_ < text_.size() && text_[at_] != '"') at_ += text_[at_] == '\\' ? 2 : 1;
    if (at_ >= text_.size()) return {};
    return text_.substr(begin, ++at_ - begin);
  }

  /// Moves past one value without descending in calls: brackets are counted.
  bool skip_value() {
    std::size_t open = 0;
    do {
      const char c = next();
      if (c == '\0') return false;
      if (c == '"') {
        if (take_string().empty()) return false;
      } else if (c == '{' || c == '[') {
        ++open;
        ++at_;
      } else if (c == '}' || c == ']') {
        if (open == 0) return false;
        --open;
        ++at_;
      } else if (c == ',' || c == ':') {
        if (open == 0) return false;
        ++at_;
      } else {
        at_ = std::min(text_.find_first_of(",:{}[]\" \t\r\n", at_), text_.size());
      }
    } while (open > 0);
    return true;
  }

 private:
  std::string_view text_;
  std::size_t at_ = 0;
};

std::optional<std::string> decoded(std::string_view token) {
  const auto value = nlohmann::json::parse(token, nullptr, false);
  return value.is_string() ? std::optional(value.get<std::string>()) : std::nullopt;
}

/// The keys of an RFC 6901 pointer.
std::vector<std::string> steps_of(std::string_view pointer) {
  std::vector<std::string> steps;
  for (std::size_t i = 0; i < pointer.size(); ++i) {
    if (pointer[i] == '/') {
      steps.emplace_back();
    } else if (steps.empty()) {
      return {};
    } else if (pointer[i] == '~' && i + 1 < pointer.size()) {
      steps.back() += pointer[++i] == '0' ? '~' : '/';
    } else {
      steps.back() += pointer[i];
    }
  }
  return steps;
}

/// Enters the member `key` of the object that starts here; gives the position of its key.
std::optional<std::size_t> enter_member(Walk& walk, const std::string& key, std::size_t occurrence) {
  if (!walk.take('{')) return std::nullopt;
  do {
    walk.next();
    const std::size_t begin = walk.position();
    const auto name = decoded(walk.take_string());
    if (!name) return std::nullopt;
    const bool last = *name == key && occurrence-- == 0;
    if (!walk.take(':')) return last ? std::optional(begin) : std::nullopt;
    if (last) return begin;
  } while (walk.skip_value() && walk.take(','));
  return std::nullopt;
}

/// Enters the element `index` of the list that starts here; gives its position.
std::optional<std::size_t> enter_element(Walk& walk, const std::string& index) {
  if (index.empty() || index.size() > 9 || index.find_first_not_of("0123456789") != std::string::npos) return {};
  if (!walk.take('[')) return std::nullopt;
  for (std::size_t left = std::stoul(index); left > 0; --left) {
    if (!walk.skip_value() || !walk.take(',')) return std::nullopt;
  }
  walk.next();
  return walk.position();
}

}  // namespace

std::size_t line_of_byte(std::string_view text, std::size_t byte) {
  const std::string_view before = text.substr(0, byte);
  return 1 + static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'));
}

std::size_t line_of_pointer(std::string_view text, std::string_view pointer, std::size_t occurrence) {
  Walk walk(text);
  walk.next();
  std::size_t found = walk.position();
  const std::vector<std::string> steps = steps_of(pointer);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const bool last = i + 1 == steps.size();
    const auto position =
        walk.next() == '[' ? enter_element(walk, steps[i]) : enter_member(walk, steps[i], last ? occurrence : 0);
    if (!position) return 0;
    found = *position;
  }
  return line_of_byte(text, found);
}

}  // namespace tyndall
