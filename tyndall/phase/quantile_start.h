#pragma once
// Sampling of a sum of lobes by the thousand: the search for a quantile begins beside it, from a small table that is
// made once.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <optional>
#include <vector>

#include "tyndall/number/small_table.h"
#include "tyndall/phase/sum_inverse.h"

namespace tyndall {

/// The log-odds s of the deflection as a function of the log-odds of xi (cdf_inverse.h), by Hermite's cubics between 32
/// knots put where they are missed; then `steps` of Newton's on the lobes themselves, so that the result is exact, not
/// the table's. 32 numbers fit into two registers, where Lanes look them up without memory.
struct QuantileStart {
  static constexpr std::size_t knots = small_rows;
  template <class T>
  using Table = SmallTable<T, 5>;
  /// Log-odds that float has of xi: from 1e-12 to 1 - 2^-24.
  static constexpr double least = -28.0, greatest = 17.0;

  /// The knots L_i, rising; then c_0 to c_3 of s = sum_k c_k (L - L_i)^k.
  std::array<SharedArray, 5> columns;
  int steps = 0;
  static constexpr int most_steps = 4;

  /// The curve at some xi: s, ds/dL and d2s/dL2 of the log-odds L of xi.
  template <class T>
  struct Place {
    T s, rise, bend;
  };
  /// The log-odds L of xi, y = 1 - xi, as far as the table goes.
  template <class T>
  static T key(const T& xi, const T& y) {
    const T odds = named("log_odds", rough_log(xi / y));  // infinite at the ends
    return named("key", max(T(least), min(T(greatest), odds)));
  }
  template <class T>
  static Place<T> place(const Table<T>& table, const T& key) {
    const auto row = table.row_of(key);
    const T t = named("t", key - table.at(0, row));
    const T c0 = table.at(1, row), c1 = table.at(2, row), c2 = table.at(3, row), c3 = table.at(4, row);
    const T c3t = named("c3t", c3 * t);
    return {fma(fma(c2 + c3t, t, c1), t, c0), fma(fma(T(3.0), c3t, T(2.0) * c2), t, c1), fma(T(6.0), c3t, T(2.0) * c2)};
  }

  /// F - xi. Both F and 1 - F tell it, and the mean of F - xi and (1 - xi) - (1 - F) by these weights errs by less than
  /// either alone, relatively to F (1 - F).
  template <class T>
  static T excess_of(const T& xi, const T& y, const Passage<T>& at) {
    return fma(at.below - xi, y, xi * (y - at.above));
  }
  /// dF/ds.
  template <class T>
  static T slope_of(const Deflection<T>& d, const Passage<T>& at) {
    return pi<T>() * at.density * d.one_minus * d.one_plus;
  }
  /// Newton's step in s where F and 1 - F are known.
  template <class T>
  static T step(const T& xi, const T& y, const Deflection<T>& d, const Passage<T>& at) {
    return named("ds", -excess_of(xi, y, at) / max(slope_of(d, at), T(least_share<T>)));
  }
  /// The last step. In F the inverse bends by d2s/dF2 = (bend - rise (1 - 2 F)) / (F (1 - F))^2, of which the curve
  /// knows enough: the error is of third order. The result moves 1 -+ mu themselves, which do not inherit the rounding
  /// of s: with odds e^s that grow by e^ds.
  template <class T>
  static Deflection<T> last(const T& xi, const T& y, const Place<T>& from, const Deflection<T>& d,
                            const Passage<T>& at) {
    const T excess = named("excess", excess_of(xi, y, at)), slope = named("slope", slope_of(d, at));
    const T spread = named("spread", xi * y);
    const T inverse = named("inverse", excess / max(slope * spread, T(least_share<T>)));
    const T newton = -inverse * spread, relative = named("relative", inverse * slope);
    const T bent = fma(-from.rise, y - xi, from.bend);
    const T whole = named("whole", fma(T(0.5) * relative * relative, bent, newton));
    const T ds = named("ds", max(T(-0.1), min(T(0.1), whole)));
    const T growth = named("growth", ds * fma(ds, fma(ds, T(1.0 / 6.0), T(0.5)), T(1.0)));
    const T share = named("share", T(1.0) / fma(T(0.5) * growth, d.one_plus, T(1.0)));
    const T minus = d.one_minus * share, plus = fma(d.one_plus, growth, d.one_plus) * share;
    return Deflection<T>::from_ends(select(xi > T(0.0), select(xi < T(1.0), minus, T(0.0)), T(2.0)),
                                    select(xi > T(0.0), select(xi < T(1.0), plus, T(2.0)), T(0.0)));
  }
  /// Nearly: the search asks the lobes about this deflection, wherever it is.
  template <class T>
  static Deflection<T> at_log_odds(const T& s) {
    const T odds = named("odds", rough_exp(s)), one_minus = named("one_minus", T(2.0) / (T(1.0) + odds));
    return Deflection<T>::from_ends(one_minus, odds * one_minus);
  }

