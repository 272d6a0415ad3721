// Flights by null collisions against the exact depths that a walk through all cells gives.
#include "tyndall/medium/null_flight.h"

#include <gtest/gtest.h>

#include <random>

#include "tyndall/medium/grid_cases_test.h"
#include "tyndall/sampling/random_stream.h"

namespace tyndall {
namespace {

Species in_grid(const Spectrum& scattering, bool askew, const Vector& at) {
  Species s;
  s.scattering = scattering;
  GridProfile grid = tests::ragged_grid(askew);
  grid.scale = 1.5;
  grid.position = at;
  s.profiles = {grid};
  return s;
}

Ray random_ray(std::mt19937& random) {
  std::normal_distribution<double> normal;
  const Vector through{0.4 * normal(random), 0.4 * normal(random), 0.4 * normal(random)};
  const Vector direction = normalized({normal(random), normal(random), normal(random)});
  return {through - direction * 3.0, direction};
}

TEST(NullFlight, CollidesWhereAnExactFlightWould) {
  std::mt19937 random(1);
  const Medium medium{{in_grid(Spectrum::grey(4.0), true, {0, 0, 0})}};
  const LoweredMedium lowered = lower(medium);
  ASSERT_EQ(null_extinction(std::span(lowered.species)), 4.0);
  int told = 0;
  for (int k = 0; k < 12; ++k) {
    const Ray ray = random_ray(random);
    std::vector<Stretch> exact;
    stretches_along(lowered, ray, infinity, exact);
    const double clear = transmittance(exact, infinity)[0];
    if (clear > 0.9) continue;
    ++told;
    // Of uniform numbers 1 - T(t): Kolmogorov's distance from the uniform law over [0, 1 - T(infinity)].
    constexpr int flights = 20000;
    std::vector<double> depths;
    RandomStream stream(7, static_cast<std::uint64_t>(k), 0);
    for (int i = 0; i < flights; ++i) {
      const double seed = stream.next();
      QuickRandom quick(seed, stream.next());
      const double t = first_collision(lowered.species[0].form.grids[0], ray, {0.0, infinity}, 4.0, quick);
      if (t < infinity) depths.push_back(1.0 - transmittance(exact, t)[0]);
    }
    std::ranges::sort(depths);
    double distance = std::fabs(static_cast<double>(depths.size()) / flights - (1.0 - clear));
    for (std::size_t i = 0; i < depths.size(); ++i) {
      distance = std::max(distance, std::fabs((static_cast<double>(i) + 0.5) / flights - depths[i]));
    }
    // 2.2 / sqrt(n): false alarms 1.2e-4 a ray.
    EXPECT_LT(distance, 2.2 / std::sqrt(static_cast<double>(flights))) << "ray " << k;
  }
  EXPECT_GE(told, 5);
}

TEST(NullFlight, WeightsAreThoseOfTransmittanceInColouredAirBesideTwoGrids) {
  // E[weight; passes] = T and E[weight extinction; collides] = 1 - T in every channel; and of a part of the way.
  std::mt19937 random(2);
  Species haze;
  haze.scattering = {{0.1, 0.25, 0.6}};
  haze.profiles = {ExponentialProfile{0.8, 0.0}};
  Species coloured = in_grid({{0.5, 1.0, 2.0}}, true, {0.3, 0.1, 0.2});
  const Medium medium{{in_grid(Spectrum::grey(0.8), true, {0, 0, 0}), haze,
                       in_grid(Spectrum::grey(0.5), false, {-0.2, 0.2, 0.4}), coloured}};
  const LoweredMedium lowered = lower(medium);
  for (int k = 0; k < 6; ++k) {
    const Ray ray = random_ray(random);
    constexpr double end = 4.0, part = 2.7;
    std::vector<Stretch> exact, scratch;
    stretches_along(lowered, ray, end, exact);
    const Spectrum through = transmittance(exact, end), through_part = transmittance(exact, part);
    const Spectrum beta{{0.2, 1.0, 0.5}};
    constexpr int flights = 100000;
    Spectrum passed, squares, collided, collided_squares, early, early_squares;
    RandomStream stream(8, static_cast<std::uint64_t>(k), 0);
    for (int i = 0; i < flights; ++i) {
      const double xi_channel = stream.next(), xi_depth = stream.next(), seed = stream.next();
      const Flight f =
          sample_null_flight(lowered, ray, end, beta, xi_channel, xi_depth, {seed, stream.next()}, scratch);
      if (!(f.t < end)) {
        passed += f.weight / flights;
        squares += f.weight * f.weight / flights;
        continue;
      }
      const Spectrum share = f.weight * extinction_at(scratch, f.t);
      // What is said of the place is what is there.
      const Spectrum there = extinction_at(exact, f.t), said = extinction_at(scratch, f.t);
      for (std::size_t c = 0; c < channel_count; ++c) ASSERT_NEAR(said[c], there[c], 1e-6 * there[c]);
      collided += share / flights;
      collided_squares += share * share / flights;
      if (!(f.t < part)) continue;
      early += share / flights;
      early_squares += share * share / flights;
    }
    for (std::size_t c = 0; c < channel_count; ++c) {
      const auto expect = [&](const Spectrum& mean, const Spectrum& square, double truth) {
        // 4.5 standard errors: false alarms 7e-6, 54 comparisons.
        EXPECT_NEAR(mean[c], truth, 4.5 * std::sqrt((square[c] - mean[c] * mean[c]) / flights) + 1e-9)
            << "ray " << k << " channel " << c;
      };
      expect(passed, squares, through[c]);
      expect(collided, collided_squares, 1.0 - through[c]);
      expect(early, early_squares, 1.0 - through_part[c]);
    }
  }
}

TEST(NullFlight, RaysBesideAndAlongPlanesAndFromFarAway) {
  const Medium medium{{in_grid(Spectrum::grey(5.0), false, {0, 0, 0})}};
  const LoweredMedium lowered = lower(medium);
  const PlacedGrid& grid = lowered.species[0].form.grids[0];
  QuickRandom quick(0.1, 0.2);
  EXPECT_EQ(first_collision(grid, {{50, 50, 50}, {0, 1, 0}}, {0.0, infinity}, 5.0, quick), infinity);
  for (const Vector& direction : {Vector{0, 0, 1}, {0, 1, 0}, {1, 0, 0}, {0, 0, -1}, {0, -1, 0}, {-1, 0, 0}}) {
    for (int i = 0; i < 200; ++i) {
      // On planes between voxels and bricks.
      const Vector through{0.03 + 0.1 * (i % 20 - 10), -0.05 + 0.08 * (i % 13 - 6), 0.02 + 0.09 * (i % 17 - 8)};
      const double t = first_collision(grid, {through - direction * 5.0, direction}, {0.0, infinity}, 5.0, quick);
      if (!(t < infinity)) continue;
      EXPECT_GT(grid.at(through + direction * (t - 5.0)), 0.0);
    }
  }
  for (const double far : {1e6, 1e12, 1e300}) {
    const double t = first_collision(grid, {{-0.3, -0.2, -far}, {0, 0, 1}}, {0.0, infinity}, 5.0, quick);
    EXPECT_TRUE(t == infinity || std::fabs(t - far) < 1e-9 * far + 4.0);
  }
}

TEST(NullFlight, AreLeftToGridsThatSuitThem) {
  const auto extinction = [](const Species& s) {
    const LoweredMedium lowered = lower(Medium{{s}});
    return null_extinction(lowered.species);
  };
  EXPECT_EQ(extinction(in_grid(Spectrum::grey(2.0), false, {})), 2.0);
  EXPECT_EQ(extinction(in_grid({{1.0, 2.0, 2.0}}, false, {})), 0.0) << "coloured";
  EXPECT_EQ(extinction(in_grid(Spectrum::grey(1e6), false, {})), 0.0) << "millions of collisions that are none";
  Species thinning = in_grid(Spectrum::grey(2.0), false, {});
  thinning.profiles.push_back(ExponentialProfile{1.0, 0.0});
  EXPECT_EQ(extinction(thinning), 0.0);
}

}  // namespace
}  // namespace tyndall
