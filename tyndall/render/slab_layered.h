#pragma once
// Slabs whose density varies with height: path by path, in double.
#include <cstdint>
#include <vector>

#include "tyndall/medium/lowered_medium.h"
#include "tyndall/render/slab.h"

namespace tyndall {

/// How many tallies a path has: reflectance, transmittance, then reflection and transmission at each mu; each per
/// channel.
constexpr std::size_t layered_tally_count(std::size_t mu_count) { return channel_count * 2 * (1 + mu_count); }

/// Adds the tallies of `count` paths from number `first`, which begins a replicate of `replicate_paths` (a power of
/// two) paths, to the sums of their replicates, layered_tally_count each; as SlabKernel does (slab_kernel.h).
void trace_layered_slab(const SlabRequest& request, const LoweredMedium& medium, std::uint32_t first,
                        std::uint32_t count, std::uint32_t replicate_paths, double* sums);

}  // namespace tyndall
