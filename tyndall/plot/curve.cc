#include "tyndall/plot/curve.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace tyndall {
namespace {

constexpr int most_halvings = 12;

double distance_to_segment(const Point& p, const Point& a, const Point& b) {
  const double dx = b.x - a.x, dy = b.y - a.y, squared = dx * dx + dy * dy;
  const double t = squared > 0.0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / squared, 0.0, 1.0) : 0.0;
  return std::hypot(a.x + t * dx - p.x, a.y + t * dy - p.y);
}

struct Place {
  double t;
  Point p;
};

/// Appends the curve after `a` up to and with `b`.
void halve(const Place& a, const Place& b, const std::function<Point(double)>& at, int left, std::vector<Point>& out) {
  const double middle = 0.5 * (a.t + b.t);
  const Place m{middle, at(middle)};
  if (left > 0 && distance_to_segment(m.p, a.p, b.p) > 0.5 * curve_tolerance) {
    halve(a, m, at, left - 1, out);
    halve(m, b, at, left - 1, out);
  } else {
    out.push_back(m.p);
    out.push_back(b.p);
  }
}

/// Leaves out what the straight line between its neighbours passes anyway.
std::vector<Point> thinned(const std::vector<Point>& points) {
  std::vector<Point> out{points.front()};
  std::size_t kept = 0;
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    // No more than a few dozen at a time: the time stays linear.
    bool straight = i - kept < 48;
    for (std::size_t k = kept + 1; straight && k <= i; ++k) {
      straight = distance_to_segment(points[k], points[kept], points[i + 1]) <= 0.5 * curve_tolerance;
    }
    if (straight) continue;
    out.push_back(points[i]);
    kept = i;
  }
  out.push_back(points.back());
  return out;
}

}  // namespace

std::vector<Point> curve(const std::vector<double>& first, const std::function<Point(double)>& at) {
  Place a{first.front(), at(first.front())};
  std::vector<Point> points{a.p};
  for (std::size_t i = 1; i < first.size(); ++i) {
    const Place b{first[i], at(first[i])};
    halve(a, b, at, most_halvings, points);
    a = b;
  }
  return thinned(points);
}

std::vector<double> angles_from(double least) {
  constexpr double pi = std::numbers::pi, half_degree = pi / 360.0;
  std::vector<double> angles{least, pi};
  for (int i = 1; i < 360; ++i) angles.push_back(i * half_degree);
  for (int i = 0;; ++i) {
    const double small = 1e-15 * std::pow(10.0, i / 12.0);
    if (small >= half_degree) break;
    angles.push_back(small);
    angles.push_back(pi - small);
  }
  std::sort(angles.begin(), angles.end());
  angles.erase(std::unique(angles.begin(), angles.end()), angles.end());
  angles.erase(angles.begin(), std::lower_bound(angles.begin(), angles.end(), least));
  return angles;
}

}  // namespace tyndall
