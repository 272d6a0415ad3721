// Every operation of a number in Lanes, for number_test.cc.
#include <cstddef>

#include "tyndall/number/every_operation_test.h"
#include "tyndall/number/lanes.h"

namespace tyndall {

/// count is a multiple of the lane count; out holds all results of the first operation, then of the second, ...
extern "C" void TYNDALL_KERNEL_ENTRY(const float* a, const float* b, float* out, std::size_t count) {
  for (std::size_t i = 0; i < count; i += Lanes::size) {
    const auto results = every_operation(Lanes::load_unaligned(a + i), Lanes::load_unaligned(b + i));
    for (std::size_t k = 0; k < results.size(); ++k) results[k].store_unaligned(out + k * count + i);
  }
}

}  // namespace tyndall
