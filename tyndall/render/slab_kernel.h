#pragma once
// The SIMD part of `tyndall slab`: plain structs only, because each instruction set's object exports one symbol and
// shares nothing else with the program (ARCHITECTURE.md).
#include <cstddef>
#include <cstdint>

#include "tyndall/phase/lobe_record.h"

namespace tyndall {

/// Most paths that a replicate can have: what they are spread by has so many points.
constexpr std::uint32_t largest_slab_replicate = 1024;

/// A lobe and its part in scattering, of all lobes 1.
struct SlabLobe {
  LobeRecord lobe;
  float share;
};

/// One channel of a homogeneous slab, 0 <= tau <= depth downward, and the paths to trace through it.
struct SlabTask {
  const SlabLobe* lobes;
  int lobe_count;
  float albedo;     // of single scattering
  float depth;      // optical; infinity is a half space
  float mu0;        // cosine of incidence; 0: diffuse illumination
  float ground;     // Lambertian albedo below
  const float* mu;  // exit cosines, mu_count of them
  int mu_count;
  std::uint64_t seed;
  std::uint32_t first_path, path_count;
  std::uint32_t replicate_paths;  // a power of two, at most largest_slab_replicate
};

/// How many tallies a task adds up: reflectance, transmittance, then reflection and transmission at each mu.
constexpr std::size_t slab_tally_count(int mu_count) { return 2 * (1 + static_cast<std::size_t>(mu_count)); }

/// Adds each path's tallies to the sums of its replicate: path i of the task to those of number i / replicate_paths,
/// slab_tally_count each. The first path must begin a replicate. Paths of one replicate are spread evenly over what a
/// path decides first; replicates are independent of each other, so that errors are seen in how they differ.
using SlabKernel = void (*)(const SlabTask*, double* sums);

extern "C" {
void slab_baseline(const SlabTask*, double*);
void slab_avx2(const SlabTask*, double*);
void slab_avx512(const SlabTask*, double*);
}

}  // namespace tyndall
