#pragma once
// Constant arrays, and numbers looked up in them: what tables are made of. lookup(array, index) exists for every number
// type; the index is a number too, whole and in [0, size): 0.0, 1.0, ...
//
//   T lookup(const SharedArray& array, const T& index);
//
// float reads the values rounded to float, double the values themselves, Lanes gather, Dual reads constants (no
// derivative: the index jumps), Symbol refers to an array that is printed above the function. last_not_above() is the
// search that irregular knots need.
#include <cassert>
#include <cstddef>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "tyndall/number/scalar.h"

namespace tyndall {

/// Numbers known before a law is evaluated; at least one, at most 2^24 (so that a float can name each), finite.
class ConstantArray {
 public:
  /// `name` is what printed code calls it.
  ConstantArray(std::string name, std::vector<double> values)
      : name_(std::move(name)), exact_(std::move(values)), rounded_(exact_.size()) {
    for (std::size_t i = 0; i < exact_.size(); ++i) rounded_[i] = static_cast<float>(exact_[i]);
  }
  const std::string& name() const { return name_; }
  std::size_t size() const { return exact_.size(); }
  const std::vector<double>& values() const { return exact_; }
  /// The values as T.
  template <Scalar T>
  const T* data() const {
    if constexpr (std::is_same_v<T, double>) {
      return exact_.data();
    } else {
      return rounded_.data();
    }
  }

 private:
  std::string name_;
  std::vector<double> exact_;
  std::vector<float> rounded_;
};

/// Laws, lobes and symbols share arrays and never change them.
using SharedArray = std::shared_ptr<const ConstantArray>;

inline SharedArray constant_array(std::string name, std::vector<double> values) {
  return std::make_shared<const ConstantArray>(std::move(name), std::move(values));
}

template <Scalar T>
T lookup(const SharedArray& array, T index) {
  assert(index >= T(0) && index < static_cast<T>(array->size()));
  return array->data<T>()[static_cast<std::size_t>(index)];
}

/// The largest i in [0, last] with array[first + i] <= key, by a binary search of as many steps as `last` has binary
/// digits; 0 where there is none. The stretch array[first .. first + last] must not fall. `first` may differ from lane
/// to lane: one array can hold several stretches.
template <class T>
T last_not_above(const SharedArray& array, const T& first, std::size_t last, const T& key) {
  int steps = 0;
  while ((std::size_t{1} << steps) <= last) ++steps;
  if (steps == 0) return T(0.0);
  const T end = T(static_cast<double>(last));
  const auto halve = [&](const std::array<T, 2>& state) -> std::array<T, 2> {
    const T index = named("index", state[0]), stride = named("stride", state[1]);
    const T candidate = named("candidate", min(index + stride, end));
    return {select(lookup(array, first + candidate) <= key, candidate, index), T(0.5) * stride};
  };
  const double first_stride = static_cast<double>(std::size_t{1} << (steps - 1));
  return iterate(steps, std::array<T, 2>{T(0.0), T(first_stride)}, halve)[0];
}

}  // namespace tyndall
