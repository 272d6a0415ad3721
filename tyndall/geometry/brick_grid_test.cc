#include "tyndall/geometry/brick_grid.h"

#include <gtest/gtest.h>

#include <random>

namespace tyndall {
namespace {

struct Numbers {
  std::mt19937_64 engine{5};
  double next() { return static_cast<double>(engine() >> 11) * 0x1p-53; }
  int below(int n) { return static_cast<int>(next() * n); }
};

TEST(Half, IsTheNearestOfAllHalves) {
  for (int bits = 0x0400; bits < 0x7BFF; ++bits) {
    const auto half = static_cast<std::uint16_t>(bits);
    const double here = static_cast<double>(number_of(half)),
                 next = static_cast<double>(number_of(static_cast<std::uint16_t>(bits + 1)));
    ASSERT_EQ(here, std::ldexp(1.0 + (bits & 1023) / 1024.0, (bits >> 10) - 15));
    ASSERT_EQ(half_of(here), half);
    ASSERT_EQ(half_of(here + 0.49 * (next - here)), half);
    ASSERT_EQ(half_of(here + 0.51 * (next - here)), half + 1);
    ASSERT_TRUE(is_plain_half(half));
  }
  EXPECT_EQ(half_of(0.0), 0);
  EXPECT_EQ(number_of(0), 0.0F);
  EXPECT_EQ(half_of(0.4 * least_half), 0);
  EXPECT_EQ(static_cast<double>(number_of(half_of(0.6 * least_half))), least_half);
  EXPECT_FALSE(is_plain_half(0x0001) || is_plain_half(0x7C00) || is_plain_half(0x8000));
}

/// Random voxels, most bricks empty, and the same as a plain array.
struct Made {
  BrickGrid::Index low{-21, 3, -2}, high{30, 19, 25};
  std::vector<double> plain;
  BrickGrid grid;

  double& at(int i, int j, int k) {
    const int nx = high[0] - low[0] + 1, ny = high[1] - low[1] + 1;
    return plain[static_cast<std::size_t>((i - low[0]) + nx * ((j - low[1]) + ny * (k - low[2])))];
  }
  double get(int i, int j, int k) {
    const bool in = i >= low[0] && i <= high[0] && j >= low[1] && j <= high[1] && k >= low[2] && k <= high[2];
    return in ? at(i, j, k) : 0.0;
  }

  explicit Made(Numbers& random) : plain(52 * 17 * 28) {
    BrickGridMaker maker(low, high, 3.0);
    for (int n = 0; n < 9; ++n) {
      const int i0 = low[0] + random.below(44), j0 = low[1] + random.below(10), k0 = low[2] + random.below(20);
      for (int m = 0; m < 60; ++m) {
        const int i = i0 + random.below(8), j = j0 + random.below(7), k = k0 + random.below(8);
        at(i, j, k) = 3.0 * random.next();
        maker.set({i, j, k}, at(i, j, k));
      }
    }
    at(low[0], high[1], low[2]) = 3.0;  // a corner
    maker.set({low[0], high[1], low[2]}, 3.0);
    grid = maker.finish({}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1});
  }
};

TEST(BrickGrid, HoldsWhatWasPutIntoItToElevenBits) {
  Numbers random;
  Made made(random);
  ASSERT_LT(made.grid.blocks(), made.grid.block.size() / 2);  // bricks of zeros take no voxels
  for (int k = made.low[2] - 9; k <= made.high[2] + 9; ++k) {
    for (int j = made.low[1] - 9; j <= made.high[1] + 9; ++j) {
      for (int i = made.low[0] - 9; i <= made.high[0] + 9; ++i) {
        const Vector p =
            Vector{static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)} - made.grid.origin;
        const double x = made.get(i, j, k);
        ASSERT_NEAR(made.grid.at(p), x, x / 2048.0 + 1e-8);
      }
    }
  }
}

