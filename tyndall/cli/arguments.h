#pragma once
// Arguments that several commands take, and checks of them.
#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>
#include <string>

namespace tyndall {

void add_seed(CLI::App& command, std::uint64_t& seed);
void add_threads(CLI::App& command, int& threads);
void add_allow_path(CLI::App& command, bool& allow_path);

/// A check that an option is a number within [low, high]; CLI::Range would let "nan" through.
std::function<std::string(const std::string&)> number_within(double low, double high);

}  // namespace tyndall
