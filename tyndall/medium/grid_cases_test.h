#pragma once
// Grids of voxels for tests.
#include <utility>

#include "tyndall/medium/profile.h"
#include "tyndall/sampling/random_stream.h"

namespace tyndall::tests {

/// Voxels from low to high with the numbers value(i, j, k) from 0 to 1, put where the steps say.
template <class Value>
GridProfile grid_of(const BrickGrid::Index& low, const BrickGrid::Index& high, const Vector& origin, const Vector& x,
                    const Vector& y, const Vector& z, Value&& value) {
  BrickGridMaker maker(low, high, 1.0);
  for (int k = low[2]; k <= high[2]; ++k) {
    for (int j = low[1]; j <= high[1]; ++j) {
      for (int i = low[0]; i <= high[0]; ++i) maker.set({i, j, k}, value(i, j, k));
    }
  }
  GridProfile profile;
  profile.file = file_of(maker.finish(origin, x, y, z));
  return profile;
}

/// A lump of random numbers around the origin with holes in it, some 2 m across, its axes askew.
inline GridProfile ragged_grid(bool askew) {
  const auto value = [](int i, int j, int k) {
    RandomStream random(99, static_cast<std::uint64_t>((i + 50) + 128 * ((j + 50) + 128 * (k + 50))), 0);
    const double hole = random.next(), x = random.next();
    const bool gone = (i >= 0 && j >= 0) || (i / 8 + j / 8 + k / 8) % 3 == 0;
    return gone && hole < 0.9 ? 0.0 : x;
  };
  const Vector x = askew ? Vector{0.08, 0.02, 0.01} : Vector{0.1, 0.0, 0.0},
               y = askew ? Vector{-0.03, 0.09, 0.0} : Vector{0.0, 0.08, 0.0},
               z = askew ? Vector{0.0, 0.03, -0.07} : Vector{0.0, 0.0, 0.09};
  return grid_of({-13, -11, -9}, {10, 12, 14}, {0.03, -0.05, 0.02}, x, y, z, value);
}

}  // namespace tyndall::tests