TEST(BrickGrid, IsTrilinearBetweenVoxelsWithinAndAcrossBricks) {
  Numbers random;
  Made made(random);
  const BrickGrid& grid = made.grid;
  for (int n = 0; n < 100000; ++n) {
    Vector p{};
    double* const xyz[] = {&p.x, &p.y, &p.z};
    for (std::size_t a = 0; a < 3; ++a) *xyz[a] = -2.0 + random.next() * (8.0 * grid.bricks[a] + 4.0);
    double wanted = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
      Vector at{std::floor(p.x) + (corner & 1), std::floor(p.y) + (corner >> 1 & 1), std::floor(p.z) + (corner >> 2)};
      const Vector far{1.0 - std::fabs(p.x - at.x), 1.0 - std::fabs(p.y - at.y), 1.0 - std::fabs(p.z - at.z)};
      wanted += far.x * far.y * far.z * grid.at(at);
    }
    ASSERT_NEAR(grid.at(p), wanted, 1e-14);
  }
  EXPECT_EQ(grid.at(Vector{1e300, 0, 0}), 0.0);
  EXPECT_EQ(grid.at(Vector{-3e9, 4, 4}), 0.0);
}

TEST(BrickGrid, BoundsOfABrickHoldEverywhereInItAndAreTight) {
  Numbers random;
  Made made(random);
  const BrickGrid& grid = made.grid;
  for (int n = 0; n < 300000; ++n) {
    Vector p{8.0 * grid.bricks[0] * random.next(), 8.0 * grid.bricks[1] * random.next(),
             8.0 * grid.bricks[2] * random.next()};
    if (n % 3 == 0) p = {std::floor(p.x), std::floor(p.y), std::floor(p.z)};  // where extremes are
    const auto check = [&](const BrickGrid::Index& brick, double x) {
      if (!grid.has_brick(brick)) return;
      const std::size_t b = grid.number_of_brick(brick);
      ASSERT_GE(x, static_cast<double>(grid.least[b]));
      ASSERT_LE(x, static_cast<double>(grid.greatest[b]));
    };
    const BrickGrid::Index cell = BrickGrid::cell_of(p);
    const double x = grid.at(p);
    check({cell[0] >> 3, cell[1] >> 3, cell[2] >> 3}, x);
    if (p.x == 8.0 * (cell[0] >> 3)) check({(cell[0] >> 3) - 1, cell[1] >> 3, cell[2] >> 3}, x);  // its face too
  }
  BrickGrid::Index brick{};
  for (brick[2] = 0; brick[2] < grid.bricks[2]; ++brick[2]) {
    for (brick[1] = 0; brick[1] < grid.bricks[1]; ++brick[1]) {
      for (brick[0] = 0; brick[0] < grid.bricks[0]; ++brick[0]) {
        double least = 1e9, greatest = 0.0;
        for (int n = 0; n < 729; ++n) {
          const double x = grid.voxel({8 * brick[0] + n % 9, 8 * brick[1] + n / 9 % 9, 8 * brick[2] + n / 81});
          least = std::min(least, x), greatest = std::max(greatest, x);
        }
        const std::size_t b = grid.number_of_brick(brick);
        ASSERT_NEAR(static_cast<double>(grid.least[b]), least, 1e-6 * least);
        ASSERT_NEAR(static_cast<double>(grid.greatest[b]), greatest, 1e-6 * greatest);
      }
    }
  }
}

TEST(BrickGrid, ThereIsNothingOutsideItsLowAndHigh) {
  Numbers random;
  Made made(random);
  const BrickGrid& grid = made.grid;
  bool touched = false;
  for (int n = 0; n < 100000; ++n) {
    const Vector p{-9.0 + random.next() * (8.0 * grid.bricks[0] + 18.0),
                   -9.0 + random.next() * (8.0 * grid.bricks[1] + 18.0),
                   -9.0 + random.next() * (8.0 * grid.bricks[2] + 18.0)};
    bool in = true;
    for (int a = 0; a < 3; ++a) {
      const auto k = static_cast<std::size_t>(a);
      in = in && p[a] >= grid.low[k] && p[a] <= grid.high[k];
    }
    if (!in) {
      ASSERT_EQ(grid.at(p), 0.0);
    }
    touched = touched || (in && grid.at(p) > 0.0);
  }
  EXPECT_TRUE(touched);
  const BrickGrid none = BrickGridMaker({0, 0, 0}, {5, 5, 5}, 1.0).finish({}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1});
  EXPECT_TRUE(none.nothing());
  EXPECT_EQ(none.low, none.high);
}

}  // namespace
}  // namespace tyndall
