#pragma once
// Smooth lattice noise of mean 1 with known bounds, the same on every machine.
//
// Octave k has a lattice of cells scale / 2^k across. Every lattice point has a value v = w (3 - w^2) / 2 with
// w = (2 h + 1) / 2^32 - 1, h a 32-bit integer hash of its three indices (modulo 2^32), the octave and the seed. v is
// odd in w and lies strictly between -1 and 1; the cubic spreads it toward the ends. Inside a cell values are
// interpolated by the smoothstep in x, y and z: continuous with its gradient, and along a ray a polynomial of degree 9.
//
//   noise(p) = 1 + contrast sum_k 2^-k value_k(p) / sum_k 2^-k
//
// Bounds: 1 - contrast < noise < 1 + contrast (both 1 for contrast 0). Mean: the hash is a chain of bijections of
// 32-bit integers, so that along x every h, hence every v and its opposite, comes exactly once in 2^32 cells: the mean
// over that period is exactly 1. Over a region of N cells of the largest octave it differs from 1 by about 0.3 contrast
// / sqrt(N). Only integer arithmetic and + - * / of doubles: no function of a mathematical library.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "tyndall/geometry/vector.h"

namespace tyndall {

/// What noise depends on. scale > 0 [m], 1 <= octaves <= 8, 0 <= contrast <= 1.
struct NoiseSettings {
  double scale = 1.0;
  int octaves = 1;
  double contrast = 0.0;
  int seed = 0;
};

inline constexpr int most_octaves = 8;

/// A bijection of 32-bit integers that leaves no visible order (Wellons 2018, "lowbias32").
constexpr std::uint32_t scrambled(std::uint32_t x) {
  x ^= x >> 16;
  x *= 0x7FEB352Du;
  x ^= x >> 15;
  x *= 0x846CA68Bu;
  return x ^ (x >> 16);
}

/// The value of a lattice point, in (-1, 1), from the number of its row (rows run along x).
constexpr double lattice_value(std::uint32_t x, std::uint32_t row) {
  const double w = (2.0 * scrambled(x + row) + 1.0) * 0x1p-32 - 1.0;
  return 0.5 * w * (3.0 - w * w);
}
constexpr std::uint32_t lattice_row(std::uint32_t y, std::uint32_t z, std::uint32_t octave, std::uint32_t seed) {
  return scrambled(y + scrambled(z + scrambled(octave + scrambled(seed))));
}

/// The index of the cell that holds a coordinate counted in cells, modulo 2^32. Beyond 2^53 cells, where doubles skip
/// lattice points, the pattern is no longer resolved but stays defined.
inline std::uint32_t cell_index(double floored) {
  const double period = 4294967296.0;
  const double wrapped = floored - period * std::floor(floored / period);
  return wrapped >= 0.0 && wrapped < period ? static_cast<std::uint32_t>(wrapped) : 0u;
}

/// One octave in one cell: the values of its corners, (x, y, z) at index x + 2 y + 4 z.
struct NoiseCell {
  Vector corner;  // counted in cells
  std::array<double, 8> value;

  /// The cell of `octave` that holds the point p, counted in cells of that octave.
  static NoiseCell around(const Vector& p, int octave, int seed) {
    NoiseCell cell{{std::floor(p.x), std::floor(p.y), std::floor(p.z)}, {}};
    const std::uint32_t x = cell_index(cell.corner.x), y = cell_index(cell.corner.y), z = cell_index(cell.corner.z);
    for (std::uint32_t i = 0; i < 4; ++i) {
      const std::uint32_t row =
          lattice_row(y + (i & 1u), z + (i >> 1), static_cast<std::uint32_t>(octave), static_cast<std::uint32_t>(seed));
      cell.value[2 * i] = lattice_value(x, row);
      cell.value[2 * i + 1] = lattice_value(x + 1u, row);
    }
    return cell;
  }

  /// The interpolated value, in (-1, 1); p is counted in cells and inside the cell but for rounding.
  double at(const Vector& p) const {
    const auto weight = [](double x) {
      const double c = std::clamp(x, 0.0, 1.0);
      return c * c * (3.0 - 2.0 * c);
    };
    const double x = weight(p.x - corner.x), y = weight(p.y - corner.y), z = weight(p.z - corner.z);
    const auto along_x = [&](std::size_t i) { return value[i] + (value[i + 1] - value[i]) * x; };
    const double near = along_x(0) + (along_x(2) - along_x(0)) * y, far = along_x(4) + (along_x(6) - along_x(4)) * y;
    return near + (far - near) * z;
  }
};

/// Share of octave k in the sum: 2^-k / sum_k 2^-k.
constexpr double octave_share(int octave, int octaves) {
  return static_cast<double>(1 << (octaves - 1 - octave)) / static_cast<double>((1 << octaves) - 1);
}

/// The noise at a point [m]. Coordinates whose number of cells is not finite are taken as the mean.
inline double noise_factor(const NoiseSettings& noise, const Vector& p) {
  if (noise.contrast == 0.0) return 1.0;
  double sum = 0.0;
  for (int k = 0; k < noise.octaves; ++k) {
    const Vector cells = p / noise.scale * static_cast<double>(1 << k);
    if (!is_finite(cells)) break;
    sum += octave_share(k, noise.octaves) * NoiseCell::around(cells, k, noise.seed).at(cells);
  }
  return 1.0 + noise.contrast * sum;
}

}  // namespace tyndall
