#pragma once
// Counter-based random numbers: any number of any sequence can be computed alone, so that a picture does not depend on
// the order in which its pixels are made.
#include <array>
#include <cstdint>

namespace tyndall {

/// Philox4x32-10 (Salmon, Moraes, Dror and Shaw 2011): four random words of a 128-bit counter under a 64-bit key.
inline std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key) {
  for (int round = 0; round < 10; ++round) {
    const std::uint64_t a = std::uint64_t{0xD2511F53u} * counter[0], b = std::uint64_t{0xCD9E8D57u} * counter[2];
    counter = {static_cast<std::uint32_t>(b >> 32) ^ counter[1] ^ key[0], static_cast<std::uint32_t>(b),
               static_cast<std::uint32_t>(a >> 32) ^ counter[3] ^ key[1], static_cast<std::uint32_t>(a)};
    key[0] += 0x9E3779B9u;
    key[1] += 0xBB67AE85u;
  }
  return counter;
}

/// A word as a number in (0, 1): the middle of one of 2^32 equal cells, never 0 or 1.
inline double unit_real(std::uint32_t word) { return (word + 0.5) * 0x1p-32; }

}  // namespace tyndall
