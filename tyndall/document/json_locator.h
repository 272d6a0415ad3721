#pragma once
// On which line a value of a JSON text stands. nlohmann-json keeps no positions, so that the text is walked again, once
// a message needs it.
#include <cstddef>
#include <string_view>

namespace tyndall {

/// Line (from 1) of the member or element that `pointer` (RFC 6901) names, counting its `occurrence` (from 0) where a
/// key is repeated in the last object. The text need not be valid: 0 where the value cannot be found.
std::size_t line_of_pointer(std::string_view text, std::string_view pointer, std::size_t occurrence = 0);

/// Line (from 1) of a byte of the text.
std::size_t line_of_byte(std::string_view text, std::size_t byte);

}  // namespace tyndall
