#include "tyndall/render/single_glow.h"

#include <cmath>
#include <numbers>

namespace tyndall {
namespace {

/// The ball around the centroid of a triangle.
void put(GlowCell& cell) {
  cell.center = cell.place = cell.a + (cell.ab + cell.ac) / 3.0;
  cell.radius =
      std::sqrt(std::max({length_squared(cell.a - cell.center), length_squared(cell.a + cell.ab - cell.center),
                          length_squared(cell.a + cell.ac - cell.center)}));
}

GlowCell united(const GlowCell& a, const GlowCell& b) {
  GlowCell cell;
  const double wa = mean(a.intensity), wb = mean(b.intensity), whole = wa + wb;
  cell.center = (a.center * wa + b.center * wb) / whole;
  cell.place = length_squared(a.place - cell.center) <= length_squared(b.place - cell.center) ? a.place : b.place;
  cell.radius = std::max(length(a.center - cell.center) + a.radius, length(b.center - cell.center) + b.radius);
  cell.area = a.area + b.area;
  cell.intensity = a.intensity + b.intensity;
  const Vector sum = (a.axis * (a.order * wa) + b.axis * (b.order * wb)) / whole;
  cell.order = std::min(1.0, length(sum));
  cell.axis = cell.order > 1e-6 ? sum / length(sum) : a.axis;
  return cell;
}

}  // namespace

GlowCell GlowTree::quarter(const GlowCell& whole, const Vector& a, const Vector& ab, const Vector& ac) {
  GlowCell cell = whole;
  cell.a = a;
  cell.ab = ab;
  cell.ac = ac;
  cell.area = 0.25 * whole.area;
  cell.intensity = whole.intensity * 0.25;
  put(cell);
  return cell;
}

GlowTree::GlowTree(const Scene& scene) {
  std::vector<GlowCell> triangles;
  const Emitters emitters(scene);
  for (const EmissiveTriangle& t : emitters.triangles()) {
    GlowCell cell;
    cell.a = t.a;
    cell.ab = t.ab;
    cell.ac = t.ac;
    cell.axis = t.normal;
    cell.area = t.area;
    cell.intensity = t.radiance * t.area;
    put(cell);
    triangles.push_back(cell);
    if (!t.double_sided) continue;
    cell.axis = -t.normal;
    triangles.push_back(cell);
  }
  if (triangles.empty()) return;
  nodes_.reserve(2 * triangles.size());
  build(triangles, 0, triangles.size());
}

/// Halves at the median along the longest of six extents, three of place and three of direction (sides that face
/// apart count as half the cluster's size apart): the order depends on the input only.
std::size_t GlowTree::build(std::vector<GlowCell>& triangles, std::size_t first, std::size_t end) {
  const std::size_t index = nodes_.size();
  if (end - first == 1) {
    nodes_.push_back(triangles[first]);
    return index;
  }
  nodes_.emplace_back();
  const auto coordinate = [](const GlowCell& cell, int k) { return k < 3 ? cell.center[k] : cell.axis[k - 3]; };
  double extent[6];
  for (int k = 0; k < 6; ++k) {
    const auto [low, high] = std::minmax_element(
        triangles.begin() + static_cast<std::ptrdiff_t>(first), triangles.begin() + static_cast<std::ptrdiff_t>(end),
        [&](const GlowCell& a, const GlowCell& b) { return coordinate(a, k) < coordinate(b, k); });
    extent[k] = coordinate(*high, k) - coordinate(*low, k);
  }
  const double size = std::sqrt(extent[0] * extent[0] + extent[1] * extent[1] + extent[2] * extent[2]);
  for (int k = 3; k < 6; ++k) extent[k] *= 0.5 * size;
  const int longest = static_cast<int>(std::max_element(extent, extent + 6) - extent);
  const std::size_t middle = first + (end - first) / 2;
  std::nth_element(
      triangles.begin() + static_cast<std::ptrdiff_t>(first), triangles.begin() + static_cast<std::ptrdiff_t>(middle),
      triangles.begin() + static_cast<std::ptrdiff_t>(end),
      [&](const GlowCell& a, const GlowCell& b) { return coordinate(a, longest) < coordinate(b, longest); });
  const std::size_t left = build(triangles, first, middle), right = build(triangles, middle, end);
  GlowCell cell = united(nodes_[left], nodes_[right]);
  cell.node = index;
  cell.second = right;
  nodes_[index] = cell;
  return index;
}

}  // namespace tyndall
