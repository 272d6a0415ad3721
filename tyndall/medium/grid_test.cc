// Species of voxels: sums, places and units, and the homogeneous media that they are where their voxels are all alike.
#include <gtest/gtest.h>

#include <numbers>

#include "tyndall/medium/free_flight.h"
#include "tyndall/medium/grid_cases_test.h"

namespace tyndall {
namespace {

using tests::grid_of;
using tests::ragged_grid;

Species species_of(std::vector<Profile> profiles, double extinction = 1.0) {
  Species s;
  s.scattering = Spectrum::grey(extinction);
  s.profiles = std::move(profiles);
  return s;
}

Ray some_ray(RandomStream& random) {
  const double z = 2.0 * random.next() - 1.0, phi = 2.0 * std::numbers::pi * random.next(), r = std::sqrt(1.0 - z * z);
  const Vector way{r * std::cos(phi), z, r * std::sin(phi)};
  const Vector through{random.next() - 0.5, random.next() - 0.5, random.next() - 0.5};
  return {through - way * 3.0, way};
}

double depth(const Medium& medium, const Ray& ray, double end = 6.0) {
  std::vector<Stretch> stretches;
  const LoweredMedium lowered = lower(medium);
  stretches_along(lowered, ray, end, stretches);
  return optical_depth(stretches, end)[0];
}

TEST(Grid, EvenVoxelsAreAHomogeneousBox) {
  const GridProfile even = grid_of({0, 0, 0}, {20, 20, 20}, {-1, -1, -1}, {0.1, 0, 0}, {0, 0.1, 0}, {0, 0, 0.1},
                                   [](int, int, int) { return 0.75; });
  const BoxProfile box{{-0.97, -0.9, -0.8}, {0.93, 0.9, 0.6}};
  RandomStream random(1, 0, 0);
  for (int i = 0; i < 200; ++i) {
    const Ray ray = some_ray(random);
    const double wanted = 0.75 * depth(Medium{{species_of({box}, 3.0)}}, ray);
    EXPECT_NEAR(depth(Medium{{species_of({even, box}, 3.0)}}, ray), wanted, 1e-12);
  }
}

TEST(Grid, TwoHalvesAddToTheWhole) {
  const auto value = [](int i, int j, int k) { return ((i * 7 + j * 5 + k * 3) % 11) / 11.0; };
  const auto part = [&](int first, int last) {
    return grid_of({-9, -9, -9}, {9, 9, 9}, {}, {0.1, 0, 0}, {0, 0.1, 0}, {0, 0, 0.1},
                   [&](int i, int j, int k) { return i >= first && i <= last ? value(i, j, k) : 0.0; });
  };
  const Medium whole{{species_of({part(-9, 9)}, 2.0)}};
  const Medium halves{{species_of({part(-9, 1)}, 2.0), species_of({part(2, 9)}, 2.0)}};
  RandomStream random(2, 0, 0);
  for (int i = 0; i < 200; ++i) {
    const Ray ray = some_ray(random);
    EXPECT_NEAR(depth(whole, ray), depth(halves, ray), 1e-12);
    const LoweredMedium lowered = lower(whole), lowered_halves = lower(halves);
    std::vector<Stretch> one, two;
    stretches_along(lowered, ray, 6.0, one);
    stretches_along(lowered_halves, ray, 6.0, two);
    const double some = 0.9 * random.next() * depth(whole, ray);
    if (!(some > 0.0)) continue;
    EXPECT_NEAR(distance_at_depth(one, 0, some, 6.0), distance_at_depth(two, 0, some, 6.0), 1e-9);
  }
}

/// Size and position put the same voxels where other steps and another origin do; a scale is an extinction.
TEST(Grid, SizePositionAndScaleMeanWhatTheySay) {
  GridProfile small = ragged_grid(true), moved = small;
  moved.size = 1000.0;
  moved.position = {30.0, -20.0, 10.0};
  moved.scale = 0.5;
  RandomStream random(3, 0, 0);
  for (int i = 0; i < 100; ++i) {
    const Ray ray = some_ray(random), large{ray.origin * 1000.0 + moved.position, ray.direction};
    const double here = depth(Medium{{species_of({small}, 2.0)}}, ray);
    EXPECT_NEAR(depth(Medium{{species_of({moved}, 0.004)}}, large, 6000.0), here, 1e-9 * (1.0 + here));
    const Vector p = ray.at(3.0);
    EXPECT_NEAR(factor(moved, p * 1000.0 + moved.position), 0.5 * factor(small, p), 1e-9);
  }
}

TEST(Grid, ExtinctionIsNowhereMoreThanItsBricksSay) {
  RandomStream random(4, 0, 0);
  for (const bool askew : {false, true}) {
    const GridProfile grid = ragged_grid(askew);
    const LoweredMedium lowered = lower(Medium{{species_of({grid})}});
    std::vector<Stretch> stretches;
    std::size_t crossed = 0, cells = 0;
    for (int i = 0; i < 200; ++i) {
      const Ray ray = some_ray(random);
      stretches_along(lowered, ray, 6.0, stretches);
      double reached = 0.0;
      for (const Stretch& s : stretches) {
        ASSERT_GE(s.range.begin, reached);  // one after the other
        reached = s.range.end;
        ASSERT_GT(s.factor, -1e-18);
        ++cells;
      }
      crossed += stretches.empty() ? 0 : 1;
    }
    EXPECT_GT(crossed, 150U);
    EXPECT_GT(cells, 20 * crossed);
  }
}

TEST(Grid, HardPlacesAreAnsweredWithNumbers) {
  const GridProfile grid = ragged_grid(true);
  std::vector<Stretch> stretches;
  for (const double size : {1e-9, 1e-3, 1.0, 1e9}) {
    for (const double away : {0.0, 1.0, 1e9}) {
      GridProfile placed = grid;
      placed.size = size;
      placed.position = {away, 0, 0};
      for (const Vector& way : {Vector{1, 0, 0}, Vector{0, 1, 0}, normalized({1, 1e-9, 1e-12})}) {
        const LoweredMedium lowered = lower(Medium{{species_of({placed}, 1.0 / size)}});
        stretches_along(lowered, {{away - 3.0 * size, 0, 0}, way}, infinity, stretches);
        ASSERT_LT(stretches.size(), 1000U);
        const double all = optical_depth(stretches, infinity)[0];
        ASSERT_TRUE(all >= 0.0 && all < 10.0) << size << ' ' << away << ' ' << all;
        if (all > 1e-6) {
          ASSERT_TRUE(std::isfinite(distance_at_depth(stretches, 0, 0.5 * all, infinity)));
        }
      }
    }
  }
  GridProfile none = grid;
  none.scale = 0.0;
  EXPECT_TRUE(lower(Medium{{species_of({none})}}).species.empty());
  EXPECT_TRUE(lower(Medium{{species_of({GridProfile{}})}}).species.empty());
  none.scale = 1.0;
  none.size = 1e-200;
  EXPECT_TRUE(lower(Medium{{species_of({none})}}).species.empty());
}

}  // namespace
}  // namespace tyndall
