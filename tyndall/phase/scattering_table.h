#pragma once
// A measured or computed phase function as a table, made ready once: knots, normalisation, cumulative distribution.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "tyndall/number/constant_array.h"

namespace tyndall {

/// Knots by rising mu. 1 - mu and 1 + mu are both kept, each with all its digits: forward peaks live in 1 - mu.
struct TableKnots {
  std::vector<double> one_minus, one_plus;
  std::vector<double> value;  // from 0 to 1, at least one above 0; not normalised
  std::size_t size() const { return value.size(); }

  /// Appends the knot at an angle [degrees, 0 to 180] that is less than all before it.
  void add(double degrees, double v) {
    const auto half_sine_squared = [](double angle) {
      const double s = std::sin(angle * (std::numbers::pi / 360.0));
      return s * s;
    };
    one_minus.push_back(2.0 * half_sine_squared(degrees));
    one_plus.push_back(2.0 * half_sine_squared(180.0 - degrees));
    value.push_back(v);
  }

  /// From rising angles [degrees]. Where the first is above 0 or the last below 180 its value holds up to there. No
  /// knots: isotropic. Values become shares of the largest, which must be above 0.
  static TableKnots of_angles(std::span<const double> degrees, std::span<const double> values) {
    TableKnots knots;
    const std::size_t count = std::min(degrees.size(), values.size());
    if (count == 0) {
      knots.add(180.0, 1.0);
      knots.add(0.0, 1.0);
      return knots;
    }
    const double top = *std::max_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(count));
    if (degrees[count - 1] < 180.0) knots.add(180.0, values[count - 1] / top);
    for (std::size_t i = count; i-- > 0;) knots.add(degrees[i], values[i] / top);
    if (degrees[0] > 0.0) knots.add(0.0, values[0] / top);
    return knots;
  }

  /// Between knot k and the next one in mu: from the end of the two that is nearer, so that it keeps its digits.
  double width(std::size_t k) const {
    return one_minus[k] < one_plus[k] ? one_minus[k] - one_minus[k + 1] : one_plus[k + 1] - one_plus[k];
  }
};

/// Density q = 2 pi p, linear in mu between knots, over mu: int q dmu = 1 exactly (trapezoids), not by a sum that ends
/// somewhere between. Arrays hold both ends of things: first as seen from mu = -1, then from mu = +1, so that each half
/// of the sphere can be searched in the numbers that are small there.
class ScatteringTable {
 public:
  /// At least two knots from mu = -1 to mu = +1, mu rising by at least 1e-17 (relatively, seen from the nearer end),
  /// values from 0 to 1, at least one above 0.
  explicit ScatteringTable(const TableKnots& knots) : count_(knots.size()) {
    std::vector<double> widths(count_ - 1), q = knots.value;
    std::vector<long double> mass(count_ - 1);
    long double total = 0.0L;
    for (std::size_t k = 0; k + 1 < count_; ++k) {
      widths[k] = knots.width(k);
      total += mass[k] = 0.5L * widths[k] * (static_cast<long double>(q[k]) + q[k + 1]);
    }
    for (double& x : q) x = static_cast<double>(x / total);
    std::vector<double> positions(2 * count_), cumulated(2 * count_);
    long double below = 0.0L, above = 0.0L;
    for (std::size_t k = 0; k < count_; ++k) {
      positions[k] = knots.one_plus[k];
      positions[count_ + k] = -knots.one_minus[k];
      cumulated[k] = static_cast<double>(below / total);
      if (k + 1 < count_) below += mass[k];
    }
    for (std::size_t k = count_; k-- > 0;) {
      cumulated[count_ + k] = static_cast<double>(-above / total);
      if (k > 0) above += mass[k - 1];
    }
    position_ = constant_array("position", std::move(positions));
    width_ = constant_array("width", std::move(widths));
    density_ = constant_array("value", std::move(q));
    cumulative_ = constant_array("cumulated", std::move(cumulated));
    for (const SharedArray* array : {&position_, &density_}) {
      for (const double x : (*array)->values()) fingerprint_ = (fingerprint_ ^ std::bit_cast<std::uint64_t>(x)) * prime;
    }
  }

