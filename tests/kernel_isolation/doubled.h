#pragma once
// An inline function that every kernel object and the plain program share, kept out of line: the trap of
// cmake/kernels.cmake. Nothing here may depend on the instruction set.

namespace kernel_isolation {

/// 2 x + 1 for each of n values, in a loop that any compiler vectorises with what it is given.
__attribute__((noinline)) inline void double_and_add_one(const float* x, float* y, int n) {
  for (int i = 0; i < n; ++i) y[i] = 2.0f * x[i] + 1.0f;
}

}  // namespace kernel_isolation
