#include "tyndall/cli/arguments.h"

#include "tyndall/document/spelling.h"
#include "tyndall/number/described.h"

namespace tyndall {

void add_seed(CLI::App& command, std::uint64_t& seed) {
  // Without the check, "-1" would be taken as 2^64 - 1.
  command.add_option("--seed", seed, "Another number gives other random samples (default 1)")
      ->check([](const std::string& text) {
        return text.starts_with('-') ? "found " + in_quotes(text) + ", expected a whole number of at least 0" : "";
      });
}

void add_threads(CLI::App& command, int& threads) {
  command.add_option("--threads", threads, "Processor threads (default: all); the result does not depend on it")
      ->check(CLI::Range(1, 1024));
}

void add_allow_path(CLI::App& command, bool& allow_path) {
  command.add_flag("--allow-path", allow_path,
                   "Follow references to files outside the folder of the file that names them");
}

std::function<std::string(const std::string&)> number_within(double low, double high) {
  return [low, high](const std::string& text) -> std::string {
    double value = 0.0;
    if (CLI::detail::lexical_cast(text, value) && value >= low && value <= high) return "";
    return "found " + in_quotes(text) + ", expected a number from " + short_number(low) + " to " + short_number(high);
  };
}

}  // namespace tyndall
