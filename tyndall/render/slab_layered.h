#pragma once
// Slabs whose density varies with height: path by path, in double.
#include <cstdint>
#include <vector>

#include "tyndall/medium/lowered_medium.h"
#include "tyndall/render/slab.h"

namespace tyndall {

/// Traces `count` paths from number `first` and adds their tallies and squares, laid out as slab_kernel.h says for
/// three channels.
void trace_layered_slab(const SlabRequest& request, const LoweredMedium& medium, std::uint32_t first,
                        std::uint32_t count, std::vector<double>& sum, std::vector<double>& squares);

}  // namespace tyndall
