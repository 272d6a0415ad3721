#include "tyndall/document/number_rows.h"

#include <charconv>
#include <cmath>
#include <optional>
#include <vector>

#include "tyndall/document/spelling.h"
#include "tyndall/document/whole_file.h"

namespace tyndall {
namespace {

constexpr std::string_view blanks = " \t";

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(blanks);
  return begin == text.npos ? std::string_view() : text.substr(begin, text.find_last_not_of(blanks) + 1 - begin);
}

/// The texts between separators; one more than most_number_columns at the most.
std::vector<std::string_view> fields_of(std::string_view line, char separator) {
  std::vector<std::string_view> fields;
  while (fields.size() <= most_number_columns) {
    const std::size_t end = separator == ' ' ? line.find_first_of(blanks) : line.find(separator);
    fields.push_back(trimmed(line.substr(0, end)));
    if (end == line.npos) break;
    line.remove_prefix(end + 1);
    if (separator == ' ') line = trimmed(line);
  }
  return fields;
}

enum class Reading { number, no_number, out_of_range };

Reading read(std::string_view field, double& x) {
  if (field.substr(0, 1) == "+" && field.substr(0, 2) != "+-") field.remove_prefix(1);
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), x);
  if (end != field.data() + field.size() || error == std::errc::invalid_argument) return Reading::no_number;
  return error == std::errc() && std::isfinite(x) ? Reading::number : Reading::out_of_range;
}

class RowReader {
 public:
  RowReader(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  NumberRows rows() {
    if (text_.substr(0, 3) == "\xef\xbb\xbf") text_.remove_prefix(3);  // a byte order mark
    bool may_be_heading = true;
    while (!text_.empty()) {
      const std::size_t end = text_.find('\n');
      std::string_view line = text_.substr(0, end);
      text_.remove_prefix(end == text_.npos ? text_.size() : end + 1);
      ++line_;
      if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
      line = trimmed(line);
      if (line.empty() || line.front() == '#') continue;
      if (!may_be_heading || !is_heading(line)) add(line);
      may_be_heading = false;
    }
    if (out_.rows() == 0) throw Fault(place(name_), "no rows of numbers", "rows such as 0, 12.5");
    return std::move(out_);
  }

 private:
  static char separator_of(std::string_view line) {
    return line.find(';') != line.npos ? ';' : line.find(',') != line.npos ? ',' : ' ';
  }
  static bool is_heading(std::string_view line) {
    double x = 0.0;
    for (const std::string_view field : fields_of(line, separator_of(line)))
      if (read(field, x) != Reading::no_number) return false;
    return true;
  }

  void add(std::string_view line) {
    if (out_.rows() == most_number_rows) {
      throw fault("more than " + std::to_string(most_number_rows) + " rows", "fewer");
    }
    if (!separator_) separator_ = separator_of(line);  // of a single number, blanks: there is nothing to separate
    const bool single = line.find_first_of(" \t,;") == line.npos;
    if (!single && separator_of(line) != *separator_)
      throw fault("numbers separated otherwise than before", "one way throughout");
    const auto fields = fields_of(line, *separator_);
    if (fields.size() > most_number_columns) {
      throw fault("more than " + std::to_string(most_number_columns) + " columns", "fewer");
    }
    if (out_.columns == 0) out_.columns = fields.size();
    for (std::size_t i = 0; i < fields.size(); ++i) {
      double x = 0.0;
      const Reading reading = read(fields[i], x);
      const std::string column = " in column " + std::to_string(i + 1);
      if (reading == Reading::no_number) throw fault("no number" + column, "a number with a decimal point");
      if (reading == Reading::out_of_range) {
        throw fault("a number that is not finite, or too small or large," + column, "a finite number");
      }
      out_.values.push_back(x);
    }
    if (fields.size() != out_.columns) {
      throw fault(std::to_string(fields.size()) + " columns", std::to_string(out_.columns) + ", as in the first row");
    }
    out_.line.push_back(line_);
  }

  Fault fault(std::string found, std::string expected) const {
    return {place(name_, line_), std::move(found), std::move(expected)};
  }

  std::string_view text_;
  const std::string& name_;
  NumberRows out_;
  std::uint32_t line_ = 0;
  std::optional<char> separator_;
};

}  // namespace

NumberRows parse_number_rows(std::string_view text, const std::string& name) { return RowReader(text, name).rows(); }

NumberRows read_number_rows(const std::filesystem::path& file) {
  const std::vector<std::uint8_t> bytes = read_whole_file(file, largest_number_file);
  return parse_number_rows({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, file.string());
}

}  // namespace tyndall
