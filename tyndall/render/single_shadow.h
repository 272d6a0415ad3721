#pragma once
// Which parts of a ray a lamp lights: the shadows of a scene's triangles, exactly.
#include <array>
#include <cstdint>
#include <vector>

#include "tyndall/render/single_wedge.h"
#include "tyndall/scene/scene.h"

namespace tyndall {

/// A ray and a lamp span a plane. Each triangle cuts that plane in a segment, and the segment's shadow on the ray lies
/// between the projections of its ends: so the edges of all shadows are known to rounding, and none is too narrow to be
/// found. An index (boxes of boxes) finds the triangles that reach into the part of the plane between lamp and ray.
/// Read only after construction. Refers to nothing of the scene.
class ShadowIndex {
 public:
  explicit ShadowIndex(const Scene& scene);

  bool empty() const { return triangles_.empty(); }

  /// The parts of the wedge's stretch of ray that its lamp lights, in rising order. Where the wedge is not flat, the
  /// whole stretch: the caller asks along the ray.
  void lit(const Wedge& wedge, std::vector<Interval>& out) const;

 private:
  struct Triangle {
    std::array<std::array<float, 3>, 3> corner;
  };
  struct Node {
    std::array<float, 3> low, high;
    std::uint32_t first, count;  // triangles of a leaf; count 0: children are the next node and node `first`
  };
  static float centre(const Triangle& t, std::size_t axis);
  static std::size_t bin_of(const Triangle& t, std::size_t axis, float low, float extent, std::size_t bins);
  std::uint32_t build(std::uint32_t first, std::uint32_t end);
  std::uint32_t divide(std::uint32_t first, std::uint32_t end, const std::array<float, 3>& centre_low,
                       const std::array<float, 3>& centre_high);

  std::vector<Triangle> triangles_;
  std::vector<Node> nodes_;
};

}  // namespace tyndall
