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

/// The random numbers of one sample of one pixel, in the order of its dimensions.
class RandomStream {
 public:
  /// seed: chosen by the user; pixel, sample: which numbers; the dimension counts from 0.
  RandomStream(std::uint64_t seed, std::uint64_t pixel, std::uint32_t sample)
      : counter_{0, sample, static_cast<std::uint32_t>(pixel), static_cast<std::uint32_t>(pixel >> 32)},
        key_{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)} {}

  /// The next number, uniform in (0, 1).
  double next() {
    if (used_ == 4) {
      words_ = philox(counter_, key_);
      ++counter_[0];
      used_ = 0;
    }
    return unit_real(words_[used_++]);
  }

 private:
  std::array<std::uint32_t, 4> counter_;
  std::array<std::uint32_t, 2> key_;
  std::array<std::uint32_t, 4> words_{};
  unsigned used_ = 4;
};

}  // namespace tyndall
