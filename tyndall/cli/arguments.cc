#include "tyndall/cli/arguments.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <utility>

#include "tyndall/document/spelling.h"
#include "tyndall/number/described.h"

namespace tyndall {

void add_seed(CLI::App& command, std::uint64_t& seed) {
  // Without the check, "-1" would be taken as 2^64 - 1.
  command.add_option("--seed", seed, "Another number gives other random samples (default 1)")
      ->check(whole_within(0, std::numeric_limits<std::uint64_t>::max()));
}

void add_threads(CLI::App& command, int& threads) {
  command.add_option("--threads", threads, "Processor threads (default: all); the result does not depend on it")
      ->check(whole_within(1, 1024));
}

void add_allow_path(CLI::App& command, bool& allow_path) {
  command.add_flag("--allow-path", allow_path,
                   "Follow references to files outside the folder of the file that names them");
}

Check number_within(double low, double high) {
  return [low, high](const std::string& text) -> std::string {
    double value = 0.0;
    if (CLI::detail::lexical_cast(text, value) && value >= low && value <= high) return "";
    return "found " + in_quotes(text) + ", expected a number from " + short_number(low) + " to " + short_number(high);
  };
}

Check whole_within(std::uint64_t low, std::uint64_t high) {
  return [low, high](const std::string& text) -> std::string {
    std::uint64_t value = 0;
    const char* const end = text.data() + text.size();
    const auto read = std::from_chars(text.data(), end, value);
    if (read.ec == std::errc{} && read.ptr == end && value >= low && value <= high) return "";
    return "found " + in_quotes(text) + ", expected a whole number from " + std::to_string(low) + " to " +
           std::to_string(high);
  };
}

Check word_of(std::vector<std::string_view> words) {
  return [words = std::move(words)](const std::string& text) -> std::string {
    if (std::ranges::find(words, text) != words.end()) return "";
    return "found " + in_quotes(text) + ", expected " + one_of(text, words);
  };
}

}  // namespace tyndall
