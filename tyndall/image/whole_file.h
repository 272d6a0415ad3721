#pragma once
// Whole files in and out of memory: sizes are known before anything is allocated, and nobody ever sees half a file.
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace tyndall {

/// The largest picture, texture, buffer or glTF file that is read [bytes].
inline constexpr std::uint64_t largest_file = std::uint64_t{1} << 31;

/// All bytes of a regular file of at most `limit` bytes. Throws Fault for anything else (absent, a folder, a pipe,
/// unreadable, too large, changed while being read).
std::vector<std::uint8_t> read_whole_file(const std::filesystem::path& file, std::uint64_t limit = largest_file);

/// Writes a file under a temporary name beside it and renames it into place: after a crash, a full disk or a Fault the
/// old file is untouched and no other remains (killed while writing, it leaves .name.NUMBER.part). Throws Fault.
void write_whole_file(const std::filesystem::path& file, std::span<const std::uint8_t> bytes);

}  // namespace tyndall
