#pragma once
// The random numbers of one sample of one pixel.
#include <algorithm>

#include "tyndall/sampling/owen_sobol.h"
#include "tyndall/sampling/philox.h"

namespace tyndall {

/// Numbers in the order of their dimensions, each a function of seed, pixel, sample and dimension alone.
class RandomStream {
 public:
  /// How the samples of one pixel relate. `even`: in each of the first `even_dimensions` dimensions (of every branch)
  /// the first 2^k samples fill 2^k equal cells, and pairs of dimensions the unit square (owen_sobol.h). Every sample
  /// alone is as random as an independent one, so means stay unbiased; they are mostly better than a standard error
  /// computed as for independent samples says.
  enum class Samples { independent, even };
  static constexpr std::uint32_t even_dimensions = 128;

  /// seed: chosen by the user; pixel, sample (below 2^32 - 1): which numbers; the dimension counts from 0.
  RandomStream(std::uint64_t seed, std::uint64_t pixel, std::uint32_t sample, Samples samples = Samples::independent)
      : sample_(sample),
        pixel_{static_cast<std::uint32_t>(pixel), static_cast<std::uint32_t>(pixel >> 32)},
        key_{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)},
        samples_(samples) {}

  /// The next number, uniform in (0, 1).
  double next() {
    if (dimension_ % 4 == 0 || fresh_) {
      if (samples_ == Samples::even && dimension_ % branch_size < even_dimensions) {
        fill_evenly();
      } else {
        words_ = philox({dimension_ / 4, sample_, pixel_[0], pixel_[1]}, key_);
      }
      fresh_ = false;
    }
    return unit_real(words_[dimension_++ % 4]);
  }

  /// Goes on at the next dimension that is a multiple of `block`, itself a multiple of 4: what follows has the same
  /// dimensions in every sample, whether or not what came before used all of its own. Never goes back, so no number is
  /// used twice.
  void align(std::uint32_t block) { move_to((dimension_ + block - 1) / block * block); }

  /// Begins branch 1, 2, .. (below 2^12) of a walk that forks. A branch has 2^20 dimensions.
  void begin_branch(std::uint32_t branch) { move_to(std::max(dimension_, branch * branch_size)); }

 private:
  static constexpr std::uint32_t branch_size = 1u << 20;
  static constexpr std::uint32_t no_sample = ~0u;  // words that all samples of a pixel share

  void move_to(std::uint32_t dimension) {
    fresh_ = fresh_ || dimension != dimension_;
    dimension_ = dimension;
  }

  void fill_evenly() {
    const std::uint32_t first = dimension_ / 4 * 2;
    for (std::uint32_t pair = 0; pair < 2; ++pair) {
      const auto point = owen_sobol_pair(sample_, philox({first + pair, no_sample, pixel_[0], pixel_[1]}, key_));
      words_[2 * pair] = point[0], words_[2 * pair + 1] = point[1];
    }
  }

  std::uint32_t sample_, dimension_ = 0;
  std::array<std::uint32_t, 2> pixel_, key_;
  std::array<std::uint32_t, 4> words_{};
  Samples samples_;
  bool fresh_ = false;  // moved to a dimension whose words are not computed yet
};

}  // namespace tyndall
