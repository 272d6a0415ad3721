#pragma once
// Numbers on a lattice of voxels, trilinear in between: bricks of 8^3 halves, of which only those that hold something
// are kept, in a coarse grid of bricks that knows the bounds of each.
//
// Positions are counted in voxels: voxel (i, j, k) stands at the point (i, j, k), not in the middle of anything. Cell
// (i, j, k) reaches from there to (i + 1, j + 1, k + 1), and brick b has the cells [8 b, 8 b + 7] along each axis: a
// number in it is made of the voxels 8 b to 8 b + 8. Outside all voxels stand zeros.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "tyndall/geometry/vector.h"
#include "tyndall/number/digest.h"
#include "tyndall/number/grid_file.h"
#include "tyndall/number/half.h"

namespace tyndall {

struct BrickGrid {
  static constexpr int edge = 8;            // voxels of a brick along an axis
  static constexpr std::size_t size = 512;  // voxels of a brick
  static constexpr std::uint32_t empty = std::numeric_limits<std::uint32_t>::max();
  using Index = std::array<int, 3>;
  using Corners = std::array<double, 8>;  // of a cell, (x, y, z) at index x + 2 y + 4 z

  Index bricks{};                      // how many along each axis
  double unit = 1.0;                   // what a stored number is multiplied by
  std::vector<std::uint32_t> block;    // of a brick (x fastest), its place among the blocks of voxels, or empty
  std::vector<std::uint16_t> voxels;   // block by block, in each x fastest
  std::vector<float> least, greatest;  // of a brick: bounds of the numbers in its closed cells, rounded outwards
  Index low{}, high{};                 // from here to here are the cells that are not all zero; low < high, or nothing
  Vector origin, step[3];              // where voxel (0, 0, 0) stands in the grid's own space, and the way to the next

  bool nothing() const { return voxels.empty(); }
  std::size_t blocks() const { return voxels.size() / size; }

  bool has_brick(const Index& brick) const {
    for (std::size_t a = 0; a < 3; ++a) {
      if (brick[a] < 0 || brick[a] >= bricks[a]) return false;
    }
    return true;
  }
  std::size_t number_of_brick(const Index& brick) const {
    return static_cast<std::size_t>(brick[0]) +
           static_cast<std::size_t>(bricks[0]) *
               (static_cast<std::size_t>(brick[1]) +
                static_cast<std::size_t>(bricks[1]) * static_cast<std::size_t>(brick[2]));
  }

  /// The number at a voxel.
  double voxel(const Index& index) const {
    const Index brick{index[0] >> 3, index[1] >> 3, index[2] >> 3};
    if (!has_brick(brick)) return 0.0;
    const std::uint32_t b = block[number_of_brick(brick)];
    if (b == empty) return 0.0;
    return unit * static_cast<double>(number_of(voxels[b * size + place_in_brick(index)]));
  }

  /// The voxels of a brick; none where all are 0.
  const std::uint16_t* voxels_of(const Index& brick) const {
    const std::uint32_t b = has_brick(brick) ? block[number_of_brick(brick)] : empty;
    return b == empty ? nullptr : &voxels[b * size];
  }

  /// Whether all corners of a cell lie in its own brick.
  static bool within_brick(const Index& cell) { return (cell[0] & 7) < 7 && (cell[1] & 7) < 7 && (cell[2] & 7) < 7; }

  /// The numbers at the corners of such a cell, from the voxels of its brick.
  Corners corners(const std::uint16_t* brick, const Index& cell) const {
    const std::uint16_t* const first = brick + place_in_brick(cell);
    const std::array<const std::uint16_t*, 4> rows{first, first + 8, first + 64, first + 72};
    std::array<float, 8> read;
    for (std::size_t i = 0; i < 4; ++i) {
      read[2 * i] = number_of(rows[i][0]);
      read[2 * i + 1] = number_of(rows[i][1]);
    }
    Corners out;
    for (std::size_t i = 0; i < 8; ++i) out[i] = unit * static_cast<double>(read[i]);
    return out;
  }

