#pragma once
// Text files in and out of memory.
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace tyndall {

/// All bytes of a file that the user named (a pipe will do), at most `limit` of them. Throws Fault when it is absent, a
/// folder, unreadable or longer.
std::string read_text_file(const std::filesystem::path& file, std::size_t limit);

/// Writes under a temporary name in the same folder, then renames: nobody ever sees half a file, and a failure leaves
/// the old one. Throws Fault.
void write_text_file(const std::filesystem::path& file, std::string_view text);

}  // namespace tyndall
