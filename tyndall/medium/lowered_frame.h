#pragma once
// A lowered medium that is filled again for every frame: nothing allocates once the first frames have been.
#include <array>
#include <span>
#include <variant>
#include <vector>

#include "tyndall/medium/lowered_medium.h"

namespace tyndall {

/// Species are put one by one, in the same order in every frame, each with a law and profiles made as in the first
/// frame (the same alternatives, the same tables) and other numbers. A species that does nothing in a frame keeps its
/// place with coefficients of 0, and equal lobes stay apart: but for that, medium() is what lower() makes.
class LoweredFrame {
 public:
  /// A new frame, at a time [s] for what the wind has done to noise.
  void begin(double time) {
    time_ = time;
    next_ = 0;
    at_origin_ = {};
  }

  void put(const Spectrum& scattering, const Spectrum& absorption, const Law<double>& law,
           std::span<const Profile> profiles) {
    if (next_ == slots_.size()) add_slot(law);
    Slot& slot = slots_[next_];
    slot.profiles.assign(profiles.begin(), profiles.end());  // as many as before: in place
    double here = 1.0;
    for (const Profile& profile : slot.profiles) here *= mean_factor(profile, Vector{});
    at_origin_ += (scattering + absorption) * here;
    for (std::size_t i = 0; i < slot.channels; ++i) {
      LoweredSpecies& s = medium_.species[slot.first + i];
      s.scattering = scattering;
      s.absorption = absorption;
      s.extinction = scattering + absorption;
      if (slot.channels > 1) only(s, i);
      put_in_place(s, slot);
      std::size_t lobe = s.first_lobe, leaf = 0;
      put_lobes(law, 1.0, slot.leaves[i], leaf, lobe);
    }
    const bool same = next_ > 0 && slots_[next_ - 1].profiles == slot.profiles;
    for (std::size_t i = 0; i < slot.channels; ++i) {
      medium_.species[slot.first + i].place = same ? medium_.species[slot.first - 1].place : slot.first;
    }
    ++next_;
  }

  /// The frame is complete: what was not put into it is not there.
  void end() {
    for (; next_ < slots_.size(); ++next_) {
      for (std::size_t i = 0; i < slots_[next_].channels; ++i) {
        LoweredSpecies& s = medium_.species[slots_[next_].first + i];
        s.scattering = s.absorption = s.extinction = {};
      }
    }
  }

  /// Extinction at the origin of what this frame has so far [1/m], noise at its mean.
  const Spectrum& extinction_at_origin() const { return at_origin_; }
  const LoweredMedium& medium() const { return medium_; }

 private:
  /// A law that is no mixture: how many lobes are kept for it, and where they never change, their weights in it.
  struct Leaf {
    std::size_t count;
    std::vector<double> weights;
  };
  struct Slot {
    std::size_t first = 0, channels = 1;
    std::vector<Profile> profiles;
    std::array<std::vector<Leaf>, channel_count> leaves;
  };

  static void only(LoweredSpecies& s, std::size_t channel) {
    for (Spectrum* coefficient : {&s.scattering, &s.absorption, &s.extinction}) {
      const double here = (*coefficient)[channel];
      *coefficient = {};
      (*coefficient)[channel] = here;
    }
  }

  void put_in_place(LoweredSpecies& s, const Slot& slot) const {
    s.decay = s.base = 0.0;
    s.boxes.clear();
    s.spheres.clear();
    s.heights = {};
    s.form.tents.clear();
    s.form.boxes.clear();
    s.form.spheres.clear();
    s.form.noises.clear();
    s.form.grids.clear();
    if (!tyndall::place(s, slot.profiles, time_)) s.scattering = s.absorption = s.extinction = {};
  }

  void add_slot(const Law<double>& law) {
    Slot slot;
    slot.first = medium_.species.size();
    slot.channels = is_chromatic(law) ? channel_count : 1;
    for (std::size_t i = 0; i < slot.channels; ++i) {
      LoweredSpecies s;
      s.first_lobe = medium_.lobes.size();
      add_leaves(slot.channels > 1 ? in_channel(law, i) : law, slot.leaves[i]);
      s.lobe_count = medium_.lobes.size() - s.first_lobe;
      medium_.species.push_back(std::move(s));
    }
    slots_.push_back(std::move(slot));
  }

  void add_leaves(const Law<double>& law, std::vector<Leaf>& leaves) {
    if (const auto* mixture = std::get_if<Mixture<double>>(&law)) {
      for (const auto& part : mixture->parts) add_leaves(part.phase, leaves);
      return;
    }
    LobeSum<double> lobes = lower(law);
    Leaf leaf{lobes.size(), {}};
    if (std::holds_alternative<Droplet<double>>(law)) {
      leaf.count = Droplet<double>::most_lobes;
      lobes.resize(leaf.count, {0.0, lobes.back().lobe});
    }
    for (auto& part : lobes) {
      leaf.weights.push_back(part.weight);
      medium_.lobes.push_back(std::move(part));
    }
    leaves.push_back(std::move(leaf));
  }

  /// Writes the lobes of a law from the place `lobe` on, and counts both on.
  void put_lobes(const Law<double>& law, double share, const std::vector<Leaf>& leaves, std::size_t& leaf,
                 std::size_t& lobe) {
    if (const auto* mixture = std::get_if<Mixture<double>>(&law)) {
      double total = 0.0;
      for (const auto& part : mixture->parts) total += part.weight;
      for (const auto& part : mixture->parts) put_lobes(part.phase, share * (part.weight / total), leaves, leaf, lobe);
      return;
    }
    const Leaf& kept = leaves[leaf++];
    const std::size_t end = lobe + kept.count;
    std::visit(
        [&](const auto& l) {
          if constexpr (requires { l.lobe(); }) {
            medium_.lobes[lobe++] = {share, l.lobe()};
          } else if constexpr (requires { l.most_lobes; }) {
            l.for_each_lobe([&](double weight, const Lobe<double>& one) {
              medium_.lobes[lobe++] = {share * weight, one};
            });
            for (; lobe < end; ++lobe) medium_.lobes[lobe].weight = 0.0;
          } else {  // a law without numbers that could change
            for (const double weight : kept.weights) medium_.lobes[lobe++].weight = share * weight;
          }
        },
        law);
  }

  double time_ = 0.0;
  std::size_t next_ = 0;
  Spectrum at_origin_;
  std::vector<Slot> slots_;
  LoweredMedium medium_;
};

}  // namespace tyndall