  /// None where most_steps are not enough for float: lobes far apart with next to nothing between. 300 to 600 exact
  /// quantiles, some milliseconds.
  static std::optional<QuantileStart> of(const LobeSum<double>& lobes);

 private:
  struct Node {
    double s, slope;
  };
  /// At some log-odds of xi.
  static Node exact(const LobeSum<double>& lobes, double key) {
    const double xi = 1.0 / (1.0 + std::exp(-key)), y = 1.0 / (1.0 + std::exp(key));
    Deflection<double> d = sample(lobes, xi);
    // 1 - xi has lost digits near 1: one more step with the y that was meant.
    d = at_log_odds(log_odds(d) + step(xi, y, d, {cdf(lobes, d), survival(lobes, d), density(lobes, d)}));
    const double slope = std::numbers::pi * density(lobes, d) * d.one_minus * d.one_plus;
    return {log_odds(d), xi * y / std::max(slope, 1e-300)};
  }
};

/// Lobes may have a passage of their own where the three have work in common.
template <class T, class L>
Passage<T> passage_of(const L& lobe, const Deflection<T>& d) {
  if constexpr (requires { lobe.passage(d); }) {
    return lobe.passage(d);
  } else {
    return {lobe.cdf(d), lobe.survival(d), lobe.density(d)};
  }
}
template <class T>
Passage<T> passage(const LobeSum<T>& lobes, const Deflection<T>& d) {
  Passage<T> sum{T(0.0), T(0.0), T(0.0)};
  for (const auto& part : lobes) {
    const Passage<T> one = std::visit([&](const auto& lobe) { return passage_of(lobe, d); }, part.lobe);
    sum = {fma(part.weight, one.below, sum.below), fma(part.weight, one.above, sum.above),
           fma(part.weight, one.density, sum.density)};
  }
  return sum;
}

/// The deflection with cdf(lobes, d) = xi, as sum_inverse.h promises; xi is 0 or at least 1e-12.
template <class T>
Deflection<T> sample(const LobeSum<T>& lobes, const QuantileStart& start, const T& xi) {
  const T y = T(1.0) - xi;
  const QuantileStart::Place<T> place =
      QuantileStart::place(QuantileStart::Table<T>(start.columns), QuantileStart::key(xi, y));
  T s = place.s;
  for (int i = 1; i < start.steps; ++i) {
    const Deflection<T> d = QuantileStart::at_log_odds(s);
    s = s + QuantileStart::step(xi, y, d, passage(lobes, d));
  }
  const Deflection<T> d = QuantileStart::at_log_odds(s);
  return QuantileStart::last(xi, y, place, d, passage(lobes, d));
}

inline std::optional<QuantileStart> QuantileStart::of(const LobeSum<double>& lobes) {
  struct Cubic {
    std::array<double, 4> c;
    double operator()(double t) const { return c[0] + t * (c[1] + t * (c[2] + t * c[3])); }
    double rise(double t) const { return c[1] + t * (2.0 * c[2] + 3.0 * t * c[3]); }
    double bend(double t) const { return 2.0 * c[2] + 6.0 * t * c[3]; }
  };
  std::map<double, Node> known;
  const auto node = [&](double key) {
    const auto found = known.find(key);
    return found != known.end() ? found->second : known[key] = exact(lobes, key);
  };
  const auto cubic = [&](double from, double to) -> Cubic {
    const Node a = node(from), b = node(to);
    const double h = to - from, mean = (b.s - a.s) / h;
    return {{a.s, a.slope, (3.0 * mean - 2.0 * a.slope - b.slope) / h, (a.slope + b.slope - 2.0 * mean) / (h * h)}};
  };
  struct Piece {
    double from, to, error;
  };
  const auto piece = [&](double from, double to) {
    const Cubic curve = cubic(from, to);
    double error = 0.0;
    for (const double part : {0.25, 0.5, 0.75}) {
      const double t = part * (to - from);
      error = std::max(error, std::fabs(curve(t) - node(from + t).s));
    }
    return Piece{from, to, error};
  };
  std::vector<Piece> pieces{piece(least, greatest)};
  while (pieces.size() + 1 < knots) {
    const auto worst = std::max_element(pieces.begin(), pieces.end(),
                                        [](const Piece& a, const Piece& b) { return a.error < b.error; });
    const double from = worst->from, to = worst->to, middle = 0.5 * (from + to);
    *worst = piece(from, middle);
    pieces.push_back(piece(middle, to));
  }
  std::sort(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) { return a.from < b.from; });

