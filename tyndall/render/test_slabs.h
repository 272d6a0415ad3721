#pragma once
// What the tests of slabs share: slabs, and how answers of many seeds spread.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include "tyndall/render/slab.h"

namespace tyndall {

inline Species species(const Law<double>& law, double scattering, double absorption) {
  return {"", Spectrum::grey(scattering), Spectrum::grey(absorption), law, {}};
}
inline SlabRequest slab_of(const Law<double>& law, double albedo, double tau) {
  SlabRequest request;
  request.medium.species.push_back(species(law, albedo * tau, (1.0 - albedo) * tau));
  return request;
}

inline Medium chromatic_mixture() {
  Medium medium;
  medium.species.push_back({"", {{0.3, 0.7, 1.7}}, {}, Rayleigh<double>{}, {}});
  medium.species.push_back({"", {{2.0, 0.5, 0.1}}, {{0.0, 0.1, 0.3}}, HenyeyGreenstein<double>{0.8}, {}});
  medium.species.push_back({"", {{0.0, 1.0, 0.5}}, {}, MieMurky<double>{}, {}});
  return medium;
}

/// Answers of the same slab from many seeds, for how they spread and what they say of it.
class Spread {
 public:
  void add(const Estimate& e, std::size_t channel = 0) {
    answers_.push_back(e.mean[channel]);
    said_ += e.standard_error[channel] * e.standard_error[channel];
  }
  double mean() const { return std::accumulate(answers_.begin(), answers_.end(), 0.0) / count(); }
  double standard_error() const { return std::sqrt(said_) / count(); }
  /// The variance of n normal answers has a relative standard deviation of sqrt(2 / (n - 1)).
  void expect_as_said(const std::string& what) const {
    const double middle = mean();
    double squares = 0.0;
    for (const double x : answers_) squares += (x - middle) * (x - middle);
    EXPECT_NEAR(squares / (count() - 1.0) / (said_ / count()), 1.0, 4.0 * std::sqrt(2.0 / (count() - 1.0))) << what;
  }

 private:
  double count() const { return static_cast<double>(answers_.size()); }
  std::vector<double> answers_;
  double said_ = 0.0;
};

}  // namespace tyndall
