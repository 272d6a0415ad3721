#pragma once
// Files of numbers in rows and columns: CSV, and tables as programs print them.
#include <filesystem>
#include <string>
#include <string_view>

#include "tyndall/document/fault.h"
#include "tyndall/number/number_file.h"

namespace tyndall {

inline constexpr std::size_t largest_number_file = std::size_t{16} << 20;  // bytes
inline constexpr std::size_t most_number_rows = 100000, most_number_columns = 64;

/// Rows of finite numbers, all of one length. Between numbers stand commas, semicolons or blanks, the same on every
/// line; lines end with LF or CRLF; empty lines and those that start with # count for nothing; the first other line may
/// be a heading. A decimal point is a point, whatever the language of the machine (std::from_chars). Throws Fault with
/// line and column (a column of the table, from 1); it says what is wrong, never what is written there. `name` is what
/// messages call the text.
NumberRows parse_number_rows(std::string_view text, const std::string& name);

/// Reads and parses a regular file of at most largest_number_file bytes.
NumberRows read_number_rows(const std::filesystem::path& file);

}  // namespace tyndall
