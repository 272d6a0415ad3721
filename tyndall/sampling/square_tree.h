#pragma once
// A density over the unit square, learned from points.
#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace tyndall {

/// A quadtree whose cells divide where many points, and much of the weight, have been: constant in each of its smallest
/// cells, and a twentieth even over the square.
class SquareTree {
 public:
  struct Point {
    float u, v, weight;  // u, v in [0, 1], weight > 0
  };
  struct Sample {
    double u, v, density;
  };
  static constexpr double even_share = 0.05;

  /// Even.
  SquareTree() : nodes_(1, even) {}

  explicit SquareTree(std::vector<Point> points) {
    double all = 0.0, kept = 0.0;
    for (const Point& p : points) all += p.weight;
    // One lucky point must not make the picture.
    for (Point& p : points) kept += p.weight = static_cast<float>(std::min<double>(p.weight, 0.02 * all));
    grow(std::move(points), 0.0F, 0.0F, 1.0F, 0.002 * kept);
  }

  /// A place for two numbers in (0, 1), of which neighbours stay neighbours.
  Sample sample(double xi1, double xi2) const {
    if (xi1 < even_share) return with_density(xi1 / even_share, xi2);
    xi1 = (xi1 - even_share) / (1.0 - even_share);
    double u = 0.0, v = 0.0, size = 1.0;
    for (std::size_t node = 0;;) {
      const auto& share = nodes_[node].share;
      const double left = static_cast<double>(share[0]) + share[2], right = static_cast<double>(share[1]) + share[3];
      size *= 0.5;
      std::size_t quarter = choose(xi1, left, right) ? 1 : 0;
      u += quarter == 1 ? size : 0.0;
      if (choose(xi2, share[quarter], share[quarter + 2])) quarter += 2, v += size;
      node = nodes_[node].child[quarter];
      if (node == 0) return with_density(u + xi1 * size, v + xi2 * size);
    }
  }

  /// The density with which sample gives a place; 0 outside of the square.
  double density(double u, double v) const {
    if (!(u >= 0.0 && u <= 1.0 && v >= 0.0 && v <= 1.0)) return 0.0;
    double learned = 1.0;
    for (std::size_t node = 0;;) {
      u *= 2.0, v *= 2.0;
      std::size_t quarter = 0;
      if (u >= 1.0) quarter = 1, u -= 1.0;
      if (v >= 1.0) quarter += 2, v -= 1.0;
      learned *= 4.0 * static_cast<double>(nodes_[node].share[quarter]);
      node = nodes_[node].child[quarter];
      if (node == 0) return even_share + (1.0 - even_share) * learned;
    }
  }

 private:
  struct Node {
    std::array<float, 4> share;          // of the node's weight in each quarter: low u and v; high u; high v; both
    std::array<std::uint32_t, 4> child;  // 0: none, the quarter is even
  };
  static constexpr Node even{{0.25F, 0.25F, 0.25F, 0.25F}, {}};
  static constexpr std::size_t points_to_divide = 16;  // fewer say nothing about a finer cell
  static constexpr float smallest = 0x1p-12F;

  Sample with_density(double u, double v) const { return {u, v, density(u, v)}; }

  /// Whether xi is in the second of two shares; stretches what is left of it over (0, 1).
  static bool choose(double& xi, double first, double second) {
    const double at = xi * (first + second);
    const bool beyond = at >= first && second > 0.0;
    xi = std::min(beyond ? (at - first) / second : at / first, 1.0 - 0x1p-53);
    return beyond;
  }

  std::uint32_t grow(std::vector<Point> points, float u, float v, float size, double least) {
    const auto node = static_cast<std::uint32_t>(nodes_.size());
    nodes_.push_back(even);
    const float half = 0.5F * size;
    std::array<std::vector<Point>, 4> parts;
    std::array<double, 4> sums{};
    for (const Point& p : points) {
      const std::size_t quarter = (p.u >= u + half ? 1 : 0) + (p.v >= v + half ? 2 : 0);
      parts[quarter].push_back(p);
      sums[quarter] += p.weight;
    }
    points = {};
    const double all = sums[0] + sums[1] + sums[2] + sums[3];
    if (!(all > 0.0)) return node;
    for (std::size_t quarter = 0; quarter < 4; ++quarter) {
      nodes_[node].share[quarter] = static_cast<float>(sums[quarter] / all);
      if (sums[quarter] < least || parts[quarter].size() < points_to_divide || half < smallest) continue;
      const std::uint32_t child = grow(std::move(parts[quarter]), u + (quarter % 2 == 1 ? half : 0.0F),
                                       v + (quarter >= 2 ? half : 0.0F), half, least);
      nodes_[node].child[quarter] = child;
    }
    return node;
  }

  std::vector<Node> nodes_;
};

}  // namespace tyndall
