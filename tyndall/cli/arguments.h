#pragma once
// Arguments that several commands take, and checks of them.
#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace tyndall {

void add_seed(CLI::App& command, std::uint64_t& seed);
void add_threads(CLI::App& command, int& threads);
void add_allow_path(CLI::App& command, bool& allow_path);

/// Checks of an option's text, in the words of a Fault; the parser's own let "nan" through, and say less.
using Check = std::function<std::string(const std::string&)>;
/// A number within [low, high].
Check number_within(double low, double high);
/// A whole number within [low, high].
Check whole_within(std::uint64_t low, std::uint64_t high);
/// One of these words.
Check word_of(std::vector<std::string_view> words);

}  // namespace tyndall
