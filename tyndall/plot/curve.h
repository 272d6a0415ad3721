#pragma once
// Curves as few straight lines as the eye allows.
#include <functional>
#include <vector>

#include "tyndall/plot/figure.h"

namespace tyndall {

/// How far a drawn curve may be from the true one [points].
inline constexpr double curve_tolerance = 0.02;

/// The curve t -> at(t) through the values of `first` (ascending, at least two, close enough together to miss no
/// feature), halved where it bends, thinned where it is straight.
std::vector<Point> curve(const std::vector<double>& first, const std::function<Point(double)>& at);

/// Angles [radians] from `least` to pi, close together near both ends: a peak of any width above 1e-15 is met.
std::vector<double> angles_from(double least);

}  // namespace tyndall
