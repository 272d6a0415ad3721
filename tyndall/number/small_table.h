#pragma once
// A table of 32 rows, small enough for registers.
#include <array>
#include <cstddef>

#include "tyndall/number/constant_array.h"

namespace tyndall {

/// Rows in a small table: two registers of 16 lanes.
inline constexpr std::size_t small_rows = 32;

/// Reads N columns of small_rows numbers; the first must not fall. Lanes have a specialisation that keeps the columns
/// in registers (lane_table.h). The columns must outlive it.
template <class T, std::size_t N>
class SmallTable {
 public:
  using Row = T;
  explicit SmallTable(const std::array<SharedArray, N>& columns) : columns_(columns) {}
  /// The last row whose first column is at most `key`; 0 where there is none.
  Row row_of(const T& key) const { return last_not_above(columns_[0], T(0.0), small_rows - 1, key); }
  T at(std::size_t column, const Row& row) const { return lookup(columns_[column], row); }

 private:
  const std::array<SharedArray, N>& columns_;
};

}  // namespace tyndall
