#pragma once
// A ray through a grid of voxels, cell by cell (Amanatides and Woo 1987): in each the density is a cubic in t.
#include <algorithm>
#include <array>
#include <cmath>

#include "tyndall/medium/profile.h"

namespace tyndall {

/// A cubic of u from 0 to 1, by its coefficients.
struct Cubic {
  std::array<double, 4> c{};

  Cubic operator*(double by) const { return {{c[0] * by, c[1] * by, c[2] * by, c[3] * by}}; }
  double at(double u) const { return c[0] + u * (c[1] + u * (c[2] + u * c[3])); }
  /// The integral from 0 to u.
  double integral_to(double u) const {
    return u * (c[0] + u * (1.0 / 2.0 * c[1] + u * (1.0 / 3.0 * c[2] + u * (1.0 / 4.0 * c[3]))));
  }
};

class GridWalk {
 public:
  /// Walks the part `within` of the ray. The grid must outlive the walk.
  GridWalk(const PlacedGrid& placed, const Ray& ray, const Interval& within)
      : placed_(placed), grid_(*placed.grid), origin_(placed.voxels(ray.origin)) {
    const Vector way = placed.voxels_along(ray.direction);
    for (std::size_t a = 0; a < 3; ++a) {
      const double d = way[static_cast<int>(a)];
      sign_[a] = d > 1e-300 ? 1 : d < -1e-300 ? -1 : 0;
      way_[a] = sign_[a] != 0 ? d : 0.0;
      per_[a] = sign_[a] != 0 ? 1.0 / d : 0.0;
    }
    const auto corner = [](const BrickGrid::Index& i) {
      return Vector{static_cast<double>(i[0]), static_cast<double>(i[1]), static_cast<double>(i[2])};
    };
    const Interval box = intersection(
        within, inside(Box{corner(grid_.low), corner(grid_.high)}, {origin_, {way_[0], way_[1], way_[2]}}));
    if (box.empty() || !is_finite(origin_) || !(box.end < infinity)) return;
    now_ = box.begin;
    end_ = box.end;
    for (std::size_t a = 0; a < 3; ++a) {
      enter(a, now_, grid_.low[a], grid_.high[a] - 1);
    }
  }

  /// Goes to the next cell that holds something. False: there is none.
  bool next() {
    while (now_ < end_) {
      if (new_brick_) look_at_brick();
      if (clear_) {
        leave_brick();
        continue;
      }
      const BrickGrid::Index here = cell_;
      const std::uint16_t* const voxels = voxels_;
      const double begin = now_;
      step();
      range_ = {begin, std::min(now_, end_)};
      if (!(range_.begin < range_.end)) continue;
      const bool within = BrickGrid::within_brick(here);
      if (within && voxels == nullptr) continue;
      const BrickGrid::Corners corners = within ? grid_.corners(voxels, here) : grid_.corners(here);
      double all = 0.0;
      for (const double x : corners) all += x;
      if (all == 0.0) continue;
      set_cubic(corners, here);
      return true;
    }
    return false;
  }

  /// The cell's part of the ray, and the density's factor in it, u going from 0 at its begin to 1 at its end.
  const Interval& range() const { return range_; }
  const Cubic& cubic() const { return cubic_; }

 private:
  double plane(std::size_t a, int index) const {
    return (static_cast<double>(index) - origin_[static_cast<int>(a)]) * per_[a];
  }
  void set_exit(std::size_t a) { exit_[a] = sign_[a] != 0 ? plane(a, cell_[a] + (sign_[a] > 0 ? 1 : 0)) : infinity; }

  /// Puts the walk, at t, into the cell of one axis that it is in.
  void enter(std::size_t a, double t, int first, int last) {
    const double at = std::floor(origin_[static_cast<int>(a)] + way_[a] * t);
    cell_[a] = static_cast<int>(std::clamp(at, static_cast<double>(first), static_cast<double>(last)));
    set_exit(a);
    // On a plane, which rounding may have put behind.
    while (exit_[a] <= t && cell_[a] != (sign_[a] > 0 ? last : first)) {
      cell_[a] += sign_[a];
      set_exit(a);
    }
  }

