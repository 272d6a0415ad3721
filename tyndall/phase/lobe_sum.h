#pragma once
// What every law lowers to: a short weighted sum of lobes.
#include <cstddef>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "tyndall/phase/draine_lobe.h"
#include "tyndall/phase/fournier_forand_lobe.h"
#include "tyndall/phase/henyey_greenstein_lobe.h"
#include "tyndall/phase/isotropic_lobe.h"
#include "tyndall/phase/lambert_sphere_lobe.h"
#include "tyndall/phase/power_lobe.h"
#include "tyndall/phase/rayleigh_lobe.h"
#include "tyndall/phase/schlick_lobe.h"
#include "tyndall/phase/table_lobe.h"

namespace tyndall {

/// The closed set of lobes. Each offers density [1/sr], cdf (from mu = -1), survival (1 - cdf, without cancellation),
/// sample (the exact inverse of cdf), moment(l); and members(), the pointers to its parameters, at most
/// most_lobe_parameters numbers and one table, from which conversion, comparison and the records of kernels follow
/// (lobe_record.h).
template <class T>
using Lobe = std::variant<IsotropicLobe<T>,         //
                          RayleighLobe<T>,          //
                          HenyeyGreensteinLobe<T>,  //
                          PowerLobe<T>,             //
                          SchlickLobe<T>,           //
                          DraineLobe<T>,            //
                          LambertSphereLobe<T>,     //
                          FournierForandLobe<T>,    //
                          TableLobe<T>>;

template <class T>
struct WeightedLobe {
  T weight;
  Lobe<T> lobe;
};

/// p = sum_i weight_i lobe_i; weights are not negative and sum to 1.
template <class T>
using LobeSum = std::vector<WeightedLobe<T>>;

/// Calls visit(to's member, from's member) for each parameter of a lobe in two numbers.
template <class To, class From, class Visit>
void for_each_parameter(To& to, const From& from, Visit visit) {
  constexpr auto count = std::tuple_size_v<decltype(From::members())>;
  [&]<std::size_t... i>(std::index_sequence<i...>) {
    (visit(to.*(std::get<i>(std::remove_const_t<To>::members())), from.*(std::get<i>(From::members()))), ...);
  }
  (std::make_index_sequence<count>{});
}

/// The same lobe with its parameters in another number (double -> float, double -> Lanes: lane-uniform). Parameters
/// that are no numbers T, such as whole exponents, stay as they are.
template <class U, class T>
Lobe<U> lobe_as(const Lobe<T>& lobe) {
  return std::visit(
      []<template <class> class L>(const L<T>& from) -> Lobe<U> {
        L<U> to;
        for_each_parameter(to, from, []<class To, class From>(To& x, const From& y) {
          if constexpr (std::is_same_v<From, T>) {
            x = To(y);
          } else {
            x = y;
          }
        });
        return to;
      },
      lobe);
}

template <class U, class T>
LobeSum<U> lobes_as(const LobeSum<T>& lobes) {
  LobeSum<U> out;
  for (const auto& part : lobes) out.push_back({U(part.weight), lobe_as<U>(part.lobe)});
  return out;
}

/// sum_i weight_i value(lobe_i) for a non-empty sum.
template <class T, class Value>
T weighted(const LobeSum<T>& lobes, Value value) {
  T sum(0.0);
  bool first = true;
  for (const auto& part : lobes) {
    const T term = part.weight * std::visit(value, part.lobe);
    sum = first ? term : sum + term;
    first = false;
  }
  return sum;
}

/// Phase function at a deflection [1/sr]; its integral over the sphere is 1.
template <class T>
T density(const LobeSum<T>& lobes, const Deflection<T>& d) {
  return weighted(lobes, [&](const auto& lobe) { return lobe.density(d); });
}
/// Probability that mu is at most that of d: 0 at mu = -1, 1 at mu = +1.
template <class T>
T cdf(const LobeSum<T>& lobes, const Deflection<T>& d) {
  return weighted(lobes, [&](const auto& lobe) { return lobe.cdf(d); });
}
/// Probability that mu is more than that of d: 1 - cdf, relatively accurate where that is small.
template <class T>
T survival(const LobeSum<T>& lobes, const Deflection<T>& d) {
  return weighted(lobes, [&](const auto& lobe) { return lobe.survival(d); });
}
/// chi_l = 2 pi int p P_l dmu; chi_0 = 1, chi_1 is the mean cosine. l >= 0.
template <class T>
T moment(const LobeSum<T>& lobes, int l) {
  return weighted(lobes, [&](const auto& lobe) { return lobe.moment(l); });
}
/// Moments 0 to `last`. A table computes all of them in little more than the time of the last.
template <class T>
std::vector<T> moments(const LobeSum<T>& lobes, int last) {
  std::vector<T> out(static_cast<std::size_t>(last) + 1, T(0.0));
  const auto add = [&](const auto& part, const auto& lobe) {
    if constexpr (requires { lobe.moments(last); }) {
      const auto all = lobe.moments(last);
      for (std::size_t l = 0; l < out.size(); ++l) out[l] = out[l] + part.weight * T(all[l]);
    } else {
      for (std::size_t l = 0; l < out.size(); ++l) out[l] = out[l] + part.weight * lobe.moment(static_cast<int>(l));
    }
  };
  for (const auto& part : lobes) std::visit([&](const auto& lobe) { add(part, lobe); }, part.lobe);
  return out;
}
template <class T>
T mean_cosine(const LobeSum<T>& lobes) {
  return moment(lobes, 1);
}

}  // namespace tyndall
