#pragma once
// One text that uses everything a number must do, for comparing numbers with each other.
#include <vector>

#include "tyndall/number/constant_array.h"
#include "tyndall/number/scalar.h"

namespace tyndall {

/// Smooth in a and b where they differ and are positive.
template <class T>
std::vector<T> every_operation(const T& a, const T& b) {
  std::vector<T> out{a + b,
                     a - b,
                     a * b,
                     a / b,
                     -a,
                     sqrt(a),
                     cbrt(a),
                     exp(a),
                     expm1(a),
                     log(b),
                     sin(a),
                     cos(b),
                     sinh(a),
                     asinh(b),
                     abs(a - b),
                     abs(b - a),
                     min(a, b),
                     max(a, b),
                     min(b, a),
                     max(b, a),
                     fma(a, b, a),
                     select(a < b, a * a, b),
                     select(a > b, a * a, b),
                     select(a <= b, a, b * b),
                     select(a >= b, a, b * b),
                     with_sign_of(a, -b),
                     with_sign_of(a, b),
                     pi<T>() * a,
                     inverse_four_pi<T>() + b,
                     named("product", a * b) + T(1.0)};
  const SharedArray knots = constant_array("knots", {-1.0, 0.0, 0.25, 0.75, 1.0, 1.5, 2.0, 4.0, 64.0, 1e9});
  const T place = last_not_above(knots, T(1.0), 8, a);  // among the nine from the second on
  out.push_back(place + a);
  out.push_back(b * lookup(knots, place + T(1.0)) + a);
  T sum = a;
  sum += b;
  sum *= a;
  sum -= -b;
  out.push_back(sum);
  const auto newton = [&](const std::array<T, 2>& state) -> std::array<T, 2> {
    return {T(0.5) * (state[0] + a / state[0]), state[1] + b * state[0]};
  };
  for (const T& x : iterate(5, std::array<T, 2>{b, a}, newton)) out.push_back(x);
  return out;
}

}  // namespace tyndall