  /// The numbers at the corners of a cell.
  Corners corners(const Index& cell) const {
    static constexpr std::array<std::uint16_t, size> zeros{};
    // Of up to eight bricks, a cell's own and its neighbours above: along an axis the second voxel lies in the next if
    // the first is its brick's last.
    std::array<const std::uint16_t*, 8> in{};
    std::array<std::size_t, 3> at{}, on{};  // in the block: of the first voxel, and from it to the second
    unsigned across = 0;
    for (std::size_t a = 0; a < 3; ++a) {
      const auto local = static_cast<std::size_t>(cell[a] & 7);
      at[a] = local << (3 * a);
      on[a] = std::size_t{1} << (3 * a);
      if (local == 7) across |= 1U << a, on[a] = -at[a];
    }
    for (unsigned i = 0; i < 8; ++i) {
      if ((i & ~across) != 0) {
        in[i] = in[i & across];
        continue;
      }
      const Index brick{(cell[0] >> 3) + static_cast<int>(i & 1), (cell[1] >> 3) + static_cast<int>(i >> 1 & 1),
                        (cell[2] >> 3) + static_cast<int>(i >> 2)};
      const std::uint16_t* const there = voxels_of(brick);
      in[i] = there != nullptr ? there : zeros.data();
    }
    const std::size_t first = at[0] + at[1] + at[2];
    Corners out;
    for (std::size_t i = 0; i < 8; ++i) {
      const std::size_t voxel = first + (i & 1) * on[0] + (i >> 1 & 1) * on[1] + (i >> 2) * on[2];
      out[i] = unit * static_cast<double>(number_of(in[i][voxel]));
    }
    return out;
  }

  /// The cell that holds a point, and one far outside for what is too far to be counted.
  static Index cell_of(const Vector& p) {
    Index cell{};
    for (int a = 0; a < 3; ++a) {
      const double floored = std::floor(p[a]);
      cell[static_cast<std::size_t>(a)] = floored > -1e9 && floored < 1e9 ? static_cast<int>(floored) : -1000000000;
    }
    return cell;
  }

  /// What stands at a point of a cell, between its corners.
  static double between(const Corners& c, const Index& cell, const Vector& p) {
    const auto share = [&](int a) {
      return std::clamp(p[a] - static_cast<double>(cell[static_cast<std::size_t>(a)]), 0.0, 1.0);
    };
    const double x = share(0), y = share(1), z = share(2);
    const auto along_x = [&](std::size_t i) { return c[i] * (1.0 - x) + c[i + 1] * x; };
    const double near = along_x(0) * (1.0 - y) + along_x(2) * y, far = along_x(4) * (1.0 - y) + along_x(6) * y;
    return near * (1.0 - z) + far * z;
  }

  /// What stands at a point.
  double at(const Vector& p) const {
    const Index cell = cell_of(p);
    return between(corners(cell), cell, p);
  }

  /// What stands at a point of a brick (clamped into it), given the brick's voxels.
  double at(const Vector& p, const Index& brick, const std::uint16_t* own) const {
    Index cell = cell_of(p);
    for (std::size_t a = 0; a < 3; ++a) cell[a] = std::clamp(cell[a], edge * brick[a], edge * brick[a] + edge - 1);
    const bool within = within_brick(cell);
    if (within && own == nullptr) return 0.0;
    return between(within ? corners(own, cell) : corners(cell), cell, p);
  }

  /// Fills `least`, `greatest`, `low` and `high` from the voxels.
  void find_bounds() {
    least.assign(block.size(), 0.0F);
    greatest.assign(block.size(), 0.0F);
    low = {std::numeric_limits<int>::max(), std::numeric_limits<int>::max(), std::numeric_limits<int>::max()};
    high = {std::numeric_limits<int>::min(), std::numeric_limits<int>::min(), std::numeric_limits<int>::min()};
    Index brick{};
    for (brick[2] = 0; brick[2] < bricks[2]; ++brick[2]) {
      for (brick[1] = 0; brick[1] < bricks[1]; ++brick[1]) {
        for (brick[0] = 0; brick[0] < bricks[0]; ++brick[0]) find_bounds(brick);
      }
    }
    if (low[0] > high[0]) low = high = {};
  }

 private:
  static std::size_t place_in_brick(const Index& voxel) {
    return static_cast<std::size_t>((voxel[0] & 7) | (voxel[1] & 7) << 3 | (voxel[2] & 7) << 6);
  }

