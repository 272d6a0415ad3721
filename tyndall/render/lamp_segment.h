#pragma once
// The light that lamps throw into one segment of a path, and where along it to sample that light.
#include <vector>

#include "tyndall/light/airlight_spot.h"
#include "tyndall/medium/free_flight.h"
#include "tyndall/render/distance_table.h"
#include "tyndall/render/path_lights.h"
#include "tyndall/render/quick_exp.h"

namespace tyndall {

/// A segment of a path in a medium, seen in one grey channel: enough to decide where to look, never what is seen.
/// Reused from segment to segment.
class LampSegment {
 public:
  struct Sample {
    std::size_t lamp;
    double t, density;  // density [1/m] of the distance times the chance of the lamp
  };

  /// Prepares [0, end] of the ray for a path of throughput beta.
  void set(const LoweredMedium& medium, const std::vector<Stretch>& stretches, const Ray& ray, double end,
           const Spectrum& beta) {
    ray_ = ray;
    end_ = end;
    beta_ = beta / sum(beta);
    parts_.clear();
    lobes_.clear();
    medium_ = {infinity, 0.0};
    for (const Stretch& s : stretches) {
      medium_ = {std::min(medium_.begin, s.range.begin), std::max(medium_.end, s.range.end)};
      const double scattering = sum(beta_ * s.species->scattering), extinction = sum(beta_ * s.species->extinction);
      // Neighbours that come and go together (the species of one medium) are one part.
      const bool joined = !parts_.empty() && parts_.back().stretch.rate == s.rate &&
                          parts_.back().stretch.range.begin == s.range.begin &&
                          parts_.back().stretch.range.end == s.range.end && parts_.back().stretch.points == s.points &&
                          (s.points == 0 || parts_.back().stretch.species->place == s.species->place);
      if (!joined) parts_.push_back({s, 0.0, 0.0, lobes_.size(), lobes_.size()});
      Part& part = parts_.back();
      const double factor = joined ? std::exp(s.log_factor - part.stretch.log_factor) : 1.0;
      part.extinction += extinction * factor;
      for (std::size_t i = 0; i < s.species->lobe_count; ++i) {
        const WeightedLobe<double>& lobe = medium.lobes[s.species->first_lobe + i];
        const double weight = lobe.weight * scattering * factor;
        if (weight == 0.0) continue;
        if (std::holds_alternative<IsotropicLobe<double>>(lobe.lobe)) {
          part.isotropic += weight * inverse_four_pi<double>();
        } else {
          lobes_.push_back({&lobe.lobe, weight});
        }
      }
      part.last_lobe = lobes_.size();
    }
  }

  /// Estimates what each lamp throws on the segment: guessed from one point, and when `careful` from a table for those
  /// that matter.
  void promise(const std::vector<Lamp>& lamps, bool careful) {
    candidates_.clear();
    tables_.clear();
    double most = 0.0;
    for (std::size_t i = 0; i < lamps.size(); ++i) {
      const Approach at = approach(lamps[i]);
      if (at.range.empty()) continue;
      candidates_.push_back({i, at, guess(lamps[i], at), no_table});
      most = std::max(most, candidates_.back().worth);
    }
    promise_ = 0.0;
    for (Candidate& candidate : candidates_) {
      if (careful && candidate.worth >= 0.02 * most) {
        candidate.table = tables_.size();
        tables_.push_back(table(lamps[candidate.lamp], candidate.at));
        candidate.worth = std::max(candidate.worth * 0.1, tables_.back().integral());
      }
      promise_ += candidate.worth;
    }
  }

  /// Chooses among the lamps by their promise and samples a distance; density 0 where no lamp lights the segment.
  Sample sample(const std::vector<Lamp>& lamps, double xi_lamp, double xi_choice, double xi) const {
    if (candidates_.empty()) return {0, 0.0, 0.0};
    // A twentieth of the choices is even: lamps that seemed to promise nothing keep a chance.
    const double even = (promise_ > 0.0 ? 0.05 : 1.0) / static_cast<double>(candidates_.size());
    const auto chance = [&](std::size_t k) {
      return even + (promise_ > 0.0 ? 0.95 * candidates_[k].worth / promise_ : 0.0);
    };
    std::size_t k = 0;
    while (k + 1 < candidates_.size() && xi_lamp >= chance(k)) xi_lamp -= chance(k++);
    const Candidate& chosen = candidates_[k];
    const DistanceTable::Sample at = chosen.table == no_table
                                         ? table(lamps[chosen.lamp], chosen.at).sample(xi_choice, xi)
                                         : tables_[chosen.table].sample(xi_choice, xi);
    return {chosen.lamp, at.t, at.density * chance(k)};
  }

  /// Samples a distance for one lamp; density 0 where it throws no light on the segment.
  Sample sample_one(const std::vector<Lamp>& lamps, std::size_t lamp, double xi_choice, double xi) const {
    const Approach at = approach(lamps[lamp]);
    if (at.range.empty()) return {lamp, 0.0, 0.0};
    const DistanceTable::Sample sample = table(lamps[lamp], at).sample(xi_choice, xi);
    return {lamp, sample.t, sample.density};
  }

 private:
  static constexpr std::size_t no_table = static_cast<std::size_t>(-1);
  struct Part {
    Stretch stretch;
    double extinction, isotropic;  // at unit factor; isotropic includes 1/(4 pi)
    std::size_t first_lobe, last_lobe;
  };
  struct GreyLobe {
    const Lobe<double>* lobe;
    double weight;
  };
  /// How the ray passes a lamp: abscissa and distance of the closest approach, and where its light falls.
  struct Approach {
    double a, h;
    Interval range;
  };
  struct Candidate {
    std::size_t lamp;
    Approach at;
    double worth;
    std::size_t table;  // in tables_, or no_table
  };

