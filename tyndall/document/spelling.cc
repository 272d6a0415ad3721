#include "tyndall/document/spelling.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>

namespace tyndall {
namespace {

/// One character of UTF-8 text: how many bytes it takes, and its code point; broken bytes are one byte long.
struct Character {
  std::size_t length = 1;
  std::uint32_t code = 0;
  bool broken = false;
};

Character character_at(std::string_view text, std::size_t i) {
  const auto byte = [&](std::size_t at) { return static_cast<std::uint8_t>(text[at]); };
  const std::uint8_t first = byte(i);
  if (first < 0x80) return {1, first, false};
  const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || i + length > text.size()) return {1, first, true};
  std::uint32_t code = first & (0x7Fu >> length);
  for (std::size_t k = 1; k < length; ++k) {
    if ((byte(i + k) & 0xC0) != 0x80) return {1, first, true};
    code = code << 6 | (byte(i + k) & 0x3Fu);
  }
  const std::uint32_t least = length == 2 ? 0x80 : length == 3 ? 0x800 : 0x10000;
  if (code < least || code > 0x10FFFF || (code >= 0xD800 && code <= 0xDFFF)) return {1, first, true};
  return {length, code, false};
}

/// Control characters, and marks that make a terminal show text in another order than it has.
bool disturbs(std::uint32_t code) {
  return code < 0x20 || (code >= 0x7F && code < 0xA0) || code == 0x200E || code == 0x200F ||
         (code >= 0x2028 && code <= 0x202E) || (code >= 0x2066 && code <= 0x2069);
}

std::string escaped(const Character& c) {
  if (!c.broken && c.code == '\n') return "\\n";
  if (!c.broken && c.code == '\t') return "\\t";
  char text[16];
  std::snprintf(text, sizeof text, c.broken ? "\\x%02x" : "\\u%04x", static_cast<unsigned>(c.code));
  return text;
}

}  // namespace

std::string printable(std::string_view text, std::size_t most) {
  std::string out;
  std::size_t count = 0;
  for (std::size_t i = 0; i < text.size(); ++count) {
    if (count == most) return out + "...";
    const Character c = character_at(text, i);
    out += c.broken || disturbs(c.code) ? escaped(c) : std::string(text.substr(i, c.length));
    i += c.length;
  }
  return out;
}

std::string in_quotes(std::string_view text, std::size_t most) { return '"' + printable(text, most) + '"'; }

std::size_t edit_distance(std::string_view a, std::string_view b) {
  // Three rows of the table suffice: a swap looks two rows back.
  std::vector<std::size_t> before(b.size() + 1), above(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before.swap(above);
    above.swap(row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = above[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({above[j] + 1, row[j - 1] + 1, replaced});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) row[j] = std::min(row[j], before[j - 2] + 1);
    }
  }
  return row[b.size()];
}

std::string_view nearest_spelling(std::string_view word, const std::vector<std::string_view>& candidates) {
  if (word.size() > 64) return {};
  const std::size_t allowed = std::max<std::size_t>(1, word.size() / 3);
  std::string_view best;
  std::size_t least = allowed + 1;
  for (const std::string_view candidate : candidates) {
    const std::size_t distance = edit_distance(word, candidate);
    if (distance < least && distance < candidate.size()) {
      least = distance;
      best = candidate;
    }
  }
  return best;
}

std::string one_of(std::string_view word, const std::vector<std::string_view>& candidates) {
  if (candidates.empty()) return "nothing";
  std::string text = candidates.size() == 1 ? "" : "one of ";
  for (std::size_t i = 0; i < candidates.size(); ++i) text += (i == 0 ? "" : ", ") + std::string(candidates[i]);
  const std::string_view near = nearest_spelling(word, candidates);
  if (!near.empty()) text += " (did you mean \"" + std::string(near) + "\"?)";
  return text;
}

}  // namespace tyndall
