#pragma once
// Grids of voxels from OpenVDB files. The file is parsed in a child process with limits (rehearsal.h), which hands back
// plain voxels: this process never runs the library on foreign bytes.
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "tyndall/geometry/brick_grid.h"
#include "tyndall/number/grid_file.h"

namespace tyndall {

/// Of all grids that one text names, and of one: 512^3 voxels take 257 MB.
inline constexpr std::uint64_t most_grid_bytes = std::uint64_t{2} << 30;
/// From the first to the last voxel along an axis.
inline constexpr int most_grid_voxels_along = 1 << 15;

std::uint64_t bytes_of(const BrickGrid& grid);

/// The grid of this name in a file; "" is the only one there. It must be of numbers (float, stored as such or as half,
/// or double), none negative, no level set, with a background of 0 and a transform that keeps lines straight. Throws
/// Fault for anything else, and where the program is built without OpenVDB. The result names neither the file as it was
/// written nor its path.
GridFile read_grid(const std::filesystem::path& file, const std::string& name);

/// A grid as bytes for the other side of a pipe, and back. Nothing is believed of what comes back: throws Fault {where,
/// ...} where it is not what grid_bytes makes.
std::string grid_bytes(const BrickGrid& grid);
BrickGrid grid_of_bytes(std::string_view bytes, const std::string& where);

}  // namespace tyndall
