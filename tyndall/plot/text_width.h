#pragma once
// How wide text is in DejaVu Sans, the font that figures are laid out for, without a font at hand.
#include <string>
#include <string_view>

namespace tyndall {

/// Any bytes as text that can be drawn: what printable() escapes is escaped, noncharacters become U+FFFD.
std::string drawable(std::string_view text);

/// Width of `text` (UTF-8 without control characters) at a font size, in the size's unit. Exact for Latin-1 and the
/// signs that figures use; other characters count as wide as they commonly are at most.
double text_width(std::string_view text, double size);

/// Whether all of its characters have an exact width. Others may take any space (fonts differ, marks pile up), so they
/// are drawn inside their box only.
bool has_exact_width(std::string_view text);

/// `text` if it is no wider than `width`, else as much of it as fits and an ellipsis.
std::string shortened(std::string_view text, double size, double width);

}  // namespace tyndall
