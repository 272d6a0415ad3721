#pragma once
// The angular law at a point of a medium: the lobes of all species present, weighted per channel.
#include <vector>

#include "tyndall/medium/lowered_medium.h"

namespace tyndall {

/// The mixture where a collision happened. Its lobes' weights are the share of each channel's scattering, so a mixture
/// is chromatic even when every law is grey.
class ScatterPoint {
 public:
  /// The medium that the stretches cross, at distance t.
  void set(const LoweredMedium& medium, const std::vector<Stretch>& stretches, double t) {
    lobes_.clear();
    scattering_ = {};
    const Stretch* before = nullptr;
    double factor = 0.0;
    for (const Stretch& s : stretches) {
      if (t < s.range.begin || t >= s.range.end) continue;
      if (before == nullptr || !s.like(*before)) factor = s.factor_at(t);
      before = &s;
      const Spectrum scattering = s.species->scattering * factor;
      if (is_zero(scattering)) continue;
      scattering_ += scattering;
      for (std::size_t i = 0; i < s.species->lobe_count; ++i) {
        const WeightedLobe<double>& lobe = medium.lobes[s.species->first_lobe + i];
        lobes_.push_back({&lobe.lobe, scattering * lobe.weight});
      }
    }
  }

  /// Scattering coefficient per channel [1/m].
  const Spectrum& scattering() const { return scattering_; }

  /// sum_i sigma_s,i p_i(mu) per channel [1/(m sr)].
  Spectrum scattered(const Deflection<double>& d) const {
    Spectrum total;
    for (const Part& part : lobes_) {
      total += part.scattering * std::visit([&](const auto& lobe) { return lobe.density(d); }, *part.lobe);
    }
    return total;
  }

  /// Chance of each lobe for a path that has throughput beta before scattering: q_i = sum_c beta_c sigma_s,i,c / sum.
  /// Must be called before sample and density.
  void aim(const Spectrum& beta) {
    const double total = sum(beta * scattering_);
    chances_.clear();
    for (const Part& part : lobes_) chances_.push_back(total > 0.0 ? sum(beta * part.scattering) / total : 0.0);
  }

  /// A deflection from the mixture of lobes with those chances; xi is used for the lobe and again, stretched, for its
  /// angle.
  Deflection<double> sample(double xi) const {
    std::size_t i = 0;
    while (i + 1 < lobes_.size() && xi >= chances_[i]) xi -= chances_[i++];
    const double inside = chances_[i] > 0.0 ? std::clamp(xi / chances_[i], 0.0, 1.0) : 0.5;
    return std::visit([&](const auto& lobe) { return lobe.sample(inside); }, *lobes_[i].lobe);
  }

  /// Density [1/sr] with which sample returns the deflection: the balance heuristic's sum over lobes and channels.
  double density(const Deflection<double>& d) const {
    double total = 0.0;
    for (std::size_t i = 0; i < lobes_.size(); ++i) {
      if (chances_[i] > 0.0) {
        total += chances_[i] * std::visit([&](const auto& lobe) { return lobe.density(d); }, *lobes_[i].lobe);
      }
    }
    return total;
  }

 private:
  struct Part {
    const Lobe<double>* lobe;
    Spectrum scattering;
  };
  std::vector<Part> lobes_;
  std::vector<double> chances_;
  Spectrum scattering_;
};

/// The deflection between unit directions of travel before and after: 1 - mu = |a - b|^2 / 2 keeps its digits forward,
/// 1 + mu = |a + b|^2 / 2 backward.
inline Deflection<double> deflection_between(const Vector& before, const Vector& after) {
  return Deflection<double>::from_ends(0.5 * length_squared(before - after), 0.5 * length_squared(before + after));
}

}  // namespace tyndall
