#pragma once
// A file of numbers that a description names: rows and columns (CSV). A kind of member beside numbers, texts and lists;
// what reads files (floor 5) fills it in.
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace tyndall {

/// Numbers in rows of equal length, and the lines that they came from, for messages.
struct NumberRows {
  std::size_t columns = 0;
  std::vector<double> values;       // row by row
  std::vector<std::uint32_t> line;  // of each row in its text, from 1

  std::size_t rows() const { return line.size(); }
  double operator()(std::size_t row, std::size_t column) const { return values[row * columns + column]; }
  std::vector<double> column(std::size_t i) const {
    std::vector<double> out;
    for (std::size_t row = 0; row < rows(); ++row) out.push_back((*this)(row, i));
    return out;
  }
};

/// A file by the name that was written, with its numbers as they were when it was read. Copies share the numbers.
struct NumberFile {
  std::string name;
  std::string path;  // where it was found, absolute
  std::shared_ptr<const NumberRows> rows;

  /// The same numbers, wherever they came from.
  bool operator==(const NumberFile& other) const {
    return rows == other.rows ||
           (rows && other.rows && rows->columns == other.rows->columns && rows->values == other.rows->values);
  }
};

}  // namespace tyndall
