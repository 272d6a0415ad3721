#pragma once
// float and double as numbers: the elementary functions that every law may use, found by the same names for every
// number type.
//
// A number type T offers: + - * / and unary minus, comparisons that yield a mask, T(double), and the functions below.
// Laws are straight-line texts over those: no branches on values (select), no loops but iterate() and host loops of
// fixed count.
#include <array>
#include <cmath>
#include <concepts>
#include <numbers>

namespace tyndall {

template <class T>
concept Scalar = std::same_as<T, float> || std::same_as<T, double>;

template <Scalar T>
inline T sqrt(T x) {
  return std::sqrt(x);
}
template <Scalar T>
inline T cbrt(T x) {
  return std::cbrt(x);
}
template <Scalar T>
inline T exp(T x) {
  return std::exp(x);
}
template <Scalar T>
inline T expm1(T x) {
  return std::expm1(x);
}
template <Scalar T>
inline T log(T x) {
  return std::log(x);
}
template <Scalar T>
inline T sin(T x) {
  return std::sin(x);
}
template <Scalar T>
inline T cos(T x) {
  return std::cos(x);
}
template <Scalar T>
inline T sinh(T x) {
  return std::sinh(x);
}
template <Scalar T>
inline T asinh(T x) {
  return std::asinh(x);
}
template <Scalar T>
inline T abs(T x) {
  return std::fabs(x);
}
template <Scalar T>
inline T min(T a, T b) {
  return b < a ? b : a;
}
template <Scalar T>
inline T max(T a, T b) {
  return a < b ? b : a;
}
/// a * b + c, rounded once (the only place where products and sums may fuse: the build uses -ffp-contract=off).
template <Scalar T>
inline T fma(T a, T b, T c) {
  return std::fma(a, b, c);
}
template <Scalar T>
inline T select(bool mask, T yes, T no) {
  return mask ? yes : no;
}

/// x with the sign of s (s = 0 counts as positive).
template <class T>
inline T with_sign_of(const T& x, const T& s) {
  return select(s < T(0.0), -abs(x), abs(x));
}

/// ln x and e^x to 1e-5 at least, for what only starts a search: Lanes have quicker ones.
template <class T>
inline T rough_log(const T& x) {
  return log(x);
}
template <class T>
inline T rough_exp(const T& x) {
  return exp(x);
}

/// Gives a sub-expression a name for generated code (Symbol); every other number passes through.
template <class T>
inline const T& named(const char*, const T& value) {
  return value;
}

/// What a number's values are when they are one value: float and double themselves; Lanes say float, Dual its value
/// type.
template <class T>
struct NumberTraits {
  using Value = T;
};

/// True for numbers whose precision is double: laws may then iterate further.
template <class T>
constexpr bool is_double = std::same_as<typename NumberTraits<T>::Value, double>;

/// Repeats `body` (array -> array) `count` times from `state`: the only loop a law may use. Symbol prints it as a loop.
/// Every element of the state is one number.
template <class T, std::size_t N, class Body>
inline std::array<T, N> iterate(int count, std::array<T, N> state, Body body) {
  for (int i = 0; i < count; ++i) state = body(state);
  return state;
}

template <class T>
T pi() {
  return named("pi", T(std::numbers::pi));
}
/// 1 / (4 pi), the isotropic density [1/sr].
template <class T>
T inverse_four_pi() {
  return named("inverse_four_pi", T(1.0 / (4.0 * std::numbers::pi)));
}

}  // namespace tyndall
