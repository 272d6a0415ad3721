#include "tyndall/plot/text_width.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "tyndall/document/spelling.h"
#include "tyndall/plot/figure.h"

namespace tyndall {
namespace {

constexpr double units_per_em = 2048.0;

// Advance widths of DejaVu Sans 2.37 for U+0020 to U+007E and U+00A0 to U+00FF; a test compares them with the font.
constexpr std::array<std::uint16_t, 95> ascii = {
    651,  821,  942,  1716, 1303, 1946, 1597, 563,  799,  799,  1024, 1716, 651,  739,  651,  690,  1303, 1303, 1303,
    1303, 1303, 1303, 1303, 1303, 1303, 1303, 690,  690,  1716, 1716, 1716, 1087, 2048, 1401, 1405, 1430, 1577, 1294,
    1178, 1587, 1540, 604,  604,  1343, 1141, 1767, 1532, 1612, 1235, 1612, 1423, 1300, 1251, 1499, 1401, 2025, 1403,
    1251, 1403, 799,  690,  799,  1716, 1024, 1024, 1255, 1300, 1126, 1300, 1260, 721,  1300, 1298, 569,  569,  1186,
    569,  1995, 1298, 1253, 1300, 1300, 842,  1067, 803,  1298, 1212, 1675, 1212, 1212, 1075, 1303, 690,  1303, 1716};
constexpr std::array<std::uint16_t, 96> latin = {
    651,  821,  1303, 1303, 1303, 1303, 690,  1024, 1024, 2048, 965,  1253, 1716, 739,  2048, 1024,
    1024, 1716, 821,  821,  1024, 1303, 1303, 651,  1024, 821,  965,  1253, 1985, 1985, 1985, 1087,
    1401, 1401, 1401, 1401, 1401, 1401, 1995, 1430, 1294, 1294, 1294, 1294, 604,  604,  604,  604,
    1587, 1532, 1612, 1612, 1612, 1612, 1612, 1716, 1612, 1499, 1499, 1499, 1499, 1251, 1239, 1290,
    1255, 1255, 1255, 1255, 1255, 1255, 2011, 1126, 1260, 1260, 1260, 1260, 569,  569,  569,  569,
    1253, 1298, 1253, 1253, 1253, 1253, 1253, 1716, 1253, 1298, 1298, 1298, 1298, 1212, 1300, 1212};

struct Advance {
  double units;
  bool exact;
};

Advance advance(char32_t c) {
  if (c >= 0x20 && c < 0x7F) return {double(ascii[c - 0x20]), true};
  if (c >= 0xA0 && c <= 0xFF) return {double(latin[c - 0xA0]), true};
  if (c == 0x2070 || (c >= 0x2074 && c <= 0x2079)) return {821.0, true};  // raised digits
  if (c == 0x207B) return {1081.0, true};                                 // raised minus
  if (c == 0x2212) return {1716.0, true};                                 // minus
  if (c == 0x2013) return {1024.0, true};                                 // dash
  if (c == 0x2026) return {2048.0, true};                                 // ellipsis
  if (c == 0x221E) return {1706.0, true};                                 // infinity
  const bool narrow = c < 0x1100;  // alphabets; beyond them mostly signs that fill a square
  return {narrow ? 1640.0 : 2048.0, false};
}

/// The code point at `i`, which moves behind it; a stray byte stands for itself.
char32_t next(std::string_view text, std::size_t& i) {
  const auto byte = static_cast<std::uint8_t>(text[i++]);
  if (byte < 0xC0) return byte;
  char32_t code = byte & (byte >= 0xF0 ? 0x07u : byte >= 0xE0 ? 0x0Fu : 0x1Fu);
  while (i < text.size() && (static_cast<std::uint8_t>(text[i]) & 0xC0) == 0x80) {
    code = code << 6 | (static_cast<std::uint8_t>(text[i++]) & 0x3Fu);
  }
  return code;
}

}  // namespace

std::string drawable(std::string_view text) {
  const std::string safe = printable(text, std::numeric_limits<std::size_t>::max());
  std::string out;
  for (std::size_t i = 0; i < safe.size();) {
    const std::size_t begin = i;
    const char32_t c = next(safe, i);
    const bool nothing = (c & 0xFFFE) == 0xFFFE || (c >= 0xFDD0 && c <= 0xFDEF);
    out += nothing ? "\uFFFD" : safe.substr(begin, i - begin);
  }
  return out;
}

double text_width(std::string_view text, double size) {
  double units = 0.0;
  for (std::size_t i = 0; i < text.size();) units += advance(next(text, i)).units;
  return units / units_per_em * size;
}

bool has_exact_width(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    if (!advance(next(text, i)).exact) return false;
  }
  return true;
}

std::string shortened(std::string_view text, double size, double width) {
  if (text_width(text, size) <= width) return std::string(text);
  const std::string_view ellipsis = "\u2026";
  const double room = width - text_width(ellipsis, size);
  std::size_t kept = 0;
  double used = 0.0;
  for (std::size_t i = 0; i < text.size();) {
    used += advance(next(text, i)).units / units_per_em * size;
    if (used > room) break;
    kept = i;
  }
  while (kept > 0 && text[kept - 1] == ' ') --kept;
  return std::string(text.substr(0, kept)) + std::string(ellipsis);
}

Rectangle bounds(const Text& text) {
  // Accents and brackets of DejaVu Sans stay within these.
  const double above = 0.80 * text.size, below = 0.24 * text.size, width = text_width(drawable(text.text), text.size);
  const double before = text.anchor == Anchor::start ? 0.0 : text.anchor == Anchor::middle ? width / 2.0 : width;
  if (text.upwards) return {text.at.x - above, text.at.y + before - width, above + below, width};
  return {text.at.x - before, text.at.y - above, width, above + below};
}

}  // namespace tyndall
