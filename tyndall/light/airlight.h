#pragma once
// Airlight: what a lamp scatters into a ray. Single scattering in a homogeneous medium, to the last digits.
#include <algorithm>
#include <span>

#include "tyndall/color/spectrum.h"
#include "tyndall/geometry/vector.h"
#include "tyndall/light/exponential_integral.h"
#include "tyndall/light/gauss_legendre.h"
#include "tyndall/phase/lobe_sum.h"

namespace tyndall {

/// sqrt(a^2 + b^2), several times as fast as std::hypot where squares neither overflow nor vanish.
inline double hypotenuse(double a, double b) {
  const double squared = a * a + b * b;
  return squared > 1e-290 && squared < 1e290 ? std::sqrt(squared) : std::hypot(a, b);
}

/// Where a lamp stands as seen from a ray: the ray passes it at t = along, at the distance `aside` >= 0 [m]. At t, the
/// distance to the lamp is r = sqrt((t - along)^2 + aside^2), and light scattered into the ray is deflected by
/// mu = (along - t) / r.
struct LampAside {
  double along = 0.0, aside = 1.0;

  static LampAside of(const Ray& ray, const Vector& lamp) {
    const Vector offset = lamp - ray.origin;
    const double along = dot(offset, ray.direction);
    return {along, length(offset - ray.direction * along)};
  }
  double distance_at(double t) const { return hypotenuse(t - along, aside); }
};

/// One lobe of a medium: how much it scatters per channel [1/m], and where to.
struct ScatteringLobe {
  Spectrum scattering;
  Lobe<double> lobe;
};

/// A lit stretch of a ray in the variable x of t = along + aside sinh x, where v = e^x = (t - along + r) / aside gives
///   t + r = along + aside v,   dt / r^2 = 2 v dx / (aside (1 + v^2)),   1 + mu = 2 / (1 + v^2) :
/// every lamp, far or near, looks alike, the nearest singularity being i pi/2 away (algorithms: asinh panels). x is
/// counted from the stretch's begin, so that short stretches keep their digits.
struct AirlightStretch {
  double along = 0.0, aside = 1.0;  // aside raised above 0 where that changes nothing
  double start = 1.0, span = 0.0;   // v at the begin; length in x
  double path = 0.0;                // t + r at the begin
  bool diverges = false;            // the lamp stands on the stretch

  struct Point {
    double v;
    Deflection<double> deflection;
    double weight;  // dt / r^2 per dx [1/m]
    double extra;   // t + r beyond that of the begin [m]
  };
  Point at(double x) const {
    const double v = x < 600.0 ? start * std::exp(x) : std::exp(x + std::log(start));
    // By the smaller of v and 1/v, so that neither square overflows.
    const double w = v < 1.0 ? v : 1.0 / v, one = 1.0 / (1.0 + w * w), rest = w * w * one;
    return {v, Deflection<double>::from_halves(v < 1.0 ? one : rest, v < 1.0 ? rest : one), 2.0 * w * one / aside,
            x < 1.0 ? aside * start * std::expm1(x) : aside * (v - start)};
  }
  /// Distance along the ray and from the lamp at v.
  double t_at(double v) const { return along + 0.5 * aside * (v - 1.0 / v); }
  double distance_at(double v) const { return 0.5 * aside * (v + 1.0 / v); }
  /// x of a t inside the stretch, 0 at its begin.
  double x_at(double begin, double t) const {
    const double d0 = begin - along, d1 = t - along, r0 = hypotenuse(d0, aside), r1 = hypotenuse(d1, aside);
    if (!(t > begin)) return 0.0;
    if (t == infinity) return infinity;
    if (d1 < 0.0) {  // both before the lamp: 1/v = (along - t + r) / aside adds positive terms
      return std::log1p((t - begin) * (1.0 - (d0 + d1) / (r0 + r1)) / (r1 - d1));
    }
    if (d0 >= 0.0) return std::log1p((t - begin) * (1.0 + (d0 + d1) / (r0 + r1)) / (r0 + d0));
    return std::asinh(d1 / aside) + std::asinh(-d0 / aside);
  }

