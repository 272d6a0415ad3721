#pragma once
// A number that carries its derivatives by N parameters (forward differentiation), for fits and inverse design.
#include "tyndall/number/constant_array.h"
#include "tyndall/number/scalar.h"

namespace tyndall {

/// value + sum_i derivative[i] d(parameter i). Comparisons look at the value only; select picks whole duals, so a
/// derivative is that of the branch taken.
template <Scalar T, std::size_t N = 1>
struct Dual {
  T value{};
  std::array<T, N> derivative{};

  Dual() = default;
  Dual(double constant) : value(static_cast<T>(constant)) {}  // NOLINT: constants mix freely with numbers
  Dual(T v, const std::array<T, N>& d) : value(v), derivative(d) {}
  /// The i-th independent parameter at value v.
  static Dual parameter(T v, std::size_t i = 0) {
    Dual x(static_cast<double>(v));
    x.value = v;
    x.derivative[i] = T(1);
    return x;
  }

  /// f(x) given its value and slope at x: the chain rule.
  Dual chain(T v, T slope) const {
    Dual y;
    y.value = v;
    for (std::size_t i = 0; i < N; ++i) y.derivative[i] = slope * derivative[i];
    return y;
  }
  /// f(a, b) given its value and both slopes.
  static Dual chain(const Dual& a, const Dual& b, T v, T slope_a, T slope_b) {
    Dual y;
    y.value = v;
    for (std::size_t i = 0; i < N; ++i) y.derivative[i] = slope_a * a.derivative[i] + slope_b * b.derivative[i];
    return y;
  }

  Dual operator-() const { return chain(-value, T(-1)); }
  friend Dual operator+(const Dual& a, const Dual& b) { return chain(a, b, a.value + b.value, T(1), T(1)); }
  friend Dual operator-(const Dual& a, const Dual& b) { return chain(a, b, a.value - b.value, T(1), T(-1)); }
  friend Dual operator*(const Dual& a, const Dual& b) { return chain(a, b, a.value * b.value, b.value, a.value); }
  friend Dual operator/(const Dual& a, const Dual& b) {
    const T q = a.value / b.value;
    return chain(a, b, q, T(1) / b.value, -q / b.value);
  }
  Dual& operator+=(const Dual& b) { return *this = *this + b; }
  Dual& operator-=(const Dual& b) { return *this = *this - b; }
  Dual& operator*=(const Dual& b) { return *this = *this * b; }
  friend bool operator<(const Dual& a, const Dual& b) { return a.value < b.value; }
  friend bool operator>(const Dual& a, const Dual& b) { return a.value > b.value; }
  friend bool operator<=(const Dual& a, const Dual& b) { return a.value <= b.value; }
  friend bool operator>=(const Dual& a, const Dual& b) { return a.value >= b.value; }

  friend Dual sqrt(const Dual& x) {
    const T r = std::sqrt(x.value);
    return x.chain(r, T(0.5) / r);
  }
  friend Dual cbrt(const Dual& x) {
    const T r = std::cbrt(x.value);
    return x.chain(r, T(1) / (T(3) * r * r));
  }
  friend Dual exp(const Dual& x) {
    const T e = std::exp(x.value);
    return x.chain(e, e);
  }
  friend Dual expm1(const Dual& x) { return x.chain(std::expm1(x.value), std::exp(x.value)); }
  friend Dual log(const Dual& x) { return x.chain(std::log(x.value), T(1) / x.value); }
  friend Dual sin(const Dual& x) { return x.chain(std::sin(x.value), std::cos(x.value)); }
  friend Dual cos(const Dual& x) { return x.chain(std::cos(x.value), -std::sin(x.value)); }
  friend Dual sinh(const Dual& x) { return x.chain(std::sinh(x.value), std::cosh(x.value)); }
  friend Dual asinh(const Dual& x) { return x.chain(std::asinh(x.value), T(1) / std::sqrt(x.value * x.value + T(1))); }
  friend Dual abs(const Dual& x) { return x.value < T(0) ? -x : x; }
  friend Dual min(const Dual& a, const Dual& b) { return b.value < a.value ? b : a; }
  friend Dual max(const Dual& a, const Dual& b) { return a.value < b.value ? b : a; }
  friend Dual fma(const Dual& a, const Dual& b, const Dual& c) {
    Dual y = chain(a, b, std::fma(a.value, b.value, c.value), b.value, a.value);
    for (std::size_t i = 0; i < N; ++i) y.derivative[i] += c.derivative[i];
    return y;
  }
  friend Dual select(bool mask, const Dual& yes, const Dual& no) { return mask ? yes : no; }
  friend Dual lookup(const SharedArray& array, const Dual& index) {
    return Dual(lookup(array, index.value), std::array<T, N>{});
  }
};

template <Scalar T, std::size_t N>
struct NumberTraits<Dual<T, N>> {
  using Value = T;
};

}  // namespace tyndall
