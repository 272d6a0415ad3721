#pragma once
// Sixteen-bit floats (IEEE 754-2008, binary16) of numbers that are not negative, without the processor's help.
#include <bit>
#include <cmath>
#include <cstdint>

namespace tyndall {

inline constexpr double least_half = 0x1p-14, greatest_half = 65504.0;

/// The nearest half of a number in [0, greatest_half]. Below least_half, where halves lose their digits one by one:
/// 0 or least_half, whichever is nearer. Relative error elsewhere: 2^-11.
inline std::uint16_t half_of(double x) {
  if (x < 0.5 * least_half) return 0;
  if (x < least_half) x = least_half;
  int exponent = 0;
  const double fraction = std::frexp(x, &exponent);
  const auto mantissa = static_cast<int>(std::nearbyint(fraction * 2048.0));  // 1024 to 2048, which carries over
  return static_cast<std::uint16_t>(((exponent + 14) << 10) + mantissa - 1024);
}

/// The number that a half stands for, exact; bits of half_of.
inline float number_of(std::uint16_t half) {
  // The exponent's bias is 112 less, which a multiplication mends; so 0 stays 0.
  return std::bit_cast<float>(static_cast<std::uint32_t>(half) << 13) * 0x1p112f;
}

/// Whether 16 bits are what half_of makes: not negative, finite and no subnormal.
inline bool is_plain_half(std::uint16_t half) { return half == 0 || (half >= 0x0400 && half < 0x7C00); }

}  // namespace tyndall
