#pragma once
// Words in messages: text from outside made safe to print, and the nearest spelling of a word nobody knows.
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace tyndall {

/// Text from outside as it may stand in a message: control characters, direction marks and broken UTF-8 escaped, and
/// no more than `most` characters of it.
std::string printable(std::string_view text, std::size_t most = 400);

/// The same between double quotes, shortened to what identifies it.
std::string in_quotes(std::string_view text, std::size_t most = 40);

/// How many letters must be typed, dropped, replaced or swapped with their neighbour to get from a to b (optimal
/// string alignment, Damerau 1964). Time grows with the product of the lengths.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The candidate closest to `word` if it is close enough to be meant, else empty.
std::string_view nearest_spelling(std::string_view word, const std::vector<std::string_view>& candidates);

/// "one of a, b, c", and `(did you mean "b"?)` where there is a near one. An empty list gives "nothing".
std::string one_of(std::string_view word, const std::vector<std::string_view>& candidates);

}  // namespace tyndall
