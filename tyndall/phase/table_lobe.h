#pragma once
// The lobe of a table: linear in mu between knots at any angles.
#include <numbers>
#include <tuple>

#include "tyndall/phase/deflection.h"
#include "tyndall/phase/scattering_table.h"

namespace tyndall {

/// Between two knots q = 2 pi p is a straight line in mu, F a parabola, its inverse a square root: all in closed form,
/// each bin from whichever of its ends keeps the digits. The bin is found by a binary search, so the cost goes with the
/// logarithm of the number of knots. A lobe has its table before it is asked anything.
template <class T>
struct TableLobe {
  SharedTable table;

  static constexpr auto members() { return std::tuple{&TableLobe::table}; }

  T density(const Deflection<T>& d) const { return bin_of(d).here * T(0.5 / std::numbers::pi); }
  T cdf(const Deflection<T>& d) const {
    const Bin bin = bin_of(d);
    const T mass = T(0.5) * bin.from_below * (bin.below + bin.here);
    return lookup(table->cumulative(), bin.index) + mass;
  }
  T survival(const Deflection<T>& d) const {
    const Bin bin = bin_of(d);
    const T mass = T(0.5) * bin.to_above * (bin.here + bin.above);
    return mass - lookup(table->cumulative(), bin.index + T(1.0 + count()));
  }

  /// In the bin where F passes xi, with the masses m below and n above: q^2 goes straight from one end's to the
  /// other's, so q there is a root of positive terms, and the way goes as m (q1 + q) : n (q0 + q). That is
  /// t = 2 m / (q0 + sqrt(q0^2 + 2 slope m)) without its cancellation where the slope is negative. Rises with xi, but
  /// for rounding in the last digits; where nothing scatters in a range of mu, samples leave it out.
  Deflection<T> sample(const T& xi) const {
    const T tiny = T(is_double<T> ? 1e-300 : 1e-37);
    const T y = T(1.0) - xi;
    const T first = named("first", select(xi < T(0.5), T(0.0), T(count())));
    const T wanted = named("wanted", select(xi < T(0.5), xi, -y));
    const T index = named("bin", last_not_above(table->cumulative(), first, table->size() - 2, wanted));
    const T next = named("next", index + T(1.0));
    const T m = named("mass_below", wanted - lookup(table->cumulative(), first + index));
    const T n = named("mass_above", max(lookup(table->cumulative(), first + next) - wanted, T(0.0)));
    const T q0 = named("below", lookup(table->density(), index)), q1 = named("above", lookup(table->density(), next));
    const T q = named("here", sqrt((q0 * q0 * n + q1 * q1 * m) / max(m + n, tiny)));
    const T toward = named("forward", m * (q1 + q)), away = named("backward", n * (q0 + q));
    const T step = named("share", lookup(table->width(), index) / max(toward + away, tiny));
    const T one_plus = named("plus", fma(step, toward, lookup(table->position(), index)));
    const T one_minus = named("minus", fma(step, away, -lookup(table->position(), next + T(count()))));
    return Deflection<T>::from_ends(select(xi > T(0.0), select(xi < T(1.0), one_minus, T(0.0)), T(2.0)),
                                    select(xi > T(0.0), select(xi < T(1.0), one_plus, T(2.0)), T(0.0)));
  }

  T moment(int l) const { return T(table->moments(l).back()); }
  /// All moments up to `last` in one go.
  std::vector<double> moments(int last) const { return table->moments(last); }

 private:
  struct Bin {
    T index;                 // of its lower knot
    T from_below, to_above;  // to the knots, in mu
    T below, above;          // 2 pi p at the knots
    T here;                  // 2 pi p
  };

  double count() const { return static_cast<double>(table->size()); }

  Bin bin_of(const Deflection<T>& d) const {
    const SharedArray& position = table->position();
    const T first = named("first", select(d.one_minus < d.one_plus, T(count()), T(0.0)));
    const T at = named("at", select(d.one_minus < d.one_plus, -d.one_minus, d.one_plus));
    const T index = named("bin", last_not_above(position, first, table->size() - 2, at));
    const T next = named("next", index + T(1.0));
    const T t = named("from_below", max(at - lookup(position, first + index), T(0.0)));
    const T r = named("to_above", max(lookup(position, first + next) - at, T(0.0)));
    const T q0 = named("below", lookup(table->density(), index)), q1 = named("above", lookup(table->density(), next));
    return {index, t, r, q0, q1, named("here", fma(q0, r, q1 * t) / (t + r))};
  }
};

}  // namespace tyndall
