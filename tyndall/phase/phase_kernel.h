#pragma once
// The SIMD form of a sum of lobes: plain structs only, because each instruction set's object exports one symbol and
// shares nothing else with the program (ARCHITECTURE.md). Callers use phase_kernels.h.
#include <cstddef>

#include "tyndall/phase/lobe_record.h"
#include "tyndall/phase/quantile_start.h"

namespace tyndall {

enum class PhaseTask { density, cdf, sample };

/// What to compute for `count` deflections or numbers xi. Arrays need no alignment; they must not overlap.
struct PhaseKernelCall {
  PhaseTask task;
  const LobeRecord* lobes;  // at least one
  int lobe_count;
  std::size_t count;
  const float *mu, *one_minus, *one_plus;  // density, cdf: given
  const float* xi;                         // sample: given
  const QuantileStart* start;              // sample: where searches begin; null: no search, or a long one
  float* value;                            // density, cdf: found
  float *sampled_mu, *sampled_one_minus, *sampled_one_plus;  // sample: found
};

using PhaseKernelFunction = void (*)(const PhaseKernelCall*);

extern "C" {
void phase_kernel_baseline(const PhaseKernelCall*);
void phase_kernel_avx2(const PhaseKernelCall*);
void phase_kernel_avx512(const PhaseKernelCall*);
}

}  // namespace tyndall
