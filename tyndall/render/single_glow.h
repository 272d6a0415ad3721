#pragma once
// Emissive triangles as a tree: few cells stand for all of them where they are far, many where they are close.
#include <algorithm>
#include <vector>

#include "tyndall/render/single_airlight.h"
#include "tyndall/scene/emitter.h"

namespace tyndall {

/// A triangle, a part of one, or a cluster of whole triangles.
struct GlowCell {
  Vector center, axis;  // axis: unit, mean normal
  Vector place;         // the middle of a triangle near the center: of light from there, as much is hidden as of theirs
  double radius = 0.0;  // of a ball around the center that holds the cell [m]
  double area = 0.0;    // [m^2]
  double order = 1.0;   // length of the mean of unit normals: 1 in a plane, 0 all around
  Spectrum intensity;   // radiance times area [W/sr]
  std::size_t node = 0;    // of a cluster; its children are node + 1 and `second`
  std::size_t second = 0;  // 0: not a cluster
  Vector a, ab, ac;        // corner and edges, unless a cluster

  bool cluster() const { return second != 0; }
  /// Whether it certainly sends no light to a point that is `front` [m] in front of its center, along the axis.
  bool dark(double front) const { return order > 1.0 - 1e-9 && !(front > (cluster() ? -radius : 0.0)); }
  /// Intensity toward the unit direction `away`, relative to `intensity`: the mean of the triangles' cosines, exact for
  /// a plane and for normals that are spread evenly over all directions.
  double falloff(const Vector& away) const { return order * std::max(0.0, dot(axis, away)) + 0.25 * (1.0 - order); }
  /// The most that falloff may be for a part of the cell, toward a point at `distance` from the center.
  double highest_falloff(const Vector& away, double distance) const {
    const double low = falloff(away);
    return cluster() ? std::min(1.0, low + radius / std::max(distance, radius)) : low;
  }
};

/// A binary tree over all emissive triangles of a scene, neighbours in place and direction together; what glows on both
/// sides counts as two triangles. Refers to nothing of the scene; read only after construction.
class GlowTree {
 public:
  explicit GlowTree(const Scene& scene);

  bool empty() const { return nodes_.empty(); }
  const GlowCell& root() const { return nodes_.front(); }
  /// Calls use(cell) with the two children of a cluster, or the four quarters of a triangle.
  template <class Use>
  void split(const GlowCell& cell, const Use& use) const {
    if (cell.cluster()) {
      use(nodes_[cell.node + 1]);
      use(nodes_[cell.second]);
      return;
    }
    const Vector ab = cell.ab * 0.5, ac = cell.ac * 0.5;
    use(quarter(cell, cell.a, ab, ac));
    use(quarter(cell, cell.a + ab, ab, ac));
    use(quarter(cell, cell.a + ac, ab, ac));
    use(quarter(cell, cell.a + ab + ac, -ab, -ac));
  }

 private:
  std::size_t build(std::vector<GlowCell>& triangles, std::size_t first, std::size_t end);
  static GlowCell quarter(const GlowCell& whole, const Vector& a, const Vector& ab, const Vector& ac);

  std::vector<GlowCell> nodes_;
};

/// What a cell is worth to whoever cuts the tree.
struct GlowValue {
  Spectrum light;    // an estimate of its contribution
  double key = 0.0;  // how much of it may be wrong if it is not split; 0: no contribution, drop it
  Vector aim;        // a point for a shadow ray
};

/// A cell of a cut.
struct GlowPart {
  GlowCell cell;
  GlowValue value;
};

/// Cells that together are the whole tree: beginning with the root, the one with the largest key is split until no key
/// is above `share` of the sum of light, or there are `most`. (Lightcuts: Walter et al. 2005, here down to parts of
/// triangles.) value_of(cell) -> GlowValue.
template <class ValueOf>
void cut_glow(const GlowTree& tree, std::size_t most, double share, const ValueOf& value_of,
              std::vector<GlowPart>& cut) {
  cut.clear();
  if (tree.empty()) return;
  const auto lower = [](const GlowPart& a, const GlowPart& b) { return a.value.key < b.value.key; };
  double total = 0.0;
  const auto add = [&](const GlowCell& cell) {
    const GlowValue value = value_of(cell);
    if (!(value.key > 0.0)) return;
    total += mean(value.light);
    cut.push_back({cell, value});
    std::push_heap(cut.begin(), cut.end(), lower);
  };
  add(tree.root());
  while (!cut.empty() && cut.size() < most && cut.front().value.key > share * total) {
    std::pop_heap(cut.begin(), cut.end(), lower);
    const GlowPart part = cut.back();
    cut.pop_back();
    total -= mean(part.value.light);
    tree.split(part.cell, add);
  }
}

}  // namespace tyndall
