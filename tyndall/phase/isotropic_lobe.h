#pragma once
// The lobe of isotropic scattering.
#include <tuple>

#include "tyndall/phase/deflection.h"

namespace tyndall {

/// p = 1/(4 pi) [1/sr]; F(mu) = (1 + mu)/2; chi_l = 0 for l > 0.
template <class T>
struct IsotropicLobe {
  static constexpr auto members() { return std::tuple<>{}; }
  T density(const Deflection<T>&) const { return inverse_four_pi<T>(); }
  T cdf(const Deflection<T>& d) const { return T(0.5) * d.one_plus; }
  T survival(const Deflection<T>& d) const { return T(0.5) * d.one_minus; }
  Deflection<T> sample(const T& xi) const { return Deflection<T>::from_halves(xi, T(1.0) - xi); }
  T moment(int l) const { return T(l == 0 ? 1.0 : 0.0); }
};

}  // namespace tyndall
