#pragma once
// Lanes: a SIMD register of floats as a number (xsimd). Include it in kernel files only: they are compiled once per
// instruction set, and the lane count follows the flags of that compilation (ARCHITECTURE.md, "One program for any
// x86-64").
#include <xsimd/xsimd.hpp>

#include "tyndall/number/constant_array.h"
#include "tyndall/number/scalar.h"

namespace tyndall {

#if defined(__AVX512F__) && defined(__AVX512CD__) && defined(__AVX512DQ__) && defined(__AVX512BW__)
using LaneArchitecture = xsimd::avx512bw;
#elif defined(__AVX2__) && defined(__FMA__)
using LaneArchitecture = xsimd::fma3<xsimd::avx2>;
#else
using LaneArchitecture = xsimd::sse2;
#endif

/// Lanes::size floats that advance together. Write Lanes(x), never Lanes{x}: braces mean a list of lanes. Elementary
/// functions (sqrt, exp, log, ...) come from xsimd by argument-dependent lookup.
using Lanes = xsimd::batch<float, LaneArchitecture>;
using LaneMask = Lanes::batch_bool_type;

template <>
struct NumberTraits<Lanes> {
  using Value = float;
};

inline Lanes with_sign_of(const Lanes& x, const Lanes& s) { return xsimd::copysign(x, s); }

/// The numbers at each lane's index.
inline Lanes lookup(const SharedArray& array, const Lanes& index) {
  return Lanes::gather(array->data<float>(), xsimd::to_int(index));
}

}  // namespace tyndall
