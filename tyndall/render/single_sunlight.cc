// sun_airlight: parallel light scattered once into a ray.
#include <algorithm>

#include "tyndall/light/airlight_adaptive.h"
#include "tyndall/render/single_airlight.h"

namespace tyndall {

Spectrum sun_airlight(const RayMedium& along, const Vector& toward, std::span<const Interval> lit, double tolerance) {
  Spectrum sum;
  if (along.empty() || lit.empty()) return sum;
  const SingleMedium& medium = along.medium();
  const Vector& direction = along.ray().direction;
  // Light travels along -toward before, along -direction after.
  const auto deflection =
      Deflection<double>::from_ends(0.5 * length_squared(toward - direction), 0.5 * length_squared(toward + direction));
  std::vector<Spectrum> strength;  // of each stretch, where its factor is 1
  for (const Stretch& s : along.stretches()) {
    Spectrum scattering;
    for (const ScatteringLobe& lobe : medium.lobes_of(*s.species)) {
      scattering += lobe.scattering * std::visit([&](const auto& l) { return l.density(deflection); }, lobe.lobe);
    }
    strength.push_back(scattering);
  }
  if (std::all_of(strength.begin(), strength.end(), [](const Spectrum& s) { return is_zero(s); })) return sum;
  std::vector<Stretch> scratch;
  const auto depth_at = [&](double t) {
    stretches_along(medium.lowered, {along.ray().at(t), toward}, infinity, scratch);
    return optical_depth(along.stretches(), t) + optical_depth(scratch, infinity);
  };
  std::vector<double> kinks;
  add_kinks(medium.lowered, Wedge::toward_direction(along.ray(), {0.0, along.reach()}, toward), kinks);
  std::vector<double> breaks;
  for (const Interval& stretch : lit) {
    const Interval within = intersection(stretch, {0.0, along.reach()});
    if (!(within.begin < within.end)) continue;
    breaks.assign({within.begin, within.end});
    const auto add = [&](const std::vector<double>& list) {
      for (const double t : list) {
        if (t > within.begin && t < within.end) breaks.push_back(t);
      }
    };
    add(along.borders());
    add(kinks);
    if (!medium.linear) add(along.marks());
    std::sort(breaks.begin(), breaks.end());
    if (!medium.linear) {
      sum += integrate_adaptively(breaks, infinity, tolerance, [&](double t) {
        Spectrum value;
        for (std::size_t i = 0; i < strength.size(); ++i) {
          const Stretch& s = along.stretches()[i];
          if (t >= s.range.begin && t <= s.range.end) value += strength[i] * s.factor_at(t);
        }
        if (!is_zero(value)) attenuate(value, depth_at(t));
        return value;
      });
      continue;
    }
    for (std::size_t k = 0; k + 1 < breaks.size(); ++k) {
      const double begin = breaks[k], span = breaks[k + 1] - begin;
      if (!(span > 0.0)) continue;
      // With w in [0, 1] the share of the piece's own column of medium W, and a depth E(w) = E0 + (E1 - E0) w:
      //   int strength e^-E W dw = strength W (e^-E0 - e^-E1) / (E1 - E0).
      // E is taken where w = 1/4 and 3/4 and continued to the ends, where it may jump.
      double rate = 0.0;
      Spectrum column;  // strength times W, added over species: all share the rate
      for (std::size_t i = 0; i < strength.size(); ++i) {
        const Stretch& s = along.stretches()[i];
        const double middle = begin + 0.5 * span;
        if (middle < s.range.begin || middle > s.range.end) continue;
        rate = s.rate;
        // From the dense end: e^(-rate t) only falls from there.
        const double dense = s.factor_at(rate < 0.0 ? begin + span : begin);
        column += strength[i] * (dense * (rate == 0.0 ? span : -std::expm1(-std::fabs(rate) * span) / std::fabs(rate)));
      }
      if (is_zero(column)) continue;
      const auto place_of = [&](double share) {
        if (rate == 0.0) return begin + share * span;
        const double fall = std::fabs(rate) * span;
        return rate > 0.0 ? begin - std::log1p(share * std::expm1(-fall)) / rate
                          : begin + (fall + std::log1p((1.0 - share) * std::expm1(-fall))) / -rate;
      };
      const Spectrum e0 = depth_at(place_of(0.25)), e1 = depth_at(place_of(0.75));
      for (std::size_t c = 0; c < channel_count; ++c) {
        if (!(column[c] > 0.0) || !(e0[c] < 1e6) || !(e1[c] < 1e6)) continue;
        const double fall = 2.0 * std::fabs(e1[c] - e0[c]);  // between the ends
        const double least = std::min(e0[c], e1[c]) - 0.25 * fall;
        sum[c] += column[c] * std::exp(-least) * (fall > 1e-8 ? -std::expm1(-fall) / fall : 1.0 - 0.5 * fall);
      }
    }
  }
  return sum;
}

}  // namespace tyndall
