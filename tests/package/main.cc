// What a renderer of somebody else does with Tyndall first: a law, its lobes, a density, a sample.
#include <cmath>
#include <cstdio>

#include "tyndall/phase/law.h"

int main() {
  const tyndall::Law<float> law = tyndall::HenyeyGreenstein<float>{0.7f};
  const tyndall::LobeSum<float> lobes = tyndall::lower(law);
  // A sampled direction's share of the density below it is the random number it came from.
  float worst = 0.0f;
  for (int i = 1; i < 100; ++i) {
    const float u = static_cast<float>(i) / 100.0f;
    const tyndall::Deflection<float> direction = tyndall::sample(law, u);
    if (!(tyndall::density(lobes, direction) > 0.0f)) return 1;
    worst = std::fmax(worst, std::fabs(tyndall::cdf(lobes, direction) - u));
  }
  std::printf("Henyey-Greenstein 0.7: mean cosine %g, |cdf(sample(u)) - u| <= %.1e\n",
              static_cast<double>(tyndall::mean_cosine(lobes)), static_cast<double>(worst));
  return worst < 1e-5f ? 0 : 1;
}
