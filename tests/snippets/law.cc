#include <cstdio>

// [law]
#include "tyndall/phase/law.h"

int main() {
  using namespace tyndall;
  const Law<float> law =
      Mixture<float>{{{0.3f, MieHazy<float>{}}, {0.7f, HenyeyGreenstein<float>{0.95f}}}};  // any law of the list
  const LobeSum<float> lobes = lower(law);  // once; the rest is arithmetic

  const auto straight = Deflection<float>::from_ends(0.0f, 2.0f);  // 1 - mu and 1 + mu
  const auto sideways = Deflection<float>::from_mu(0.0f);
  std::printf("density %.4f forward, %.6f sideways [1/sr]\n", static_cast<double>(density(lobes, straight)),
              static_cast<double>(density(lobes, sideways)));
  const Deflection<float> drawn = sample(lobes, 0.25f);  // the exact inverse of cdf
  std::printf("mu = %.4f has a cdf of %.4f; mean cosine %.4f\n", static_cast<double>(drawn.mu),
              static_cast<double>(cdf(lobes, drawn)), static_cast<double>(mean_cosine(lobes)));
}
// [end]
