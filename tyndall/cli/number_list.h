#pragma once
// Lists of numbers as options take them: 1,0.5,-1.
#include <string>
#include <vector>

namespace tyndall {

/// The numbers of a comma-separated list, each within [low, high]; "" is an empty list. Throws Fault, naming `option`.
std::vector<double> numbers_from(const std::string& text, const std::string& option, double low, double high);

/// Exactly three finite numbers: x,y,z or r,g,b. Throws Fault, naming `option`.
std::vector<double> three_numbers_from(const std::string& text, const std::string& option);

}  // namespace tyndall
