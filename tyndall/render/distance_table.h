#pragma once
// Sampling distances along a ray in proportion to the light that a lamp throws into it.
#include <array>
#include <cmath>
#include <numbers>

#include "tyndall/geometry/vector.h"

namespace tyndall {

/// Distances along `range` of a ray, for a lamp whose closest approach is at abscissa a and distance h. In the
/// equiangular variable t = a + h tan(theta) (Kulla and Fajardo 2012) the factor 1/r^2 is gone; what is left of the
/// integrand is tabulated at a few equidistant knots and sampled as the piecewise-linear function through them, mixed
/// with 5 % of uniform theta, so that every distance with light has a density above zero whatever the table missed.
class DistanceTable {
 public:
  static constexpr int knots = 8;
  static constexpr double uniform_share = 0.05;

  struct Sample {
    double t, density;  // density in t [1/m]
  };

  /// product(t) >= 0: the integrand times r^2. `cut`: the table covers range.begin to min(range.end, cut); beyond, only
  /// the uniform share samples. h is raised to a positive minimum, which is exact: the change of variables holds for
  /// any h > 0.
  template <class Product>
  DistanceTable(const Interval& range, double a, double h, double cut, Product product) : a_(a) {
    h_ = std::max(h, 1e-6 * (1.0 + std::fabs(a)));
    begin_ = std::atan((range.begin - a_) / h_);
    end_ = std::atan((range.end - a_) / h_);
    table_end_ = std::atan((std::min(range.end, cut) - a_) / h_);
    step_ = (table_end_ - begin_) / (knots - 1);
    // Equidistant angles by rotation: one pair of sine and cosine instead of a tangent per knot.
    double sine = std::sin(begin_), cosine = std::cos(begin_);
    const double turn_sine = std::sin(step_), turn_cosine = std::cos(step_);
    for (int i = 0; i < knots; ++i) {
      const double t = cosine > 1e-15 ? a_ + h_ * sine / cosine : infinity;
      const double turned = sine * turn_cosine + cosine * turn_sine;
      cosine = cosine * turn_cosine - sine * turn_sine;
      sine = turned;
      value_[i] = std::isfinite(t) ? product(std::max(t, range.begin)) : 0.0;
      if (i > 0) mass_ += 0.5 * (value_[i - 1] + value_[i]) * step_;
    }
  }

  /// Estimate of the integral of product / r^2 over the range.
  double integral() const { return mass_ / h_; }

  /// A distance for random numbers xi in (0, 1) (position) and choice in (0, 1) (table or uniform).
  Sample sample(double choice, double xi) const {
    double theta;
    if (choice < uniform_share || !(mass_ > 0.0)) {
      theta = begin_ + xi * (end_ - begin_);
    } else {
      double rest = xi * mass_;
      int i = 0;
      while (i < knots - 2 && rest > 0.5 * (value_[i] + value_[i + 1]) * step_) {
        rest -= 0.5 * (value_[i] + value_[i + 1]) * step_;
        ++i;
      }
      // Inverse of the quadratic CDF of a linear density, in the form without cancellation.
      const double slope = (value_[i + 1] - value_[i]) / step_;
      const double root = std::sqrt(std::max(0.0, value_[i] * value_[i] + 2.0 * slope * rest));
      const double s = value_[i] + root > 0.0 ? 2.0 * rest / (value_[i] + root) : 0.0;
      theta = begin_ + i * step_ + std::min(s, step_);
    }
    const double t = distance(theta);
    return {t, density(t)};
  }

  /// Density [1/m] with which sample returns t.
  double density(double t) const {
    const double offset = t - a_, theta = std::atan(offset / h_);
    double angular = uniform_share / (end_ - begin_);
    if (!(mass_ > 0.0)) {
      angular = 1.0 / (end_ - begin_);
    } else if (theta <= table_end_) {
      const double x = std::clamp((theta - begin_) / step_, 0.0, knots - 1.0);
      const int i = std::min(static_cast<int>(x), knots - 2);
      const double linear = value_[i] + (value_[i + 1] - value_[i]) * (x - i);
      angular += (1.0 - uniform_share) * linear / mass_;
    }
    return angular * h_ / (h_ * h_ + offset * offset);
  }

 private:
  double distance(double theta) const { return a_ + h_ * std::tan(theta); }

  double a_, h_, begin_, end_, table_end_, step_, mass_ = 0.0;
  std::array<double, knots> value_{};
};

}  // namespace tyndall
