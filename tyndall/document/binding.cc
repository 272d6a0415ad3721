#include "tyndall/document/binding.h"

#include "tyndall/document/grid_reader.h"
#include "tyndall/document/grid_sequence.h"
#include "tyndall/document/number_rows.h"
#include "tyndall/document/reference.h"

namespace tyndall {
namespace {

std::string described(const Range& range) {
  const bool low = std::isfinite(range.low), high = std::isfinite(range.high);
  if (low && high && !range.open_low && !range.open_high) {
    return " from " + short_number(range.low) + " to " + short_number(range.high);
  }
  std::string text;
  if (low) text += (range.open_low ? " above " : " of at least ") + short_number(range.low);
  if (low && high) text += " and";
  if (high) text += (range.open_high ? " below " : " at most ") + short_number(range.high);
  return text;
}

}  // namespace

std::string described(const FieldFacts& facts) {
  const std::string unit = facts.unit.empty() || facts.unit == "1" ? "" : " [" + std::string(facts.unit) + "]";
  return "a number" + described(facts.range) + unit;
}

double read_number(const JsonCursor& at, const FieldFacts& facts) {
  if (!at.value().is_number()) throw at.wrong_type(expected_value<double>(facts));
  const double x = at.value().get<double>();
  if (!std::isfinite(x) || !facts.range.contains(x)) throw at.wrong_type(expected_value<double>(facts));
  return x;
}

int read_integer(const JsonCursor& at, const FieldFacts& facts) {
  const double x = read_number(at, facts);
  if (x != std::trunc(x) || x < std::numeric_limits<int>::min() || x > std::numeric_limits<int>::max()) {
    throw at.wrong_type("a whole number, " + expected_value<int>(facts));
  }
  return static_cast<int>(x);
}

namespace {

/// The file whose name stands here, or is this.
std::filesystem::path file_named(const JsonCursor& at, const std::string& instead, const std::string& given = "") {
  const auto& name = given.empty() ? at.value().get_ref<const std::string&>() : given;
  if (!at.references()) {
    throw at.fault("the file name " + in_quotes(name, 100) + ", in a text that stands in no folder", instead);
  }
  const ReferenceRule& rule = *at.references();
  try {
    return referenced_file(rule.naming, name, rule.allow_path, "");
  } catch (const Fault& nameless) {
    throw at.fault(nameless.found, nameless.expected);  // finding a place is work, of which a text may ask a lot
  }
}

const std::string grid_holder = "a medium or scene in a file";

}  // namespace

NumberFile read_number_file(const JsonCursor& at, const FieldFacts& facts) {
  if (!at.value().is_string()) throw at.wrong_type(expected_value<NumberFile>(facts));
  const std::filesystem::path path = file_named(at, "the numbers themselves");
  NamedNumbers& named = *at.references()->numbers;
  auto& rows = named.files[path.string()];
  if (!rows) rows = std::make_shared<const NumberRows>(read_number_rows(path));
  named.count += rows->values.size();
  if (named.count > most_named_numbers) {
    throw at.fault("one file of numbers too many",
                   "at most " + std::to_string(most_named_numbers) + " numbers from files, counted each time");
  }
  return {at.value().get<std::string>(), path.string(), rows};
}

GridFile read_grid_file(const JsonCursor& at, const FieldFacts& facts) {
  if (!at.value().is_string()) throw at.wrong_type(expected_value<GridFile>(facts));
  GridFile file;
  file.name = at.value().get<std::string>();
  if (!is_sequence(file.name)) file.path = file_named(at, grid_holder).string();
  return file;
}

void load_grid(const JsonCursor& at, GridFile& file, const std::string& grid_name, int number) {
  if (is_sequence(file.name)) {
    file.path = file_named(at.at("file"), grid_holder, numbered_file(file.name, number)).string();
    file.naming = at.at("file").references()->naming.string();
    file.anywhere = at.at("file").references()->allow_path;
    file.number = number;
  }
  NamedNumbers& named = *at.at("file").references()->numbers;
  GridFile& known = named.grids[file.path + '\0' + grid_name];
  if (!known.grid) {
    known = read_grid(file.path, grid_name);
    named.grid_bytes += bytes_of(*known.grid);
    if (named.grid_bytes > most_grid_bytes) {
      throw at.at("file").fault("one grid too many",
                                "grids of at most " + std::to_string(most_grid_bytes >> 20) + " MB in one file");
    }
  }
  file.grid = known.grid;
  file.content = known.content;
  if (is_sequence(file.name)) {
    file.path = (std::filesystem::path(file.path).parent_path() / std::filesystem::path(file.name).filename()).string();
  }
}

std::size_t read_word(const JsonCursor& at, const std::vector<std::string_view>& words) {
  if (!at.value().is_string()) throw at.wrong_type(one_of("", words));
  const auto& word = at.value().get_ref<const std::string&>();
  const auto found = std::find(words.begin(), words.end(), word);
  if (found == words.end()) throw at.wrong_type(one_of(word, words));
  return static_cast<std::size_t>(found - words.begin());
}

void check_keys(const JsonCursor& at, std::vector<std::string_view> keys, std::string_view tag,
                std::string_view resolved) {
  if (!at.value().is_object()) throw at.wrong_type("an object with " + one_of("", keys));
  for (const auto& member : at.value().items()) {
    if (member.key() == tag || std::find(keys.begin(), keys.end(), member.key()) != keys.end()) continue;
    if (!resolved.empty()) keys.push_back(resolved);
    const std::string possible =
        keys.empty() ? "no key besides \"" + std::string(tag) + '"' : one_of(member.key(), keys);
    throw at.at(member.key()).fault("the unknown key " + in_quotes(member.key()), possible);
  }
}

void check_not_both(const JsonCursor& at, const Demand& demand) {
  if (demand.kind != Demand::Kind::not_both) return;
  const std::string first(demand.names[0]), second(demand.names[1]);
  if (!at.value().contains(first) || !at.value().contains(second)) return;
  throw at.at(second).fault(second + " beside " + first, "one or the other");
}

}  // namespace tyndall
