#pragma once
// Two registers of Lanes that advance together, as a number.
#include <cstddef>

#include "tyndall/number/lanes.h"

namespace tyndall {

struct LanePairMask {
  LaneMask a, b;
};

/// Laws are long chains of operations that wait for each other; a processor sees only a few hundred instructions ahead,
/// one or two registers' worth. Doing each operation for two registers in turn fills the waiting: up to twice the speed
/// of Lanes, bit for bit the same results.
struct LanePair {
  static constexpr std::size_t size = 2 * Lanes::size;
  Lanes a, b;

  LanePair() = default;
  LanePair(double x) : a(static_cast<float>(x)), b(static_cast<float>(x)) {}  // NOLINT: as every number
  explicit LanePair(const Lanes& both) : a(both), b(both) {}
  LanePair(const Lanes& x, const Lanes& y) : a(x), b(y) {}

  LanePair operator-() const { return {-a, -b}; }
  LanePair& operator+=(const LanePair& y) { return *this = *this + y; }
  LanePair& operator-=(const LanePair& y) { return *this = *this - y; }
  LanePair& operator*=(const LanePair& y) { return *this = *this * y; }
  friend LanePair operator+(const LanePair& x, const LanePair& y) { return {x.a + y.a, x.b + y.b}; }
  friend LanePair operator-(const LanePair& x, const LanePair& y) { return {x.a - y.a, x.b - y.b}; }
  friend LanePair operator*(const LanePair& x, const LanePair& y) { return {x.a * y.a, x.b * y.b}; }
  friend LanePair operator/(const LanePair& x, const LanePair& y) { return {x.a / y.a, x.b / y.b}; }
  friend LanePairMask operator<(const LanePair& x, const LanePair& y) { return {x.a < y.a, x.b < y.b}; }
  friend LanePairMask operator>(const LanePair& x, const LanePair& y) { return {x.a > y.a, x.b > y.b}; }
  friend LanePairMask operator<=(const LanePair& x, const LanePair& y) { return {x.a <= y.a, x.b <= y.b}; }
  friend LanePairMask operator>=(const LanePair& x, const LanePair& y) { return {x.a >= y.a, x.b >= y.b}; }

  friend LanePair sqrt(const LanePair& x) { return {sqrt(x.a), sqrt(x.b)}; }
  friend LanePair cbrt(const LanePair& x) { return {cbrt(x.a), cbrt(x.b)}; }
  friend LanePair exp(const LanePair& x) { return {exp(x.a), exp(x.b)}; }
  friend LanePair expm1(const LanePair& x) { return {expm1(x.a), expm1(x.b)}; }
  friend LanePair log(const LanePair& x) { return {log(x.a), log(x.b)}; }
  friend LanePair rough_log(const LanePair& x) { return {rough_log(x.a), rough_log(x.b)}; }
  friend LanePair rough_exp(const LanePair& x) { return {rough_exp(x.a), rough_exp(x.b)}; }
  friend LanePair sin(const LanePair& x) { return {sin(x.a), sin(x.b)}; }
  friend LanePair cos(const LanePair& x) { return {cos(x.a), cos(x.b)}; }
  friend LanePair sinh(const LanePair& x) { return {sinh(x.a), sinh(x.b)}; }
  friend LanePair asinh(const LanePair& x) { return {asinh(x.a), asinh(x.b)}; }
  friend LanePair abs(const LanePair& x) { return {abs(x.a), abs(x.b)}; }
  friend LanePair min(const LanePair& x, const LanePair& y) { return {min(x.a, y.a), min(x.b, y.b)}; }
  friend LanePair max(const LanePair& x, const LanePair& y) { return {max(x.a, y.a), max(x.b, y.b)}; }
  friend LanePair fma(const LanePair& x, const LanePair& y, const LanePair& z) {
    return {fma(x.a, y.a, z.a), fma(x.b, y.b, z.b)};
  }
  friend LanePair select(const LanePairMask& mask, const LanePair& yes, const LanePair& no) {
    return {select(mask.a, yes.a, no.a), select(mask.b, yes.b, no.b)};
  }
  friend LanePair lookup(const SharedArray& array, const LanePair& index) {
    return {tyndall::lookup(array, index.a), tyndall::lookup(array, index.b)};
  }
};

template <>
struct NumberTraits<LanePair> {
  using Value = float;
};

}  // namespace tyndall
