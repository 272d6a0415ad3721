#pragma once
// OpenVDB, in this very process. Built with the library, or in its absence as the message that says so.
#include <filesystem>
#include <string>

#include "tyndall/geometry/brick_grid.h"

namespace tyndall {

/// As read_grid (grid_reader.h), which runs this where a crash does no harm.
BrickGrid openvdb_grid(const std::filesystem::path& file, const std::string& name);

}  // namespace tyndall
