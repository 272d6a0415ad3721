// What Lanes do by instructions of their own, in pairs of registers, for number_test.cc.
#include <array>
#include <cstddef>
#include <vector>

#include "tyndall/number/every_operation_test.h"
#include "tyndall/number/lane_table.h"

namespace tyndall {
namespace TYNDALL_KERNEL_NAMESPACE {

LanePair load(const float* from) { return {Lanes::load_unaligned(from), Lanes::load_unaligned(from + Lanes::size)}; }

/// Functions of any x and of y >= 0, the rounding of x y, a table of 32 rows at x; then every operation of |x| and y
/// + 1.
std::vector<LanePair> results(const LanePair& x, const LanePair& y, const SmallTable<LanePair, 2>& table) {
  std::vector<LanePair> out{
      exp(x), expm1(x), log(y), rough_exp(x), rough_log(y), fma(x, y, -(x * y)), table.at(1, table.row_of(x))};
  for (const LanePair& each : every_operation(abs(x), y + LanePair(1.0))) out.push_back(each);
  return out;
}

}  // namespace TYNDALL_KERNEL_NAMESPACE

/// As lanes_check_kernel.cc; count is a multiple of two registers.
extern "C" void TYNDALL_KERNEL_ENTRY(const float* a, const float* b, float* out, std::size_t count) {
  using namespace TYNDALL_KERNEL_NAMESPACE;
  std::vector<double> rows(small_rows), squares(small_rows);
  for (std::size_t i = 0; i < small_rows; ++i) {
    rows[i] = static_cast<double>(i) - 12.0;
    squares[i] = rows[i] * rows[i];
  }
  const std::array columns{constant_array("rows", rows), constant_array("squares", squares)};
  const SmallTable<LanePair, 2> table(columns);
  for (std::size_t i = 0; i < count; i += LanePair::size) {
    const auto found = results(load(a + i), load(b + i), table);
    for (std::size_t k = 0; k < found.size(); ++k) {
      found[k].a.store_unaligned(out + k * count + i);
      found[k].b.store_unaligned(out + k * count + i + Lanes::size);
    }
  }
}

}  // namespace tyndall