  /// Bounds of one brick, in which its neighbours above have their first voxels.
  void find_bounds(const Index& brick) {
    const std::size_t n = number_of_brick(brick);
    std::array<std::uint16_t, 2> range{std::numeric_limits<std::uint16_t>::max(),
                                       0};  // halves are in their bits' order
    for (int i = 0; i < 8; ++i) {
      const Index from{brick[0] + (i & 1), brick[1] + (i >> 1 & 1), brick[2] + (i >> 2)};
      const std::uint32_t b = has_brick(from) ? block[number_of_brick(from)] : empty;
      if (b == empty) {
        range[0] = 0;
        continue;
      }
      const Index end{(i & 1) != 0 ? 1 : edge, (i & 2) != 0 ? 1 : edge, (i & 4) != 0 ? 1 : edge};
      for (int z = 0; z < end[2]; ++z) {
        for (int y = 0; y < end[1]; ++y) {
          for (int x = 0; x < end[0]; ++x) {
            const std::uint16_t half = voxels[b * size + place_in_brick({x, y, z})];
            range = {std::min(range[0], half), std::max(range[1], half)};
            if (half == 0 || i != 0) continue;
            const Index here{edge * brick[0] + x, edge * brick[1] + y, edge * brick[2] + z};
            for (std::size_t a = 0; a < 3; ++a) {
              low[a] = std::min(low[a], here[a] - 1);
              high[a] = std::max(high[a], here[a] + 1);
            }
          }
        }
      }
    }
    // Outwards by a part in 10^7: what interpolation rounds.
    const auto bound = [&](std::uint16_t half, float outwards) {
      const auto x = static_cast<float>(unit * static_cast<double>(number_of(half)));
      return half == 0 ? 0.0F : std::nextafter(x, outwards);
    };
    least[n] = bound(range[0], 0.0F);
    greatest[n] = bound(range[1], std::numeric_limits<float>::infinity());
  }
};

/// Makes a grid voxel by voxel. Halves are counted in a power of two such that the greatest number takes the upper end
/// of their range: numbers are kept with 11 bits, and those below 2^-29 of the greatest become 0.
class BrickGridMaker {
 public:
  /// For numbers from 0 to `greatest` > 0, which stand at voxels from `low` to `high`, both included and as their maker
  /// counts them.
  BrickGridMaker(const BrickGrid::Index& low, const BrickGrid::Index& high, double greatest) {
    int exponent = 0;
    std::frexp(greatest, &exponent);
    grid_.unit = std::ldexp(1.0, exponent - 15);
    for (std::size_t a = 0; a < 3; ++a) {
      base_[a] = (low[a] - 1) >> 3;  // a voxel of zeros in front
      grid_.bricks[a] = (high[a] >> 3) - base_[a] + 1;
    }
    grid_.block.assign(static_cast<std::size_t>(grid_.bricks[0]) * static_cast<std::size_t>(grid_.bricks[1]) *
                           static_cast<std::size_t>(grid_.bricks[2]),
                       BrickGrid::empty);
  }

  void set(const BrickGrid::Index& voxel, double x) {
    const std::uint16_t half = half_of(x / grid_.unit);
    if (half == 0) return;
    const BrickGrid::Index brick{(voxel[0] >> 3) - base_[0], (voxel[1] >> 3) - base_[1], (voxel[2] >> 3) - base_[2]};
    std::uint32_t& block = grid_.block[grid_.number_of_brick(brick)];
    if (block == BrickGrid::empty) {
      block = static_cast<std::uint32_t>(grid_.blocks());
      grid_.voxels.resize(grid_.voxels.size() + BrickGrid::size, 0);
    }
    grid_.voxels[block * BrickGrid::size +
                 static_cast<std::size_t>((voxel[0] & 7) | (voxel[1] & 7) << 3 | (voxel[2] & 7) << 6)] = half;
  }

  std::size_t blocks() const { return grid_.blocks(); }

  /// The grid. `origin` is where the maker's voxel (0, 0, 0) stands, `x`, `y` and `z` are the ways to the next.
  BrickGrid finish(const Vector& origin, const Vector& x, const Vector& y, const Vector& z) {
    grid_.step[0] = x, grid_.step[1] = y, grid_.step[2] = z;
    grid_.origin = origin;
    for (std::size_t a = 0; a < 3; ++a) {
      grid_.origin += grid_.step[a] * static_cast<double>(BrickGrid::edge * base_[a]);
    }
    grid_.find_bounds();
    return std::move(grid_);
  }

 private:
  BrickGrid grid_;
  BrickGrid::Index base_{};  // of the maker's bricks, that which is the grid's first
};

/// A grid as a description holds it, made by a program or read from a file.
inline GridFile file_of(BrickGrid grid) {
  Digest digest;
  add_value(digest, grid.bricks);
  add_value(digest, grid.unit);
  add_value(digest, grid.origin);
  for (const Vector& step : grid.step) add_value(digest, step);
  for (const std::uint32_t block : grid.block) digest.add(std::uint64_t{block});
  for (std::size_t i = 0; i + 3 < grid.voxels.size(); i += 4) {
    std::uint64_t four = 0;
    for (std::size_t k = 0; k < 4; ++k) four = four << 16 | grid.voxels[i + k];
    digest.add(four);
  }
  return {"", "", std::make_shared<const BrickGrid>(std::move(grid)), digest.value()};
}

}  // namespace tyndall
