#include <cstdio>
#include <numeric>
#include <vector>

#include "tyndall/phase/law.h"

// [arrays]
#include "tyndall/phase/phase_kernels.h"

int main() {
  using namespace tyndall;
  const PhaseArrays phase(lower(Law<float>{HenyeyGreenstein<float>{0.9f}}));  // for the widest instruction set here
  std::vector<float> xi(1024), mu(1024), one_minus(1024), one_plus(1024), density(1024);
  for (std::size_t i = 0; i < xi.size(); ++i) xi[i] = (static_cast<float>(i) + 0.5f) / 1024.0f;
  phase.sample(xi, {mu, one_minus, one_plus});
  phase.density({mu, one_minus, one_plus}, density);
  const float mean = std::accumulate(mu.begin(), mu.end(), 0.0f) / 1024.0f;
  std::printf("mean cosine of 1024 samples %.3f\n", static_cast<double>(mean));
  // [end]
  return density[1023] > density[0] ? 0 : 1;
}