  std::size_t size() const { return count_; }
  /// 1 + mu of each knot, rising; then -(1 - mu), rising.
  const SharedArray& position() const { return position_; }
  /// Between each knot and the next, in mu.
  const SharedArray& width() const { return width_; }
  /// 2 pi p at each knot.
  const SharedArray& density() const { return density_; }
  /// Probability of a lesser mu than that of each knot; then minus the probability of a greater one.
  const SharedArray& cumulative() const { return cumulative_; }

  double one_plus(std::size_t k) const { return position_->values()[k]; }
  double one_minus(std::size_t k) const { return -position_->values()[count_ + k]; }

  /// Legendre moments 0 to `last`: Gauss's rule of five points in mu over pieces of at most 1 / (last + 1) radian,
  /// which is exact up to order 8 and good to 1e-13 beyond. O(last (knots + last)).
  std::vector<double> moments(int last) const {
    static constexpr double node[5] = {-0.9061798459386640, -0.5384693101056831, 0.0, 0.5384693101056831,
                                       0.9061798459386640};
    static constexpr double weight[5] = {0.2369268850561891, 0.4786286704993665, 0.5688888888888889, 0.4786286704993665,
                                         0.2369268850561891};
    std::vector<double> out(static_cast<std::size_t>(last) + 1);
    const auto angle = [&](std::size_t k) { return 2.0 * std::atan2(std::sqrt(one_minus(k)), std::sqrt(one_plus(k))); };
    const auto add_node = [&](double mu, double share) {
      double before = 0.0, now = 1.0;
      for (int l = 0;; ++l) {
        out[static_cast<std::size_t>(l)] += share * now;
        if (l == last) break;
        const double next = ((2 * l + 1) * mu * now - l * before) / (l + 1);
        before = now;
        now = next;
      }
    };
    const std::vector<double>&q = density_->values(), &widths = width_->values();
    for (std::size_t k = 0; k + 1 < count_; ++k) {
      if (q[k] == 0.0 && q[k + 1] == 0.0) continue;
      const double from = angle(k), to = angle(k + 1);  // falling
      const int pieces = last <= 8 ? 1 : 1 + static_cast<int>((last + 1) * (from - to));
      double begin = 0.0;
      for (int i = 1; i <= pieces; ++i) {
        // cos a - cos b = 2 sin((a + b)/2) sin((b - a)/2)
        const double a = to + (from - to) * (pieces - i) / pieces;
        const double end = i == pieces ? widths[k] : 2.0 * std::sin(0.5 * (a + from)) * std::sin(0.5 * (from - a));
        const double half = 0.5 * (end - begin);
        for (int n = 0; n < 5; ++n) {
          const double t = begin + half * (1.0 + node[n]);
          const double here = (q[k] * (widths[k] - t) + q[k + 1] * t) / widths[k];
          const double mu = one_plus(k) < 1.0 ? one_plus(k) + t - 1.0 : 1.0 - (one_minus(k) - t);
          add_node(mu, weight[n] * half * here);
        }
        begin = end;
      }
    }
    return out;
  }

  /// The same knots and densities.
  bool operator==(const ScatteringTable& other) const {
    return position_->values() == other.position_->values() && density_->values() == other.density_->values();
  }
  /// Equal for equal tables, almost never for others.
  std::uint64_t fingerprint() const { return fingerprint_; }

 private:
  static constexpr std::uint64_t prime = 1099511628211U;  // of the hash of Fowler, Noll and Vo

  std::size_t count_;
  SharedArray position_, width_, density_, cumulative_;
  std::uint64_t fingerprint_ = 14695981039346656037U;
};

/// Lobes share tables and never change them.
using SharedTable = std::shared_ptr<const ScatteringTable>;

}  // namespace tyndall
