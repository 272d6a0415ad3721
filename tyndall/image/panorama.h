#pragma once
// Panoramas of the surroundings from .hdr and .exr files.
#include <filesystem>

#include "tyndall/light/light.h"

namespace tyndall {

/// Reads a latitude-longitude picture (.hdr or .exr, told by content): R, G, B, or Y alone as grey. Values that no
/// light can have are mended: what is negative or not a number becomes 0, an infinity the largest half float, 65504.
/// At most 16384 pixels a side, 2^27 in all. Parsed in a child process first. Throws Fault.
Panorama read_panorama(const std::filesystem::path& file);

}  // namespace tyndall
