#pragma once
// Random numbers for a count of trials that is not known before.
#include <bit>
#include <cstdint>

namespace tyndall {

/// SplitMix64 (G. Steele, D. Lea, C. Flood, "Fast splittable pseudorandom number generators", OOPSLA 2014, fig. 14),
/// begun by two numbers of a better generator, of which alone it is a function.
class QuickRandom {
 public:
  QuickRandom(double a, double b)
      : state_(std::bit_cast<std::uint64_t>(a) + std::rotl(std::bit_cast<std::uint64_t>(b), 29)) {
    next();
  }
  /// Uniform in [0, 1), a multiple of 2^-53.
  double next() {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15U;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
  }

 private:
  std::uint64_t state_;
};

}  // namespace tyndall
