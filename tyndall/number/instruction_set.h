#pragma once
// Which of a kernel's objects this machine can run.
#include <string_view>

namespace tyndall {

/// The instruction sets that kernels are compiled for: any x86-64, x86-64-v3, x86-64-v4.
enum class InstructionSet { baseline, avx2, avx512 };

inline std::string_view name_of(InstructionSet set) {
  return set == InstructionSet::avx512 ? "avx512" : set == InstructionSet::avx2 ? "avx2" : "baseline";
}

/// The widest set of this processor; baseline where it is no x86-64 (WebAssembly, ARM).
inline InstructionSet best_instruction_set() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") &&
      __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512cd")) {
    return InstructionSet::avx512;
  }
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return InstructionSet::avx2;
#endif
  return InstructionSet::baseline;
}

/// The entry of a kernel for `set`.
template <class Entry>
Entry choose_kernel(InstructionSet set, Entry baseline, Entry avx2, Entry avx512) {
  return set == InstructionSet::avx512 ? avx512 : set == InstructionSet::avx2 ? avx2 : baseline;
}

}  // namespace tyndall