  // Halving leaves errors a factor of 16 apart. They go with the fourth power of the width: knots move until neighbours
  // are alike.
  for (int sweep = 0; sweep < 12; ++sweep) {
    for (std::size_t turn = 0; turn + 1 < pieces.size(); ++turn) {
      const std::size_t i = sweep % 2 == 0 ? turn : pieces.size() - 2 - turn;
      Piece &left = pieces[i], &right = pieces[i + 1];
      const double lean = std::pow((right.error + 1e-12) / (left.error + 1e-12), 0.2);
      const double a = (left.to - left.from) * lean, b = right.to - right.from;
      const double from = left.from, to = right.to, between = from + (to - from) * a / (a + b);
      const Piece new_left = piece(from, between), new_right = piece(between, to);
      if (std::max(new_left.error, new_right.error) > std::max(left.error, right.error)) continue;
      left = new_left;
      right = new_right;
    }
  }

  // How many steps: such that float is right even where the curves miss by half as much again as at these places.
  int needed = 1;
  for (const Piece& p : pieces) {
    const Cubic curve = cubic(p.from, p.to);
    for (const double part : {0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875}) {
      const double t = part * (p.to - p.from), key = p.from + t;
      const double wanted = node(key).s, xi = 1.0 / (1.0 + std::exp(-key)), y = 1.0 / (1.0 + std::exp(key));
      Place<double> place{wanted + 1.5 * (curve(t) - wanted), curve.rise(t), curve.bend(t)};
      for (int taken = 1;; ++taken) {
        const Deflection<double> d = at_log_odds(place.s);
        const Passage<double> at = passage(lobes, d);
        if (std::fabs(log_odds(last(xi, y, place, d, at)) - wanted) < 2.5e-7) {
          needed = std::max(needed, taken);
          break;
        }
        if (taken == most_steps) return std::nullopt;
        place.s += step(xi, y, d, at);
      }
    }
  }

  std::array<std::vector<double>, 5> rows;
  const auto add_row = [&](double key, const std::array<double, 4>& c) {
    rows[0].push_back(key);
    for (std::size_t k = 0; k < 4; ++k) rows[k + 1].push_back(c[k]);
  };
  for (const Piece& p : pieces) add_row(p.from, cubic(p.from, p.to).c);
  add_row(greatest, {node(greatest).s, node(greatest).slope, 0.0, 0.0});
  QuantileStart out;
  for (std::size_t k = 0; k < 5; ++k) out.columns[k] = constant_array("start", std::move(rows[k]));
  out.steps = needed;
  return out;
}

}  // namespace tyndall
