#pragma once
// What a ray meets of one species: a stretch on which its density is an exponential, times a form that is a polynomial.
#include <array>
#include <span>
#include <vector>

#include "tyndall/light/gauss_legendre.h"
#include "tyndall/medium/grid_walk.h"
#include "tyndall/medium/lowered_species.h"

namespace tyndall {

/// Gauss-Legendre rules on [0, 1] with 1 to 16 points: {node, weight} of n points from index n (n - 1) / 2.
inline const QuadraturePoint* gauss_legendre_rule(int n) {
  static const std::vector<QuadraturePoint> rules = [] {
    std::vector<QuadraturePoint> all;
    for (int count = 1; count <= 16; ++count) {
      for (const QuadraturePoint& q : gauss_legendre(count)) all.push_back(q);
    }
    return all;
  }();
  return &rules[static_cast<std::size_t>(n * (n - 1) / 2)];
}

/// The part of a ray on which one species is present, and its density there: factor exp(-rate (t - range.begin)), times
/// its form where points > 0.
struct Stretch {
  const LoweredSpecies* species;
  Interval range;
  double factor;  // at range.begin; may underflow to 0 high above an air that the ray descends into. Formed: the mean
  double rate;    // [1/m] along the ray; negative when the ray descends into thicker air
  double log_factor;   // at range.begin, the form aside
  int points = 0;      // of Gauss-Legendre over the form; 0: there is none; `cubic_form`: it is the cubic
  double whole = 0.0;  // formed: depth_to(range.end)
  FormRay along;       // of a form that is not a cubic: the ray
  Cubic cubic;

  static constexpr int cubic_form = -1;

  Stretch(const LoweredSpecies& of, const Interval& where, double at_begin, double slope, double log)
      : species(&of), range(where), factor(at_begin), rate(slope), log_factor(log) {}

  /// Whether the other is as dense everywhere: species of one conditions share their profiles, which need be computed
  /// only once.
  bool like(const Stretch& other) const {
    return rate == other.rate && log_factor == other.log_factor && range.begin == other.range.begin &&
           range.end == other.range.end && points == other.points &&
           (points == 0 || species->place == other.species->place);
  }

  /// Density factor at t inside the range.
  double factor_at(double t) const {
    if (points != 0) return formed_at(t);
    return rate == 0.0 ? factor : std::exp(log_factor - rate * (t - range.begin));
  }

  /// Length [m] of unit-density species between range.begin and t, clamped to the range: the factor at the thicker end
  /// times (1 - e^-|rate s|)/|rate|, by expm1 without cancellation; 0 <= result, infinite for an unbounded stretch of
  /// constant density. With a form: Gauss-Legendre, exact for the form's degree; with an exponential besides, to 1e-12
  /// of the whole.
  double depth_to(double t) const {
    const double s = std::min(t, range.end) - range.begin;
    if (!(s > 0.0)) return 0.0;
    if (points != 0) return t >= range.end ? whole : formed_depth(range.begin + s);
    if (rate == 0.0) return factor * s;
    if (rate > 0.0) return -factor * std::expm1(-rate * s) / rate;
    return std::exp(log_factor - rate * s) * std::expm1(rate * s) / rate;
  }

  /// The t at which depth_to(t) = depth >= 0; infinity where the stretch holds less.
  double distance_at(double depth) const {
    if (points != 0) return formed_distance(depth);
    double s;
    if (rate == 0.0) {
      s = depth / factor;
    } else if (rate > 0.0) {
      const double x = depth * rate / factor;
      if (x >= 1.0) return infinity;
      s = -std::log1p(-x) / rate;
    } else if (log_factor > -700.0) {
      s = std::log1p(-depth * rate / factor) / -rate;
    } else {
      s = depth > 0.0 ? (std::log(-depth * rate) - log_factor) / -rate : 0.0;
    }
    const double t = range.begin + s;
    return t < range.end ? t : infinity;
  }

  /// Gives the stretch a form that is a cubic, and no exponential besides.
  void set_form(const Cubic& of) {
    cubic = of;
    points = cubic_form;
    factor = of.integral_to(1.0);
    whole = factor * (range.end - range.begin);
  }

  /// Gives the stretch a form of so many points.
  void set_form(const FormRay& ray, int count) {
    along = ray;
    points = count;
    whole = formed_depth(range.end);
    factor = whole / (range.end - range.begin);
  }

 private:
  /// e^700 is opaque enough for any extinction, and times 0 it is 0.
  double exponential_at(double t) const {
    const double log = log_factor - rate * (t - range.begin);
    return log == 0.0 ? 1.0 : std::exp(std::min(700.0, log));
  }
  double middle() const { return 0.5 * (range.begin + range.end); }

  double formed_at(double t) const {
    if (points == cubic_form) return cubic.at((t - range.begin) / (range.end - range.begin));
    double value = exponential_at(t);
    species->form.multiply(along, middle(), &t, &value, 1);
    return value;
  }

