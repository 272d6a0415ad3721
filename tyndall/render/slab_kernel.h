#pragma once
// The SIMD part of `tyndall slab`: plain structs only, because each instruction set's object exports one symbol and
// shares nothing else with the program (ARCHITECTURE.md).
#include <cstddef>
#include <cstdint>

#include "tyndall/phase/lobe_record.h"

namespace tyndall {

/// A lobe and how much it scatters.
struct SlabLobe {
  LobeRecord lobe;
  float scattering[3];  // optical depth of scattering by this lobe over a unit of depth, per channel
};

/// A homogeneous slab, 0 <= z <= thickness downward, and the paths to trace through it.
struct SlabTask {
  int channels;  // 1 (all channels alike) or 3
  const SlabLobe* lobes;
  int lobe_count;
  float extinction[3], scattering[3];  // per unit of z
  float thickness;                     // in units of z; infinity is a half space
  float mu0;                           // cosine of incidence; 0: diffuse illumination
  float ground;                        // Lambertian albedo below
  const float* mu;                     // exit cosines, mu_count of them
  int mu_count;
  std::uint64_t seed;
  std::uint32_t first_path, path_count;
};

/// How many tallies a task adds up: reflectance, transmittance, then reflection and transmission at each mu; each per
/// channel.
constexpr std::size_t slab_tally_count(int channels, int mu_count) {
  return static_cast<std::size_t>(channels) * 2 * (1 + static_cast<std::size_t>(mu_count));
}

/// Adds each path's tallies to sum and their squares to sum_of_squares (slab_tally_count each, in path order of
/// completion).
using SlabKernel = void (*)(const SlabTask*, double* sum, double* sum_of_squares);

extern "C" {
void slab_baseline(const SlabTask*, double*, double*);
void slab_avx2(const SlabTask*, double*, double*);
void slab_avx512(const SlabTask*, double*, double*);
}

}  // namespace tyndall
