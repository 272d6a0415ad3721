#pragma once

namespace kernel_isolation {

/// double_and_add_one, called by code compiled for any x86-64.
void plain(const float* x, float* y, int n);

}  // namespace kernel_isolation