  double formed_depth(double end) const {
    if (points == cubic_form) {
      const double span = range.end - range.begin;
      return span * cubic.integral_to((end - range.begin) / span);
    }
    std::array<double, 16> t{}, value{};
    const QuadraturePoint* rule = gauss_legendre_rule(points);
    const double span = end - range.begin;
    for (int i = 0; i < points; ++i) {
      const auto k = static_cast<std::size_t>(i);
      t[k] = range.begin + span * rule[i].node;
      value[k] = rule[i].weight * exponential_at(t[k]);
    }
    species->form.multiply(along, middle(), t.data(), value.data(), points);
    double sum = 0.0;
    for (int i = 0; i < points; ++i) sum += value[static_cast<std::size_t>(i)];
    return span * sum;
  }

  /// Newton steps inside a bracket, until the depth is met to 1e-15 of the whole.
  double formed_distance(double depth) const {
    if (!(depth < whole)) return infinity;
    double low = range.begin, high = range.end, t = low + (high - low) * (depth / whole);
    for (int step = 0; step < 100; ++step) {
      const double excess = formed_depth(t) - depth;
      if (std::fabs(excess) <= 1e-15 * whole) break;
      (excess < 0.0 ? low : high) = t;
      if (!(high - low > 1e-15 * high)) break;
      const double newton = t - excess / formed_at(t);
      t = newton > low && newton < high ? newton : 0.5 * (low + high);
    }
    return t;
  }
};

/// Beyond this optical depth noise is not followed.
inline constexpr double opaque_depth = 100.0;
/// Beyond so many stretches on one ray (300 volumes of noise) the noise of further species is not followed: 19 MB.
inline constexpr std::size_t most_noisy_stretches = 1u << 17;

/// Appends the stretches of species that share profiles with a form, on the part of the ray where they are. Pieces with
/// an exponential are no longer than 4 of its lengths, down to e^-45 of its thickest end, where 16 points and a
/// polynomial of degree 9 leave 1e-12. Ends where the least channel's depth exceeds `enough`; returns where that is, or
/// infinity.
inline double add_formed_stretches(std::span<const LoweredSpecies> together, const Ray& ray, const Interval& range,
                                   std::vector<Stretch>& out, double enough = infinity) {
  const LoweredSpecies& s = together.front();
  const double rate = s.decay * ray.direction.y;
  const auto log_at = [&](double t) { return s.log_at_height(ray.origin.y + t * ray.direction.y); };
  double least = infinity;  // extinction of the channel that needs most for a depth
  for (std::size_t c = 0; c < channel_count; ++c) {
    double extinction = 0.0;
    for (const LoweredSpecies& one : together) extinction += one.extinction[c];
    if (extinction > 0.0) least = std::min(least, extinction);
  }
  const double step = 4.0 / std::fabs(rate);
  Interval fine{range.begin, std::min(range.end, range.begin + 45.0 / rate)};
  if (rate < 0.0) {
    const double underflows = range.begin + std::max(0.0, (-700.0 - log_at(range.begin)) / -rate);
    fine = {std::max(underflows, range.end - 45.0 / -rate), range.end};
    if (!(range.end < infinity)) fine.begin = underflows;
  }
  const auto put = [&](Stretch& piece) {
    for (const LoweredSpecies& one : together) {
      piece.species = &one;
      out.push_back(piece);
    }
  };
  if (rate == 0.0 && s.form.only_a_grid()) {
    const double start = log_at(range.begin), strength = std::exp(start);
    double depth = 0.0;
    for (GridWalk walk(s.form.grids[0], ray, range); walk.next();) {
      Stretch piece(s, walk.range(), 0.0, 0.0, start);
      piece.set_form(walk.cubic() * strength);
      depth += piece.whole * least;
      put(piece);
      if (depth > enough) return walk.range().end;
    }
    return infinity;
  }
  FormRay along{ray, out.size() < most_noisy_stretches ? range.begin : -infinity};
  double depth = 0.0;
  for (double begin = range.begin, end; begin < range.end; begin = end) {
    end = std::min(range.end, s.form.next_break(along, begin));
    if (rate != 0.0) {
      if (begin < fine.begin) {
        end = std::min(end, fine.begin);
      } else if (begin < fine.end) {
        end = std::min({end, fine.end, std::max(begin + step, std::nextafter(begin, infinity))});
      }
    }
    if (end < infinity && s.form.vanishes(along, 0.5 * (begin + end))) continue;
    const int degree = end < infinity ? s.form.degree(along, 0.5 * (begin + end)) : 0;
    // Many forms in one place: 16 points do for degree 31, or 19 with an exponential, and in parts for any product.
    const int points = degree > 0 ? degree / 2 + 1 + (rate != 0.0 ? 6 : 0) : 0, parts = std::max(1, (points + 15) / 16);
    for (int part = 0; part < parts; ++part) {
      const double from = part == 0 ? begin : begin + (end - begin) * part / parts;
      const double to = part == parts - 1 ? end : begin + (end - begin) * (part + 1) / parts;
      if (!(from < to)) continue;
      const double start = log_at(from);
      Stretch piece(s, {from, to}, std::exp(start), rate, start);
      if (degree > 0) piece.set_form(along, std::min(16, points));
      depth += piece.depth_to(to) * least;
      if (!(piece.factor > 0.0 || rate < 0.0)) continue;
      put(piece);
    }
    if (depth > enough && end < range.end) return end;
    if (depth > opaque_depth) {
      along.entry = -infinity;
      fine = {infinity, infinity};
    }
  }
  return infinity;
}

}  // namespace tyndall
