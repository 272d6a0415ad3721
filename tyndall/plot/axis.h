#pragma once
// Axes: where a value stands on the page, and which values are written beside it.
#include <string>
#include <vector>

namespace tyndall {

/// Values [low, high] (low < high; low > 0 where logarithmic) along the page's coordinates [begin, end] in points; end
/// may be the smaller one.
struct Axis {
  bool logarithmic = false;
  double low = 0.0, high = 1.0;
  double begin = 0.0, end = 1.0;

  /// Clamped to a little beyond the axis, so that zero has a place on a logarithmic one.
  double at(double value) const;
};

struct Tick {
  double value;
  std::string label;  // empty for a minor tick
};

/// Ticks at round values (1, 2, 5 times a power of ten), labels at least `spacing` points apart; in ascending order.
std::vector<Tick> ticks_of(const Axis& axis, double spacing);

/// Ticks of a logarithmic axis of distances [m], each with its unit: 10 cm, 1 m, 10 km.
std::vector<Tick> distance_ticks_of(const Axis& axis, double spacing);

/// Ticks at angles [degrees]: 30 or 60 apart where linear.
std::vector<Tick> angle_ticks_of(const Axis& axis, double spacing);

struct Limits {
  double low, high;
};
/// Limits of a logarithmic axis that holds [low, high] > 0: 1, 2 or 5 times powers of ten.
Limits round_limits(double low, double high);
/// The same in powers of ten.
Limits decade_limits(double low, double high);

/// A value as a tick says it: all its digits, 0.25 or 2.5×10⁻⁷.
std::string tick_text(double x);
/// 10^exponent as a tick says it: 0.01 where `plain`, else 10⁻².
std::string decade_text(int exponent, bool plain);
/// Three significant digits: 0.0123, 12.3, 1.23×10⁷; "\u2013" where undefined, "\u221e" where infinite.
std::string quantity_text(double x);
/// The same for a number that 1 in size is special to: 0.9999 is not 1.00; "~1" within 1e-6.
std::string share_text(double x);
/// A length [m] in mm, cm, m or km; "> 10⁶ km", "< 1 µm" beyond what anybody needs.
std::string distance_text(double metres);

/// A unit of length and its size [m].
struct LengthUnit {
  std::string name;
  double metres;
};
/// The unit in which a length [m] reads best.
LengthUnit length_unit_for(double metres);

}  // namespace tyndall
