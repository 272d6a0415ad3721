#pragma once
// Whole files in and out of memory: no more is read than was allowed for, and nobody ever sees half a file.
#include <cstdint>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "tyndall/document/fault.h"

namespace tyndall {

/// The largest picture, texture, buffer or glTF file that is read [bytes].
inline constexpr std::uint64_t largest_file = std::uint64_t{1} << 31;

/// All bytes of a regular file of at most `limit` bytes. Throws Fault for anything else (absent, a folder, a pipe,
/// unreadable, too large).
std::vector<std::uint8_t> read_whole_file(const std::filesystem::path& file, std::uint64_t limit = largest_file);

/// The same as text, from a pipe or device too, for what a person names on the command line: `<(make_fog)`. A pipe that
/// nobody writes to is empty; it is not waited for.
std::string read_whole_text(const std::filesystem::path& file, std::uint64_t limit);

/// What went wrong while a sound request was being carried out: a disk that ran full. Programs exit with 1.
class WriteFailure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Writes a file under a temporary name beside it and renames it into place: after a crash, a full disk or a Fault the
/// old file is untouched and no other remains (killed while writing, it leaves .tyndall-NUMBER.part). A symbolic link
/// to a file is followed. Throws Fault where no file can be made or the name is that of something else (a folder, a
/// device), WriteFailure where writing failed later.
void write_whole_file(const std::filesystem::path& file, std::span<const std::uint8_t> bytes);
void write_whole_file(const std::filesystem::path& file, std::string_view text);

/// Throws the Fault that write_whole_file would throw now: for asking before hours of work. Leaves nothing behind.
void check_writable(const std::filesystem::path& file);

}  // namespace tyndall
