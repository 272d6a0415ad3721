#pragma once
// Flights through grids by null collisions: air is filled up, brick by brick, to the greatest density there, and of the
// collisions in that only the part counts that real air would have had (Woodcock et al. 1965; bricks: Szirmay-Kalos et
// al. 2011). A flight then looks a few voxels up where an exact one walks all cells of its way. What it does not know
// is the transmittance; in grids that are as thick in all channels none is needed.
#include "tyndall/medium/free_flight.h"
#include "tyndall/sampling/quick_random.h"

namespace tyndall {

/// Extinction of the species of one place, if null collisions serve there, else 0: they are a grid and nothing else,
/// equally thick in all channels, and no brick of it is so dense that a ray through its thin parts would count hundreds
/// of collisions that are none.
inline double null_extinction(std::span<const LoweredSpecies> together) {
  constexpr double most_collisions = 100.0;
  const LoweredSpecies& s = together.front();
  if (!s.form.only_a_grid() || s.decay != 0.0) return 0.0;
  double total = 0.0;
  for (const LoweredSpecies& one : together) {
    if (one.extinction != Spectrum::grey(one.extinction[0])) return 0.0;
    total += one.extinction[0];
  }
  return total * s.form.grids[0].brick < most_collisions ? total : 0.0;
}

/// The t of the first collision within a part of a ray with a grid that has `extinction` [1/m] where its factor is 1;
/// infinity where there is none.
inline double first_collision(const PlacedGrid& placed, const Ray& ray, const Interval& within, double extinction,
                              QuickRandom& random) {
  const BrickGrid& grid = *placed.grid;
  const Vector origin = placed.voxels(ray.origin), way = placed.voxels_along(ray.direction);
  const auto corner = [](const BrickGrid::Index& i) {
    return Vector{static_cast<double>(i[0]), static_cast<double>(i[1]), static_cast<double>(i[2])};
  };
  const Interval range = intersection(within, inside(Box{corner(grid.low), corner(grid.high)}, {origin, way}));
  if (range.empty() || !is_finite(origin) || !(range.end < infinity)) return infinity;
  double t = range.begin;
  BrickGrid::Index brick{}, sign{};
  std::array<double, 3> leaves{}, stride{};  // t at which the brick ends, by axis, and from one such to the next
  for (std::size_t a = 0; a < 3; ++a) {
    const double from = origin[static_cast<int>(a)], d = way[static_cast<int>(a)];
    const double at = std::clamp(std::floor(from + d * t), static_cast<double>(grid.low[a]), grid.high[a] - 1.0);
    brick[a] = static_cast<int>(at) >> 3;
    sign[a] = d > 1e-300 ? 1 : d < -1e-300 ? -1 : 0;
    stride[a] = sign[a] != 0 ? BrickGrid::edge / std::fabs(d) : infinity;
    leaves[a] = sign[a] != 0 ? (BrickGrid::edge * (brick[a] + (sign[a] > 0 ? 1 : 0)) - from) / d : infinity;
  }
  double depth = -std::log1p(-random.next());  // to go to the next collision of the filled air
  for (;;) {
    const std::size_t across =
        leaves[0] < leaves[1] ? (leaves[0] < leaves[2] ? 0 : 2) : (leaves[1] < leaves[2] ? 1 : 2);
    const double leave = std::max(t, std::min(leaves[across], range.end));
    const double filled = static_cast<double>(grid.greatest[grid.number_of_brick(brick)]) * placed.scale * extinction;
    if (filled > 0.0) {
      const std::uint16_t* const voxels = grid.voxels_of(brick);
      while (depth < filled * (leave - t)) {
        t += depth / filled;
        const double real = placed.scale * extinction * grid.at(origin + way * t, brick, voxels);
        if (random.next() * filled < real) return t;
        depth = -std::log1p(-random.next());
      }
      depth -= filled * (leave - t);
    }
    if (!(leave < range.end)) return infinity;
    t = leave;
    brick[across] += sign[across];
    if (brick[across] < 0 || brick[across] >= grid.bricks[across]) return infinity;
    leaves[across] += stride[across];
  }
}

/// sample_flight for walks that do not care for what lies beyond their collision: not forced, and by null collisions in
/// the grids that null_extinction names. Sets `stretches` to what there is of the other species and, at a collision,
/// of the grids there. Both kinds race; as those of the grids have one transmittance in all channels, it cancels in the
/// weight T_c / sum_j P_j p_j.
inline Flight sample_null_flight(const LoweredMedium& medium, const Ray& ray, double end, const Spectrum& beta,
                                 double xi_channel, double xi_depth, QuickRandom random,
                                 std::vector<Stretch>& stretches) {
  stretches.clear();
  const double enough = -std::log1p(-xi_depth);
  for_each_place(medium, [&](std::span<const LoweredSpecies> together) {
    if (null_extinction(together) == 0.0) add_stretches(together, ray, end, stretches, enough);
  });
  const Spectrum chance = beta / sum(beta);
  double t = infinity;
  if (!stretches.empty()) t = distance_at_depth(stretches, chosen_channel(chance, xi_channel), enough, end);
  for_each_place(medium, [&](std::span<const LoweredSpecies> together) {
    const double extinction = null_extinction(together);
    if (extinction == 0.0) return;
    const Interval range = range_of(together.front(), ray, std::min(end, t));
    if (range.empty()) return;
    t = std::min(t, first_collision(together.front().form.grids[0], ray, range, extinction, random));
  });
  const Spectrum survived = transmittance(stretches, std::min(t, end));
  if (!(t < end)) {
    const double passes = sum(chance * survived);
    return {infinity, passes > 0.0 ? survived / passes : Spectrum{}};
  }
  for_each_place(medium, [&](std::span<const LoweredSpecies> together) {
    if (null_extinction(together) == 0.0) return;
    const Interval range = range_of(together.front(), ray, infinity);
    if (!(t >= range.begin && t <= range.end)) return;
    const double factor = together.front().form.grids[0].at(ray.at(t));
    const Interval here{t, t + std::max(1e-300, 1e-12 * t)};
    for (const LoweredSpecies& one : together) stretches.push_back(Stretch(one, here, factor, 0.0, std::log(factor)));
  });
  const double density = sum(chance * extinction_at(stretches, t) * survived);
  return density > 0.0 ? Flight{t, survived / density} : Flight{infinity, {}};
}

}  // namespace tyndall
