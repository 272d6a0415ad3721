// The tools of cmake/kernels.cmake at work on the smallest kernel that has the trap in it.
#include <gtest/gtest.h>

#include <array>
#include <numeric>

#include "tests/kernel_isolation/isolation_kernel.h"
#include "tests/kernel_isolation/plain.h"

namespace {

using Kernel = int (*)(const float*, float*, int);
using Values = std::array<float, 67>;  // no multiple of any register

Values ramp() {
  Values x;
  std::iota(x.begin(), x.end(), -20.0f);
  return x;
}

void expect_doubled(const Values& y) {
  const Values x = ramp();
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_EQ(y[i], 2.0f * x[i] + 1.0f);
}

void expect_kernel(Kernel kernel, int lanes) {
  const Values x = ramp();
  Values y{};
  EXPECT_EQ(kernel(x.data(), y.data(), static_cast<int>(x.size())), lanes);
  expect_doubled(y);
}

}  // namespace

TEST(KernelIsolation, EveryKernelThisMachineCanRunHasItsOwnWidthAndTheSameAnswer) {
  expect_kernel(isolation_kernel_baseline, 4);
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) expect_kernel(isolation_kernel_avx2, 8);
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vl"))
    expect_kernel(isolation_kernel_avx512, 16);
}

// Without isolation the linker keeps the AVX-512 copy of the inline function, which it meets first, for this call too:
// under an emulated machine without AVX this test then dies.
TEST(KernelIsolation, ThePlainProgramKeepsItsOwnCopyOfASharedInlineFunction) {
  const Values x = ramp();
  Values y{};
  kernel_isolation::plain(x.data(), y.data(), static_cast<int>(x.size()));
  expect_doubled(y);
}
