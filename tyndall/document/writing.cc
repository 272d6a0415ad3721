#include "tyndall/document/writing.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>

namespace tyndall {
namespace {

constexpr std::size_t line_width = 110;

std::string one_line(const OrderedJson& value) {
  const auto list = [](const OrderedJson& parts, char open, char close, auto text_of) {
    std::string text(1, open);
    for (auto it = parts.begin(); it != parts.end(); ++it) text += (it == parts.begin() ? "" : ", ") + text_of(it);
    return text + close;
  };
  if (value.is_array()) {
    return list(value, '[', ']', [](const auto& it) { return one_line(*it); });
  }
  if (value.is_object() && !value.empty()) {
    const std::string inner = list(value, '{', '}', [](const auto& it) {
      return OrderedJson(it.key()).dump(-1, ' ', false, OrderedJson::error_handler_t::replace) + ": " + one_line(*it);
    });
    return "{ " + inner.substr(1, inner.size() - 2) + " }";
  }
  if (value.is_number_float()) return number_text(value.get<double>());
  return value.dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
}

/// A long list of numbers, as many on a line as fit, up to its closing bracket.
std::string filled(const OrderedJson& list, const std::string& margin) {
  std::string text = "[", line;
  for (auto it = list.begin(); it != list.end(); ++it) {
    const std::string number = one_line(*it) + (it + 1 == list.end() ? "" : ",");
    if (!line.empty() && margin.size() + line.size() + number.size() + 1 > line_width) {
      text += '\n' + margin + line;
      line.clear();
    }
    line += (line.empty() ? "" : " ") + number;
  }
  return text + '\n' + margin + line;
}

void append(const OrderedJson& value, std::size_t indent, std::size_t used, std::string& out) {
  const std::string line = one_line(value);
  if (used + line.size() <= line_width || !value.is_structured() || value.empty()) {
    out += line;
    return;
  }
  const std::string margin(indent + 2, ' ');
  if (value.is_array() && std::all_of(value.begin(), value.end(), [](const auto& x) { return x.is_number(); })) {
    out += filled(value, margin) + '\n' + std::string(indent, ' ') + ']';
    return;
  }
  out += value.is_array() ? '[' : '{';
  for (auto it = value.begin(); it != value.end(); ++it) {
    out += (it == value.begin() ? "\n" : ",\n") + margin;
    std::string key;
    if (value.is_object()) {
      key = OrderedJson(it.key()).dump(-1, ' ', false, OrderedJson::error_handler_t::replace) + ": ";
      out += key;
    }
    append(*it, indent + 2, margin.size() + key.size() + 1, out);
  }
  out += '\n' + std::string(indent, ' ') + (value.is_array() ? ']' : '}');
}

}  // namespace

std::string number_text(double x) {
  // nlohmann's own (Grisu2) is now and then a digit longer than need be; to_chars is not, but writes 1e-04 for 0.0001.
  char scientific[32];
  const auto end = std::to_chars(scientific, scientific + sizeof scientific, x, std::chars_format::scientific).ptr;
  const std::string_view text(scientific, static_cast<std::size_t>(end - scientific));
  const std::size_t e = text.find('e');
  const int exponent = std::atoi(std::string(text.substr(e + 1)).c_str());
  if (exponent < -4 || exponent >= 15) {
    return std::string(text.substr(0, e + 1)) + (exponent < 0 ? "" : "+") + std::to_string(exponent);
  }
  char fixed[32];
  std::string out(fixed, std::to_chars(fixed, fixed + sizeof fixed, x, std::chars_format::fixed).ptr);
  // "-0" would be read as the integer 0.
  return out.find('.') == out.npos ? out + ".0" : out;
}

OrderedJson written_number(double x) {
  if (!std::isfinite(x)) return nullptr;
  if (x == std::trunc(x) && std::fabs(x) < 1e15 && !(x == 0.0 && std::signbit(x))) {
    return static_cast<std::int64_t>(x);
  }
  return x;
}

std::string pretty(const OrderedJson& value) {
  std::string out;
  append(value, 0, 0, out);
  return out + '\n';
}

}  // namespace tyndall