  void look_at_brick() {
    const BrickGrid::Index brick{cell_[0] >> 3, cell_[1] >> 3, cell_[2] >> 3};
    clear_ = !(grid_.greatest[grid_.number_of_brick(brick)] > 0.0F);
    voxels_ = grid_.voxels_of(brick);
    new_brick_ = false;
  }

  void pass(std::size_t a) {
    now_ = std::max(now_, exit_[a]);
    new_brick_ = new_brick_ || (cell_[a] & 7) == (sign_[a] > 0 ? 7 : 0);
    cell_[a] += sign_[a];
    if (cell_[a] < grid_.low[a] || cell_[a] >= grid_.high[a]) {
      now_ = infinity;
      return;
    }
    set_exit(a);
  }

  void step() { pass(exit_[0] < exit_[1] ? (exit_[0] < exit_[2] ? 0 : 2) : (exit_[1] < exit_[2] ? 1 : 2)); }

  /// Goes on where the ray leaves the brick.
  void leave_brick() {
    const BrickGrid::Index brick{cell_[0] >> 3, cell_[1] >> 3, cell_[2] >> 3};
    std::size_t across = 0;
    double first = infinity;
    for (std::size_t a = 0; a < 3; ++a) {
      if (sign_[a] == 0) continue;
      const double there = plane(a, BrickGrid::edge * (sign_[a] > 0 ? brick[a] + 1 : brick[a]));
      if (there < first) first = there, across = a;
    }
    for (std::size_t a = 0; a < 3; ++a) {
      const int low = BrickGrid::edge * brick[a], high = low + BrickGrid::edge - 1;
      if (a == across) {
        cell_[a] = sign_[a] > 0 ? high : low;
        exit_[a] = first;
      } else if (sign_[a] != 0) {
        enter(a, first, std::max(low, grid_.low[a]), std::min(high, grid_.high[a] - 1));
      }
    }
    pass(across);
  }

  /// Trilinear between the corners (x, y, z at index x + 2 y + 4 z), along the ray.
  void set_cubic(const BrickGrid::Corners& c, const BrickGrid::Index& cell) {
    const double length = range_.end - range_.begin;
    std::array<double, 3> from{}, by{};
    for (std::size_t a = 0; a < 3; ++a) {
      from[a] = origin_[static_cast<int>(a)] + way_[a] * range_.begin - static_cast<double>(cell[a]);
      by[a] = way_[a] * length;
    }
    // First along x: four numbers that are linear in u; then pairs of them along y and z.
    const auto mix = [](double low, double low_by, double high, double high_by, double share, double share_by) {
      const double over = high - low, over_by = high_by - low_by;
      return std::array{low + over * share, low_by + over_by * share + over * share_by, over_by * share_by};
    };
    const auto along_x = [&](std::size_t i) { return c[i] + (c[i + 1] - c[i]) * from[0]; };
    const auto along_x_by = [&](std::size_t i) { return (c[i + 1] - c[i]) * by[0]; };
    const auto near = mix(along_x(0), along_x_by(0), along_x(2), along_x_by(2), from[1], by[1]);
    const auto far = mix(along_x(4), along_x_by(4), along_x(6), along_x_by(6), from[1], by[1]);
    const std::array over{far[0] - near[0], far[1] - near[1], far[2] - near[2]};
    cubic_.c = {near[0] + over[0] * from[2], near[1] + over[1] * from[2] + over[0] * by[2],
                near[2] + over[2] * from[2] + over[1] * by[2], over[2] * by[2]};
    for (double& x : cubic_.c) x *= placed_.scale;
  }

  const PlacedGrid& placed_;
  const BrickGrid& grid_;
  Vector origin_;                        // all in voxels
  std::array<double, 3> way_{}, per_{};  // per t, and its inverse; 0 along the planes
  std::array<int, 3> sign_{};
  std::array<double, 3> exit_{};  // t at which the cell ends, by axis
  BrickGrid::Index cell_{};
  const std::uint16_t* voxels_ = nullptr;  // of the cell's brick
  bool new_brick_ = true, clear_ = false;  // clear: all cells of the brick are zero
  double now_ = infinity, end_ = 0.0;
  Interval range_{};
  Cubic cubic_;
};

}  // namespace tyndall
