#pragma once
// Random deflections counted in fine bins, and judged against a density by chi-square and by Kolmogorov's distance.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "tests/goodness_of_fit.h"
#include "tyndall/phase/sphere_integral_test.h"

namespace tyndall {

/// Bins in the log-odds s = ln((1 + mu)/(1 - mu)) of at most 1/32768 probability each, which the density alone decides
/// (Gauss-Legendre), so that neither the cumulative distribution nor its inverse is its own judge. Both
/// statistics come from the same counts: chi-square from bins joined to 1/256, Kolmogorov's distance at the fine bins'
/// edges, which misses at most 3e-5 of it (the least distance that fails is 2.7e-3 for 1e6 samples, 8.5e-4 for 1e7).
class SampleHistogram {
 public:
  /// density(deflection) [1/sr].
  template <class Density>
  explicit SampleHistogram(Density density) {
    const auto slope = [&](double s) {
      const Deflection<double> d = at_log_odds(s);
      return std::numbers::pi * density(d) * d.one_minus * d.one_plus;
    };
    for (int i = 0; i < cells; ++i) {
      const double from = i / per_unit - reach, whole = gauss_5(from, from + 1.0 / per_unit, slope);
      const int parts = 1 + static_cast<int>(whole * 32768.0);
      first_.push_back(static_cast<int>(expected_.size()));
      for (int k = 0; k < parts; ++k) {
        const double begin = from + k / (per_unit * parts), end = from + (k + 1) / (per_unit * parts);
        expected_.push_back(parts == 1 ? whole : gauss_2(begin, end, slope));
      }
    }
    first_.push_back(static_cast<int>(expected_.size()));
    found_.resize(expected_.size());
  }

  template <class Real>
  void add(Real one_minus, Real one_plus) {
    const Real s = std::log(one_plus / one_minus);
    const double at = std::clamp((static_cast<double>(s) + reach) * per_unit, 0.0, cells - 1e-3);
    const auto cell = static_cast<std::size_t>(at);
    const int first = first_[cell], parts = first_[cell + 1] - first;
    ++found_[static_cast<std::size_t>(first + static_cast<int>((at - static_cast<double>(cell)) * parts))];
    ++count_;
  }

  /// Probability of a chi-square at least as large.
  double chi_square_probability() const {
    double chi_square = 0.0, expected = 0.0, found = 0.0, left = 0.0;
    const double n = static_cast<double>(count_);
    for (const double p : expected_) left += p;
    int bins = 0;
    for (std::size_t i = 0; i < expected_.size(); ++i) {
      expected += expected_[i];
      found += static_cast<double>(found_[i]);
      left -= expected_[i];
      if (i + 1 < expected_.size() && (expected < 1.0 / 256.0 || left < 1.0 / 256.0)) continue;
      chi_square += (found - n * expected) * (found - n * expected) / (n * expected);
      ++bins;
      expected = found = 0.0;
    }
    return tests::chi_square_survival(chi_square, bins - 1);
  }

  /// Probability of a distance between the distributions at least as large.
  double kolmogorov_probability() const {
    double expected = 0.0, found = 0.0, distance = 0.0;
    for (std::size_t i = 0; i < expected_.size(); ++i) {
      expected += expected_[i];
      found += static_cast<double>(found_[i]);
      distance = std::max(distance, std::fabs(found / static_cast<double>(count_) - expected));
    }
    return tests::kolmogorov_survival(distance, static_cast<double>(count_));
  }

  /// Fails when the samples are too far from the density, or suspiciously near: three chances in a million.
  void judge() const {
    const double chi_square = chi_square_probability(), kolmogorov = kolmogorov_probability();
    EXPECT_GT(chi_square, 1e-6);
    EXPECT_LT(chi_square, 1.0 - 1e-6);
    EXPECT_GT(kolmogorov, 1e-6);
  }

 private:
  static constexpr double reach = 80.0, per_unit = 64.0;
  static constexpr int cells = static_cast<int>(2.0 * reach * per_unit);

  // Of a piece of a cell: the density hardly bends there.
  template <class Function>
  static double gauss_2(double begin, double end, Function f) {
    const double middle = 0.5 * (begin + end), half = 0.5 * (end - begin), off = half * 0.5773502691896258;
    return half * (f(middle - off) + f(middle + off));
  }
  template <class Function>
  static double gauss_5(double begin, double end, Function f) {
    const double middle = 0.5 * (begin + end), half = 0.5 * (end - begin);
    const double inner = half * 0.5384693101056831, outer = half * 0.9061798459386640;
    return half * (0.5688888888888889 * f(middle) + 0.4786286704993665 * (f(middle - inner) + f(middle + inner)) +
                   0.2369268850561891 * (f(middle - outer) + f(middle + outer)));
  }

  std::vector<int> first_;  // bin of each cell
  std::vector<double> expected_;
  std::vector<std::uint32_t> found_;
  std::uint64_t count_ = 0;
};

}  // namespace tyndall