  Approach approach(const Lamp& lamp) const {
    const LampView view = LampView::of(ray_, lamp.position);
    Interval range = medium_;
    if (lamp.spot != nullptr) range = intersection(range, cone_stretch(view, lamp.axis, lamp.spot->outer_angle));
    const double a = view.place.along;
    return {a, view.place.aside, range};
  }

  DistanceTable table(const Lamp& lamp, const Approach& at) const {
    return DistanceTable(at.range, at.a, at.h, dim_after(std::clamp(at.a, 0.0, end_)),
                         [&](double t) { return promised(lamp, at, t); });
  }

  /// Integrand in the middle of the angle under which the lamp sees the segment, times that angle.
  double guess(const Lamp& lamp, const Approach& at) const {
    const double h = std::max(at.h, 1e-6 * (1.0 + std::fabs(at.a)));
    const double begin = at.range.begin - at.a,
                 end = std::min(at.range.end, dim_nearly_after(std::clamp(at.a, 0.0, end_))) - at.a;
    if (!(end > begin)) return 0.0;
    // Unit vectors from the lamp to both ends; their sum halves the angle.
    const double r0 = 1.0 / std::sqrt(begin * begin + h * h),
                 r1 = std::isfinite(end) ? 1.0 / std::sqrt(end * end + h * h) : 0.0;
    const double sine1 = std::isfinite(end) ? end * r1 : 1.0;
    const double angle = std::atan2(h * (r0 * sine1 - begin * r0 * r1), h * h * r0 * r1 + begin * r0 * sine1);
    const double middle = at.a + h * (begin * r0 + sine1) / (h * (r0 + r1));
    return promised(lamp, at, std::max(middle, at.range.begin)) * angle / h;
  }

  /// A stretch's density factor at t and depth up to there, nearly (factor_at and depth_to).
  struct PartAt {
    double factor, depth;
  };
  static PartAt part_at(const Stretch& stretch, double t) {
    if (!(t >= stretch.range.begin)) return {0.0, 0.0};
    const bool inside = t < stretch.range.end;
    const double s = (inside ? t : stretch.range.end) - stretch.range.begin;
    // A form is taken at its mean.
    if (stretch.rate == 0.0 || stretch.points != 0) return {inside ? stretch.factor : 0.0, stretch.factor * s};
    const double there = quick_exp(stretch.log_factor - stretch.rate * s);
    // Where the difference is all rounding, the mean of both ends is good.
    const double depth = std::fabs(stretch.rate * s) < 0.05 ? 0.5 * (stretch.factor + there) * s
                                                            : (stretch.factor - there) / stretch.rate;
    return {inside ? there : 0.0, depth};
  }

  /// Light scattered back along the segment at t, times r^2. The lamp's own path is taken to see the extinction at t
  /// all along.
  double promised(const Lamp& lamp, const Approach& at, double t) const {
    const double along = at.a - t, r = std::sqrt(along * along + at.h * at.h);
    if (r == 0.0) return 0.0;
    double power = sum(beta_ * lamp.intensity);
    if (lamp.spot != nullptr) power = sum(beta_ * lamp.intensity_toward((ray_.at(t) - lamp.position) / r));
    if (power == 0.0) return 0.0;
    const double mu = along / r, far = at.h * at.h / (r * (r + std::fabs(along)));  // 1 - |mu| without cancellation
    const Deflection<double> d{mu, along > 0.0 ? far : 1.0 - mu, along > 0.0 ? 1.0 + mu : far};
    double depth = 0.0, extinction = 0.0, scattered = 0.0;
    for (const Part& part : parts_) {
      const PartAt here = part_at(part.stretch, t);
      depth += part.extinction * here.depth;
      if (here.factor == 0.0) continue;
      extinction += part.extinction * here.factor;
      double density = part.isotropic;
      for (std::size_t i = part.first_lobe; i < part.last_lobe; ++i) {
        density += lobes_[i].weight * std::visit([&](const auto& lobe) { return lobe.density(d); }, *lobes_[i].lobe);
      }
      scattered += here.factor * density;
    }
    return power * scattered * quick_exp(-(depth + extinction * r));
  }

  /// Where the light has paid an optical depth of 14 more than at t, the closest approach: up to there what the segment
  /// gains in depth the lamp's own path loses; beyond, both grow. No part alone gets there before, nor do parts that
  /// follow one another.
  double dim_after(double t) const {
    double dim = end_, missing = 14.0, reached = 0.0;
    for (const Part& part : parts_) {
      if (!(part.extinction > 0.0)) continue;
      if (part.stretch.range.begin < reached) missing = 14.0;  // of another species
      reached = part.stretch.range.end;
      const double spent = part.stretch.depth_to(t),
                   gained = part.extinction * (part.stretch.depth_to(infinity) - spent);
      if (gained > missing) {
        dim = std::min(dim, part.stretch.distance_at(spent + missing / part.extinction));
        missing = infinity;
      } else {
        missing -= gained;
      }
    }
    return dim;
  }

  /// The same for air as thick everywhere as at t.
  double dim_nearly_after(double t) const {
    double extinction = 0.0;
    for (const Part& part : parts_) extinction += part.extinction * part_at(part.stretch, t).factor;
    return extinction > 0.0 ? t + 14.0 / extinction : end_;
  }

  Ray ray_;
  double end_ = 0.0;
  Interval medium_;  // from the first to the last of it on the segment
  Spectrum beta_;
  std::vector<Part> parts_;
  std::vector<GreyLobe> lobes_;
  std::vector<Candidate> candidates_;
  std::vector<DistanceTable> tables_;  // of the candidates that were looked at with care
  double promise_ = 0.0;
};

}  // namespace tyndall
