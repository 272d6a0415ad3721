#include "tyndall/cli/number_list.h"

#include <charconv>
#include <limits>
#include <string_view>

#include "tyndall/document/fault.h"
#include "tyndall/document/spelling.h"
#include "tyndall/number/described.h"

namespace tyndall {

std::vector<double> numbers_from(const std::string& text, const std::string& option, double low, double high) {
  const double most = std::numeric_limits<double>::max();
  const std::string possible = low == -most && high == most ? "numbers with commas between"
                                                            : "numbers from " + short_number(low) + " to " +
                                                                  short_number(high) + ", with commas between";
  std::vector<double> numbers;
  std::string_view rest = text;
  while (!rest.empty()) {
    std::string_view word = rest.substr(0, rest.find(','));
    const bool more = word.size() < rest.size();
    rest.remove_prefix(word.size() + (more ? 1 : 0));
    if (word.size() > 1 && word[0] == '+') word.remove_prefix(1);
    double x = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), x);
    const bool whole = error == std::errc() && end == word.data() + word.size();
    // Written so that NaN is refused as well.
    if (!whole || !(x >= low && x <= high) || (more && rest.empty())) throw Fault(option, in_quotes(text), possible);
    numbers.push_back(x);
  }
  return numbers;
}

std::vector<double> three_numbers_from(const std::string& text, const std::string& option) {
  const double most = std::numeric_limits<double>::max();
  auto numbers = numbers_from(text, option, -most, most);
  if (numbers.size() != 3) throw Fault(option, in_quotes(text), "three numbers with commas between");
  return numbers;
}

}  // namespace tyndall
