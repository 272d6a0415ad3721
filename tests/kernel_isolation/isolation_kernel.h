#pragma once

extern "C" {
/// y[i] = 2 x[i] + 1 for i < n; gives the number of floats in a register.
int isolation_kernel_baseline(const float* x, float* y, int n);
int isolation_kernel_avx2(const float* x, float* y, int n);
int isolation_kernel_avx512(const float* x, float* y, int n);
}
