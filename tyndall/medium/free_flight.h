#pragma once
// Distances between collisions, sampled over all channels at once.
#include <vector>

#include "tyndall/medium/lowered_medium.h"

namespace tyndall {

/// The t < end at which the optical depth of `channel` reaches depth > 0; infinity if it does not before end.
/// Closed form for constant density, and for stretches that are alike or follow one another as far as a stretch inverts
/// itself (Stretch::distance_at); else Newton steps kept inside a bracket (relative error 1e-14).
inline double distance_at_depth(const std::vector<Stretch>& stretches, std::size_t channel, double depth, double end) {
  double constant_rate = 0.0, here = 0.0, before = 0.0, found = infinity;
  bool constant = true, in_turn = true;
  const Stretch* last = nullptr;
  // `last` is the newest place, with `here` extinction of all that are like it; `before` is the depth up to it.
  const auto settle = [&] {
    if (found < infinity || here == 0.0) return;
    found = last->distance_at((depth - before) / here);
    if (found == infinity) before += here * last->depth_to(infinity);
    here = 0.0;
  };
  for (const Stretch& s : stretches) {
    const double extinction = s.species->extinction[channel];
    if (extinction == 0.0) continue;
    constant = constant && s.rate == 0.0 && s.points == 0 && s.range.begin == 0.0 && s.range.end >= end;
    constant_rate += extinction * s.factor;
    if (!in_turn) continue;
    if (last == nullptr || !s.like(*last)) {
      in_turn = last == nullptr || s.range.begin >= last->range.end;
      if (last != nullptr && in_turn) settle();
      last = &s;
    }
    here += extinction;
  }
  if (constant) {
    const double t = depth / constant_rate;
    return t < end ? t : infinity;
  }
  if (last == nullptr) return infinity;
  if (in_turn) {
    settle();
    return found < end ? found : infinity;
  }
  double high = infinity;
  for (const Stretch& s : stretches) {
    // Alone it gets there no earlier than all together.
    const double extinction = s.species->extinction[channel];
    if (extinction > 0.0) high = std::min(high, s.distance_at(depth / extinction));
  }
  high = std::min(high, end);
  const auto depth_at = [&](double t) {
    double sum = 0.0;
    for (const Stretch& s : stretches) {
      if (s.species->extinction[channel] > 0.0) sum += s.species->extinction[channel] * s.depth_to(t);
    }
    return sum;
  };
  if (high == infinity) {  // no species suffices alone over its unbounded range
    if (depth_at(infinity) <= depth) return infinity;
    for (high = 1.0; depth_at(high) < depth && high < 1e300;) high *= 2.0;
  } else if (high == end && depth_at(end) <= depth) {
    return infinity;
  }
  double low = 0.0, t = 0.5 * high;
  for (int step = 0; step < 200 && high - low > 1e-15 * high; ++step) {
    const double excess = depth_at(t) - depth, slope = extinction_at(stretches, t)[channel];
    if (std::fabs(excess) <= 1e-15 * depth) break;
    (excess < 0.0 ? low : high) = t;
    const double newton = slope > 0.0 ? t - excess / slope : low;
    t = newton > low && newton < high ? newton : 0.5 * (low + high);
  }
  return t;
}

/// What a free flight ended with: where (t < end: a collision; infinity: it passed), and the throughput of that event.
struct Flight {
  double t;
  Spectrum weight;  // collision: f / density without the scattering coefficient [m]; passing: transmittance / chance of
                    // passing
};

/// The channel whose distances are sampled, for chances that sum to 1.
inline std::size_t chosen_channel(const Spectrum& chance, double xi) {
  std::size_t channel = 0;
  for (double c = chance[0]; channel + 1 < channel_count && xi >= c; c += chance[channel]) ++channel;
  return channel;
}

/// Samples a flight over [0, end] for a path of throughput beta (not all zero). One channel is picked in proportion to
/// beta and its distances are sampled; the result is weighted by the balance heuristic over all channels (Miller,
/// Georgiev and Jarosz 2019: spectral MIS), weight_c = T_c / sum_j P_j p_j. With P proportional to beta the sum over
/// channels of beta never grows in a flight, so a thin channel beside a thick one cannot explode. `forced` excludes
/// passing: the weight then has the chance of a collision in it.
inline Flight sample_flight(const std::vector<Stretch>& stretches, const Spectrum& beta, double end, bool forced,
                            double xi_channel, double xi_depth) {
  Spectrum through;
  Spectrum chance = beta / sum(beta);
  double collides = 1.0;
  if (forced) {
    through = transmittance(stretches, end);
    chance = chance * (Spectrum::grey(1.0) - through);
    collides = sum(chance);
    if (!(collides > 0.0)) return {infinity, {}};
    chance = chance / collides;
  }
  const std::size_t channel = chosen_channel(chance, xi_channel);
  const double spent = forced ? xi_depth * (1.0 - through[channel]) : xi_depth;
  const double t = distance_at_depth(stretches, channel, -std::log1p(-spent), end);
  if (t < end) {
    const Spectrum extinction = extinction_at(stretches, t), survived = transmittance(stretches, t);
    double density = 0.0;
    for (std::size_t c = 0; c < channel_count; ++c) {
      if (chance[c] > 0.0) density += chance[c] * extinction[c] * survived[c] / (forced ? 1.0 - through[c] : 1.0);
    }
    return density > 0.0 ? Flight{t, survived / density} : Flight{infinity, {}};
  }
  if (forced) return {infinity, {}};  // rounding put the collision on the very end
  through = transmittance(stretches, end);
  const double passes = sum(chance * through);
  return {infinity, passes > 0.0 ? through / passes : Spectrum{}};
}

}  // namespace tyndall
