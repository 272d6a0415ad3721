#pragma once
// Pictures made elsewhere, decoded from their bytes in this very process: rehearse() first what is not trusted.
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace tyndall {

/// The most pixels of a decoded picture, and the longest side.
inline constexpr std::int64_t most_pixels = std::int64_t{1} << 27;
inline constexpr int longest_side = 16384;

/// RGB, row-major, top row first.
template <class T>
struct Decoded {
  int width = 0, height = 0;
  std::vector<T> rgb;
  std::vector<T> alpha;  // empty where the picture has none
};

/// A PNG or JPEG picture as 8-bit codes (16-bit PNGs are rounded, grey is spread). Sizes are checked before pixels are
/// allocated. Throws Fault {where, ..}.
Decoded<std::uint8_t> decode_picture(const std::string& where, std::span<const std::uint8_t> bytes);

}  // namespace tyndall
