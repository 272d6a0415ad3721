#pragma once
// What the tests of `single` compare with: quadratures of another make.
#include <functional>
#include <numbers>
#include <vector>

#include "tyndall/render/single.h"

namespace tyndall::tests {

constexpr double pi_number = std::numbers::pi;

inline PixelLayers probe(const Scene& scene, const Ray& ray, double distance = infinity) {
  const Geometry geometry(scene);
  return single_radiance(SingleContext(scene, geometry), ray, distance);
}

/// Adaptive Simpson with Richardson's correction: unlike anything that is tested.
inline double simpson(const std::function<double(double)>& f, double a, double b, double fa, double fm, double fb,
                      double tolerance, int depth) {
  const double m = 0.5 * (a + b), f1 = f(0.5 * (a + m)), f2 = f(0.5 * (m + b));
  const double whole = (b - a) / 6.0 * (fa + 4.0 * fm + fb);
  const double halves = (b - a) / 12.0 * (fa + 4.0 * f1 + 2.0 * fm + 4.0 * f2 + fb);
  if (depth == 0 || std::fabs(halves - whole) <= 15.0 * tolerance) return halves + (halves - whole) / 15.0;
  return simpson(f, a, m, fa, f1, fm, 0.5 * tolerance, depth - 1) +
         simpson(f, m, b, fm, f2, fb, 0.5 * tolerance, depth - 1);
}

inline double integral(const std::function<double(double)>& f, double a, double b, double tolerance, int pieces = 64) {
  double sum = 0.0;
  for (int i = 0; i < pieces; ++i) {
    const double low = a + (b - a) * i / pieces, high = a + (b - a) * (i + 1) / pieces;
    sum += simpson(f, low, high, f(low), f(0.5 * (low + high)), f(high), tolerance / pieces, 40);
  }
  return sum;
}

/// Optical depth of one species' way from a to b: straight from its density at points, jumps found by bisection.
inline double depth_of(const Species& species, const Vector& a, const Vector& b) {
  const Vector way = b - a;
  const auto density = [&](double s) { return factor(species, a + way * s); };
  std::vector<double> edges = {0.0};
  constexpr int steps = 2000;
  for (int i = 0; i < steps; ++i) {
    double low = static_cast<double>(i) / steps, high = static_cast<double>(i + 1) / steps;
    if ((density(low) > 0.0) == (density(high) > 0.0)) continue;
    for (int k = 0; k < 60; ++k) {
      const double middle = 0.5 * (low + high);
      ((density(middle) > 0.0) == (density(low) > 0.0) ? low : high) = middle;
    }
    edges.push_back(0.5 * (low + high));
  }
  edges.push_back(1.0);
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    // A hair inside the edges: they themselves may be on either side.
    const double inset = 1e-14;
    if (density(0.5 * (edges[i] + edges[i + 1])) == 0.0) continue;
    const double low = edges[i] + (i > 0 ? inset : 0.0);
    const double high = edges[i + 1] - (i + 2 < edges.size() ? inset : 0.0);
    sum += integral(density, low, high, 1e-13, 2);
  }
  return sum * length(way) * species.extinction()[1];
}

/// int sum_i sigma_s,i p_i I e^-(tau) / r^2 dt in the green channel over [0, end], or the same for a sun.
inline double brute_force(const Medium& medium, const Ray& ray, double end,
                          const std::function<Vector(const Vector&)>& source,
                          const std::function<double(const Vector&)>& irradiance, double tolerance) {
  const auto integrand = [&](double t) {
    const Vector p = ray.at(t), from = source(p);
    const Vector travel = normalized(p - from);
    double depth = 0.0, scattered = 0.0;
    for (const Species& s : medium.species) {
      depth += depth_of(s, ray.origin, p) + depth_of(s, p, from);
      const double mu = dot(travel, -ray.direction);
      scattered += s.scattering[1] * factor(s, p) * density(in_channel(s.phase, 1), Deflection<double>::from_mu(mu));
    }
    return scattered * irradiance(p) * std::exp(-depth);
  };
  return integral(integrand, 0.0, end, tolerance);
}

}  // namespace tyndall::tests
