#pragma once
// PNG pictures for looking at: 8 bits of sRGB.
#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>

#include "tyndall/image/image.h"
#include "tyndall/image/tone.h"

namespace tyndall {

/// Writes R, G, B of one layer ("" is the beauty), developed, atomically. Throws Fault when the layer is not there or
/// the file cannot be written.
void write_png(const std::filesystem::path& file, const Image& image, const Development& how = {},
               std::string_view layer = "");

/// Writes pixels that are sRGB codes already: three bytes each, row-major, top row first.
void write_png(const std::filesystem::path& file, int width, int height, std::span<const std::uint8_t> rgb);

}  // namespace tyndall
