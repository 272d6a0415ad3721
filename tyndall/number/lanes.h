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
/// functions (sqrt, exp, log, ...) are found by argument-dependent lookup: xsimd's, or ours below.
using Lanes = xsimd::batch<float, LaneArchitecture>;
using LaneMask = Lanes::batch_bool_type;

template <>
struct NumberTraits<Lanes> {
  using Value = float;
};

inline Lanes with_sign_of(const Lanes& x, const Lanes& s) { return xsimd::copysign(x, s); }

/// The numbers at each lane's index. (Intrinsics: xsimd 8.1's gather of floats never chooses the instruction, it puts
/// lanes together one by one.)
inline Lanes lookup(const SharedArray& array, const Lanes& index) {
  const float* from = array->data<float>();
#if defined(__AVX512F__)
  return _mm512_i32gather_ps(_mm512_cvttps_epi32(index), from, sizeof(float));
#elif defined(__AVX2__)
  return _mm256_i32gather_ps(from, _mm256_cvttps_epi32(index), sizeof(float));
#else
  return Lanes::gather(from, xsimd::to_int(index));
#endif
}

}  // namespace tyndall

#if defined(__AVX512F__)
// What xsimd 8.1 lacks for AVX-512: its fma() multiplies and adds with two roundings, and the functions built on it do
// the same in twice the time. They stand in its namespace because argument-dependent lookup looks there alone; being no
// templates they are preferred to xsimd's.
namespace xsimd {

/// x * y + z, rounded once.
inline tyndall::Lanes fma(const tyndall::Lanes& x, const tyndall::Lanes& y, const tyndall::Lanes& z) {
  return _mm512_fmadd_ps(x, y, z);
}

/// e^x = 2^n e^r with |r| <= ln(2)/2: `turns` is n, the result e^r - 1 by its Taylor polynomial of degree 7 (5e-9 of
/// e^r).
inline __m512 expm1_of_rest(const tyndall::Lanes& given, __m512& turns) {
  const auto constant = [](double c) { return _mm512_set1_ps(static_cast<float>(c)); };
  const __m512 x = _mm512_max_ps(constant(-110.0), _mm512_min_ps(constant(88.9), given));  // 0 and infinity beyond
  turns = _mm512_roundscale_ps(_mm512_mul_ps(x, constant(1.4426950408889634)), 0);
  // ln 2 in two parts, the first exact in 15 bits: its product with n is exact.
  __m512 r = _mm512_fnmadd_ps(turns, constant(0.693145751953125), x);
  r = _mm512_fnmadd_ps(turns, constant(1.42860682030941723e-6), r);
  __m512 p = constant(1.0 / 5040.0);
  for (const double factorial : {720.0, 120.0, 24.0, 6.0, 2.0}) p = _mm512_fmadd_ps(p, r, constant(1.0 / factorial));
  return _mm512_fmadd_ps(_mm512_mul_ps(p, r), r, r);
}

/// e^x to 1 unit in the last place; infinite above 88.7.
inline tyndall::Lanes exp(const tyndall::Lanes& x) {
  __m512 n;
  const __m512 rest = expm1_of_rest(x, n);
  return _mm512_scalef_ps(_mm512_add_ps(rest, _mm512_set1_ps(1.0F)), n);
}

/// e^x - 1 to 2 units in the last place, for small x too.
inline tyndall::Lanes expm1(const tyndall::Lanes& x) {
  __m512 n;
  const __m512 rest = expm1_of_rest(x, n), one = _mm512_set1_ps(1.0F);
  return _mm512_add_ps(_mm512_scalef_ps(rest, n), _mm512_sub_ps(_mm512_scalef_ps(one, n), one));
}

/// ln x to 2 units in the last place, near 1 too; 0 gives -infinity, what is below no number.
inline tyndall::Lanes log(const tyndall::Lanes& x) {
  const auto constant = [](double c) { return _mm512_set1_ps(static_cast<float>(c)); };
  const __m512 one = constant(1.0);
  // x = 2^n m with m from 3/4 to 3/2, ln m = 2 artanh s = 2 s (1 + s^2/3 + s^4/5 + ...) with |s| <= 1/5.
  const __m512 m = _mm512_getmant_ps(x, _MM_MANT_NORM_p75_1p5, _MM_MANT_SIGN_nan);
  const __m512 exponent = _mm512_getexp_ps(x);
  const __m512 n = _mm512_mask_add_ps(exponent, _mm512_cmp_ps_mask(m, one, _CMP_LT_OQ), exponent, one);
  const __m512 f = _mm512_sub_ps(m, one), s = _mm512_div_ps(f, _mm512_add_ps(f, constant(2.0)));
  const __m512 s2 = _mm512_mul_ps(s, s);
  __m512 p = constant(2.0 / 11.0);
  for (const double odd : {9.0, 7.0, 5.0, 3.0}) p = _mm512_fmadd_ps(p, s2, constant(2.0 / odd));
  // 2 s = f - s f, so that only the small second part carries the division's rounding.
  const __m512 small =
      _mm512_fmadd_ps(_mm512_mul_ps(p, s2), s, _mm512_mul_ps(_mm512_sub_ps(_mm512_setzero_ps(), s), f));
  const __m512 low = _mm512_fmadd_ps(n, constant(1.42860682030941723e-6), small);
  return _mm512_fmadd_ps(n, constant(0.693145751953125), _mm512_add_ps(f, low));
}

/// ln x to 1e-5 (absolutely), by a polynomial fitted at Chebyshev's points.
inline tyndall::Lanes rough_log(const tyndall::Lanes& x) {
  const auto constant = [](double c) { return _mm512_set1_ps(static_cast<float>(c)); };
  const __m512 m = _mm512_getmant_ps(x, _MM_MANT_NORM_p75_1p5, _MM_MANT_SIGN_nan), one = constant(1.0);
  const __m512 exponent = _mm512_getexp_ps(x), f = _mm512_sub_ps(m, one);
  const __m512 n = _mm512_mask_add_ps(exponent, _mm512_cmp_ps_mask(m, one, _CMP_LT_OQ), exponent, one);
  __m512 p = constant(0.12831185);
  for (const double c : {-0.25547373, 0.34053327, -0.50026996, 0.99985581, 2.8092357e-06})
    p = _mm512_fmadd_ps(p, f, constant(c));
  return _mm512_fmadd_ps(n, constant(0.6931471805599453), p);
}

/// e^x to 4e-6 for |x| < 80, by a polynomial fitted at Chebyshev's points.
inline tyndall::Lanes rough_exp(const tyndall::Lanes& x) {
  const auto constant = [](double c) { return _mm512_set1_ps(static_cast<float>(c)); };
  const __m512 n = _mm512_roundscale_ps(_mm512_mul_ps(x, constant(1.4426950408889634)), 0);
  const __m512 r = _mm512_fnmadd_ps(n, constant(0.6931471805599453), x);
  __m512 p = constant(0.041917568);
  for (const double c : {0.1679218, 0.49998869, 0.99996227, 1.0}) p = _mm512_fmadd_ps(p, r, constant(c));
  return _mm512_scalef_ps(p, n);
}

}  // namespace xsimd
#endif
