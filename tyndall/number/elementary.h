#pragma once
// Elementary functions from exp, log, sqrt and arithmetic, for shader languages that lack them or have them with few
// digits: export prints these very texts as helper functions.
#include "tyndall/number/scalar.h"

namespace tyndall {

/// e^x - 1, relative error 3e-7 in float for x < 88: Taylor's series below 1/2, where exp(x) - 1 would cancel.
template <class T>
T expm1_from_exp(const T& x) {
  T series = T(1.0 / 362880.0);
  for (const double factorial : {40320.0, 5040.0, 720.0, 120.0, 24.0, 6.0, 2.0})
    series = fma(series, x, T(1.0 / factorial));
  return select(abs(x) < T(0.5), fma(series * x, x, x), exp(x) - T(1.0));
}

/// sinh x, relative error 3e-7 in float for |x| < 88: Taylor's series below 1.
template <class T>
T sinh_from_exp(const T& x) {
  const T x2 = named("x2", x * x);
  T series = T(1.0 / 39916800.0);
  for (const double factorial : {362880.0, 5040.0, 120.0, 6.0}) series = fma(series, x2, T(1.0 / factorial));
  const T growth = named("growth", exp(abs(x)));
  return select(abs(x) < T(1.0), fma(series * x2, x, x), with_sign_of(T(0.5) * growth - T(0.5) / growth, x));
}

/// asinh x, relative error 3e-7 in float for |x| < 1e18. Below 1/2: asinh x = 2 asinh y = 2 artanh z with the halved
/// argument y = x / sqrt(2 + 2 sqrt(1 + x^2)) and z = y / sqrt(1 + y^2), |z| < 1/4, artanh by its series.
template <class T>
T asinh_from_log(const T& x) {
  const T hypotenuse = named("hypotenuse", sqrt(fma(x, x, T(1.0))));
  const T y = named("y", x / sqrt(T(2.0) + T(2.0) * hypotenuse));
  const T z = named("z", y / sqrt(fma(y, y, T(1.0))));
  const T z2 = named("z2", z * z);
  T series = T(1.0 / 11.0);
  for (const double odd : {9.0, 7.0, 5.0, 3.0}) series = fma(series, z2, T(1.0 / odd));
  return select(abs(x) < T(0.5), T(2.0) * fma(series * z2, z, z), with_sign_of(log(abs(x) + hypotenuse), x));
}

/// The real cube root, relative error 3e-7 in float: a logarithm's estimate and two Newton steps. 0 gives 0; |x| is 0
/// or at least 1e-36.
template <class T>
T cbrt_from_exp(const T& x) {
  const T size = named("size", max(abs(x), T(1e-36)));
  T root = named("estimate", exp(log(size) / T(3.0)));
  root = named("closer", (T(2.0) * root + size / (root * root)) / T(3.0));
  root = (T(2.0) * root + size / (root * root)) / T(3.0);
  return select(abs(x) > T(0.0), with_sign_of(root, x), T(0.0));
}

}  // namespace tyndall
