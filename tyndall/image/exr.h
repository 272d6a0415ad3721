#pragma once
// OpenEXR pictures: 32-bit float scanlines with layers, and text in the header saying how they were made.
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tyndall/image/image.h"

namespace tyndall {

/// Writes a picture atomically: scanlines from the top, every plane a float channel of its own name, ZIP compression
/// (lossless), every note a string attribute of its key. The same picture gives the same bytes. Infinities (a depth
/// where nothing was met) are kept. Throws Fault when the file cannot be written, and for planes of a wrong size or two
/// of one name.
void write_exr(const std::filesystem::path& file, const Image& image);

/// Reads the channels named in `only` that are there, or all of them if it is empty, in the file's (alphabetic) order,
/// as float whatever their type, and the header's text as notes. Sizes are checked before anything is allocated: at
/// most 16384 pixels a side, 2^31 bytes of planes. Multi-part, deep and subsampled files are refused. Throws Fault.
Image read_exr(const std::filesystem::path& file, std::span<const std::string_view> only = {});

/// The same of a file's bytes, in this very process (no rehearsal); `where` names it in messages.
Image parse_exr(const std::string& where, std::span<const std::uint8_t> bytes,
                std::span<const std::string_view> only = {});

}  // namespace tyndall