  /// `lit` within t >= 0; its end may be infinite. Light beyond x = 42 past the closest approach, a part in 1e18 of the
  /// whole, is left out. A lamp exactly on the ray (aside = 0) is at 1e-10 of its distance instead, a relative change
  /// of 1e-20; inside the stretch there is no such distance, the integral diverges as 1 / aside.
  static AirlightStretch of(const LampAside& lamp, const Interval& lit) {
    AirlightStretch s;
    const double gap = std::max({lit.begin - lamp.along, lamp.along - lit.end, 0.0});
    s.along = lamp.along;
    s.aside = std::max(lamp.aside, 1e-10 * gap);
    if (!(lit.begin < lit.end)) return s;
    if (!(s.aside > 0.0)) {
      s.diverges = true;
      return s;
    }
    const double d = lit.begin - lamp.along, r = hypotenuse(d, s.aside);
    s.start = d < 0.0 ? s.aside / (r - d) : (r + d) / s.aside;
    s.path = lit.begin + r;
    s.span = std::min(s.x_at(lit.begin, lit.end), 42.0 + std::max(0.0, -std::log(s.start)));
    return s;
  }
};

/// What a ray through a lamp sees: infinite in every channel that scatters.
inline Spectrum divergent(std::span<const ScatteringLobe> lobes) {
  Spectrum sum;
  for (const ScatteringLobe& part : lobes) sum += part.scattering;
  return map(sum, [](double x) { return x > 0.0 ? infinity : 0.0; });
}

/// For lamps that shine alike in all directions.
struct EvenFalloff {
  double operator()(const Deflection<double>&) const { return 1.0; }
};

/// The longest panel in x, and the most that e^(-extinction (t + r)) may fall within one, as an exponent: with these
/// 16 points reach 2e-11 for the lobes of every law (3 and 60: 6e-7).
inline constexpr double airlight_panel = 2.0, airlight_panel_fall = 15.0;
/// Panels end where e^(-extinction (t + r)) has fallen this many panel falls below its begin: e^-45.
inline constexpr int airlight_falls = 3;

/// Calls visit(x) with the places of a stretch, rising and inside (begin, end), where a table has its knots: there
/// 1 + mu = 2 / (1 + v^2) is that of the knot.
template <class Visit>
void for_each_knot(const TableLobe<double>& lobe, const AirlightStretch& stretch, double begin, double end,
                   Visit visit) {
  const ScatteringTable& table = *lobe.table;
  for (std::size_t k = table.size() - 1; k-- > 1;) {
    const double x = 0.5 * std::log(table.one_minus(k) / table.one_plus(k)) - std::log(stretch.start);
    if (x >= end) return;
    if (x > begin) visit(x);
  }
}

/// What becomes of the knots of tables. `split`: panels end there, which takes some ten times as long with 300 knots
/// and is good to 1e-10; `crossed`: panels do not know of them, and err by 6e-5 where 300 knots follow a smooth curve,
/// by up to 1e-2 where there is a bow three degrees wide.
enum class TableKnotPanels { split, crossed };

/// int over `lit` of sum_i scattering_i p_i(mu) falloff e^(-extinction (t + r)) / r^2 dt per channel: the radiance
/// [W/(m^2 sr)] that a lamp of 1 W/sr scatters into the ray's origin, t = 0. Gauss-Legendre-16 panels, of 4 points
/// between knots that are close. Any lobe; falloff(deflection) is the lamp's relative intensity toward the point (the
/// direction from lamp to point follows from mu), smooth over the stretch. Infinite when the stretch diverges.
template <class Falloff = EvenFalloff>
Spectrum airlight_by_panels(std::span<const ScatteringLobe> lobes, const Spectrum& extinction,
                            const AirlightStretch& stretch, const Falloff& falloff = {},
                            TableKnotPanels knots = TableKnotPanels::split) {
  const auto has_knots = [&](const ScatteringLobe& part) {
    return knots == TableKnotPanels::split && std::holds_alternative<TableLobe<double>>(part.lobe);
  };
  const auto attenuated = [&](Spectrum value, const AirlightStretch::Point& p) {
    const double weight = p.weight * falloff(p.deflection);
    double attenuation = 1.0;
    for (std::size_t c = 0; c < channel_count; ++c) {
      if (c == 0 || extinction[c] != extinction[c - 1]) attenuation = weight * std::exp(-extinction[c] * p.extra);
      value[c] *= attenuation;
    }
    return value;
  };
  const auto smooth = [&](double x) {
    const AirlightStretch::Point p = stretch.at(x);
    Spectrum value;
    for (const ScatteringLobe& part : lobes) {
      if (has_knots(part)) continue;
      value += part.scattering * std::visit([&](const auto& l) { return l.density(p.deflection); }, part.lobe);
    }
    return attenuated(value, p);
  };
  // Every channel's falls are panel borders, so that each is resolved where it is bright.
  std::array<double, airlight_falls * channel_count + 1> borders;
  std::size_t count = 0;
  const auto fall = [&](double sigma, int falls) {
    const double reach = falls * airlight_panel_fall / (sigma * stretch.aside * stretch.start);
    return std::min(stretch.span, reach < 1e300 ? std::log1p(reach) : stretch.span);
  };
  for (std::size_t c = 0; c < channel_count; ++c) {
    if (c > 0 && extinction[c] == extinction[c - 1]) continue;
    for (int k = 1; k <= airlight_falls; ++k) borders[count++] = fall(extinction[c], k);
  }
  std::sort(borders.begin(), borders.begin() + static_cast<std::ptrdiff_t>(count));
  Spectrum sum;
  const auto add = [&](double begin, double end, const auto& integrand) {
    const int panels = static_cast<int>(std::ceil((end - begin) / airlight_panel));
    for (int k = 0; k < panels; ++k) {
      sum += gauss_legendre_16(begin + (end - begin) * k / panels, begin + (end - begin) * (k + 1) / panels, integrand);
    }
  };
  const auto between_borders = [&](auto visit) {
    double begin = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      if (borders[i] > begin) visit(begin, borders[i]);
      begin = std::max(begin, borders[i]);
    }
  };
  if (!std::all_of(lobes.begin(), lobes.end(), has_knots)) {
    between_borders([&](double begin, double end) { add(begin, end, smooth); });
  }
  for (const ScatteringLobe& part : lobes) {
    if (!has_knots(part)) continue;
    const auto& table = std::get<TableLobe<double>>(part.lobe);
    const auto kinked = [&](double x) {
      const AirlightStretch::Point p = stretch.at(x);
      return attenuated(part.scattering * table.density(p.deflection), p);
    };
    between_borders([&](double begin, double end) {
      double last = begin;
      const auto up_to = [&](double x) {
        const double length = x - last,
                     drop = largest(extinction) * stretch.aside * stretch.start * std::exp(x) * length;
        if (length < 0.4 && drop < 0.8) {
          sum += gauss_legendre_4(last, x, kinked);
        } else {
          add(last, x, kinked);
        }
        last = x;
      };
      for_each_knot(table, stretch, begin, end, up_to);
      up_to(end);
    });
  }
  for (std::size_t c = 0; c < channel_count; ++c) sum[c] *= std::exp(-extinction[c] * stretch.path);
  return stretch.diverges ? divergent(lobes) : sum;
}

}  // namespace tyndall
