#include "tyndall/render/single_shadow.h"

#include <algorithm>

namespace tyndall {
namespace {

Vector vector_of(const std::array<float, 3>& p) { return {p[0], p[1], p[2]}; }

struct Point2 {
  double x, y;
};

/// dot(normal, p) = offset, and what is needed to test boxes against it.
struct Plane {
  Vector normal, size;
  double offset = 0.0;

  Plane() = default;
  Plane(const Vector& n, double o) : normal(n), size{std::fabs(n.x), std::fabs(n.y), std::fabs(n.z)}, offset(o) {}
  double height(const Vector& p) const { return dot(normal, p) - offset; }
  double reach(const Vector& half) const { return dot(size, half); }
};

}  // namespace

namespace {

/// Shadow on the wedge's ray of a triangle; empty when it misses the wedge's plane.
Interval shadow_of(const std::array<std::array<float, 3>, 3>& triangle, const Wedge& wedge) {
  const Interval none{0.0, 0.0};
  std::array<Vector, 3> from;
  std::array<double, 3> height;  // above the plane
  for (std::size_t i = 0; i < 3; ++i) {
    from[i] = vector_of(triangle[i]) - wedge.origin;
    height[i] = dot(from[i], wedge.z);
  }
  // Corners on the plane count as above it, for all triangles alike: closed surfaces then cut in closed lines.
  const bool above[3] = {height[0] >= 0.0, height[1] >= 0.0, height[2] >= 0.0};
  if (above[0] == above[1] && above[1] == above[2]) return none;
  std::array<Point2, 2> cut;
  std::size_t cuts = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    if (above[i] == above[j]) continue;
    // The same arithmetic for both triangles of an edge.
    const std::size_t p = height[i] < height[j] ? i : j, q = p == i ? j : i;
    const Vector at = from[p] + (from[q] - from[p]) * (height[p] / (height[p] - height[q]));
    cut[cuts++] = {dot(at, wedge.x), dot(at, wedge.y)};
  }
  Point2 low = cut[0], high = cut[1];
  if (low.y > high.y) std::swap(low, high);
  if (high.y <= 0.0 || (!wedge.far && low.y >= wedge.aside)) return none;
  const auto x_at = [&](double y) { return low.x + (high.x - low.x) * ((y - low.y) / (high.y - low.y)); };
  double top;
  if (wedge.far) {
    top = wedge.projected(high.x, high.y);
  } else {
    // What passes through the lamp is what the lamp stands on: seen from there it is edge-on and throws no shadow.
    const double dx = high.x - low.x, dy = high.y - low.y, lx = wedge.along - low.x, ly = wedge.aside - low.y;
    const double size = std::fabs(lx) + std::fabs(ly) + std::fabs(wedge.along) + wedge.aside;
    if (std::fabs(dx * ly - dy * lx) <= 1e-10 * size * (std::fabs(dx) + std::fabs(dy))) return none;
    if (high.y < wedge.aside) {
      top = wedge.projected(high.x, high.y);
    } else {
      // The shadow of what reaches the lamp's own height goes on forever, on the side where it passes the lamp.
      top = x_at(wedge.aside) > wedge.along ? infinity : -infinity;
    }
  }
  const double bottom = low.y < 0.0 ? x_at(0.0) : wedge.projected(low.x, low.y);
  return {std::min(bottom, top), std::max(bottom, top)};
}

}  // namespace

/// Three times the centroid.
float ShadowIndex::centre(const Triangle& t, std::size_t axis) {
  return t.corner[0][axis] + t.corner[1][axis] + t.corner[2][axis];
}
std::size_t ShadowIndex::bin_of(const Triangle& t, std::size_t axis, float low, float extent, std::size_t bins) {
  const float place = (centre(t, axis) - low) / extent * static_cast<float>(bins);
  return std::min(bins - 1, static_cast<std::size_t>(std::max(0.0f, place)));
}

ShadowIndex::ShadowIndex(const Scene& scene) {
  for (const Mesh& mesh : scene.meshes) {
    for (const auto& t : mesh.triangles) {
      triangles_.push_back({{mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]}});
    }
  }
  if (triangles_.empty()) return;
  nodes_.reserve(triangles_.size());
  build(0, static_cast<std::uint32_t>(triangles_.size()));
}

/// Where a crowd of triangles falls into two of least surface area times number, of 16 bins along each side
/// (MacDonald and Booth 1990; Wald 2007), the triangles put in that order; at the median of the longest side when there
/// is nothing to choose. The order depends on the input only.
std::uint32_t ShadowIndex::divide(std::uint32_t first, std::uint32_t end, const std::array<float, 3>& centre_low,
                                  const std::array<float, 3>& centre_high) {
  constexpr std::size_t bins = 16;
  struct Bin {
    std::array<float, 3> low, high;
    std::uint32_t count = 0;
    Bin() {
      low.fill(std::numeric_limits<float>::infinity());
      high.fill(-std::numeric_limits<float>::infinity());
    }
    void add(const std::array<float, 3>& a, const std::array<float, 3>& b) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        low[axis] = std::min(low[axis], a[axis]);
        high[axis] = std::max(high[axis], b[axis]);
      }
    }
    double cost() const {
      const double x = high[0] - low[0], y = high[1] - low[1], z = high[2] - low[2];
      return count == 0 ? 0.0 : (x * y + y * z + z * x) * count;
    }
  };
  std::size_t longest = 0, best_axis = 3, best_bin = 0;
  double best = infinity;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float extent = centre_high[axis] - centre_low[axis];
    if (extent > centre_high[longest] - centre_low[longest]) longest = axis;
    if (!(extent > 0.0f)) continue;
    std::array<Bin, bins> bin;
    for (std::uint32_t i = first; i < end; ++i) {
      Bin& b = bin[bin_of(triangles_[i], axis, centre_low[axis], extent, bins)];
      for (const auto& p : triangles_[i].corner) b.add(p, p);
      ++b.count;
    }
    std::array<double, bins> below;
    Bin sum;
    for (std::size_t k = 0; k < bins; ++k) {
      below[k] = sum.cost();
      sum.add(bin[k].low, bin[k].high);
      sum.count += bin[k].count;
    }
    sum = Bin();
    for (std::size_t k = bins - 1; k > 0; --k) {
      sum.add(bin[k].low, bin[k].high);
      sum.count += bin[k].count;
      const double cost = below[k] + sum.cost();
      if (sum.count > 0 && sum.count < end - first && cost < best) {
        best = cost;
        best_axis = axis;
        best_bin = k;
      }
    }
  }
  const auto begin = triangles_.begin() + first, stop = triangles_.begin() + end;
  if (best_axis < 3) {
    const float low = centre_low[best_axis], extent = centre_high[best_axis] - low;
    const auto middle = std::partition(
        begin, stop, [&](const Triangle& t) { return bin_of(t, best_axis, low, extent, bins) < best_bin; });
    const auto count = static_cast<std::uint32_t>(middle - begin);
    // No side below an eighth: 32 bits of triangles are then less than 200 levels.
    if (count >= (end - first) / 8 && end - first - count >= (end - first) / 8) return first + count;
  }
  const std::uint32_t middle = first + (end - first) / 2;
  std::nth_element(begin, triangles_.begin() + middle, stop,
                   [&](const Triangle& a, const Triangle& b) { return centre(a, longest) < centre(b, longest); });
  return middle;
}

std::uint32_t ShadowIndex::build(std::uint32_t first, std::uint32_t end) {
  const auto index = static_cast<std::uint32_t>(nodes_.size());
  nodes_.emplace_back();
  Node node;
  node.low.fill(std::numeric_limits<float>::infinity());
  node.high.fill(-std::numeric_limits<float>::infinity());
  std::array<float, 3> centre_low = node.low, centre_high = node.high;
  for (std::uint32_t i = first; i < end; ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const auto& p : triangles_[i].corner) {
        node.low[axis] = std::min(node.low[axis], p[axis]);
        node.high[axis] = std::max(node.high[axis], p[axis]);
      }
      const float c = centre(triangles_[i], axis);
      centre_low[axis] = std::min(centre_low[axis], c);
      centre_high[axis] = std::max(centre_high[axis], c);
    }
  }
  if (end - first <= 4) {
    node.first = first;
    node.count = end - first;
  } else {
    const std::uint32_t middle = divide(first, end, centre_low, centre_high);
    build(first, middle);
    node.first = build(middle, end);
    node.count = 0;
  }
  nodes_[index] = node;
  return index;
}

void ShadowIndex::lit(const Wedge& wedge, std::vector<Interval>& out) const {
  out.clear();
  if (wedge.range.empty()) return;
  if (empty() || !wedge.flat) {
    out.push_back(wedge.range);
    return;
  }
  // Wedge::misses for boxes, with what is the same for all of them done once.
  const Node& root = nodes_[0];
  const double slack =
      1e-12 * (length(vector_of(root.high) - vector_of(root.low)) + length(vector_of(root.low) - wedge.origin));
  std::array<Plane, 5> planes;
  std::size_t plane_count = 0;
  for (std::size_t i = 0; i < wedge.half_count; ++i) {
    planes[plane_count++] = Plane(wedge.halves[i].first, wedge.halves[i].second - slack);
  }
  const Plane across(wedge.z, dot(wedge.z, wedge.origin));
  const auto missed = [&](const Node& node) {
    const Vector low = vector_of(node.low), high = vector_of(node.high);
    const Vector center = (low + high) * 0.5, half = (high - low) * 0.5;
    if (std::fabs(across.height(center)) > across.reach(half) + slack) return true;
    for (std::size_t i = 0; i < plane_count; ++i) {
      if (planes[i].height(center) + planes[i].reach(half) < 0.0) return true;
    }
    return false;
  };
  std::vector<Interval> shadows;
  std::array<std::uint32_t, 256> stack;
  for (std::size_t depth = 0, at = 0;;) {
    const Node& node = nodes_[at];
    if (!missed(node)) {
      if (node.count == 0) {
        stack[depth++] = node.first;
        ++at;
        continue;
      }
      for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
        const Interval shadow = intersection(shadow_of(triangles_[i].corner, wedge), wedge.range);
        if (shadow.begin < shadow.end) shadows.push_back(shadow);
      }
    }
    if (depth == 0) break;
    at = stack[--depth];
  }
  std::sort(shadows.begin(), shadows.end(), [](const Interval& a, const Interval& b) { return a.begin < b.begin; });
  // Neighbouring triangles share an edge up to rounding: no light falls through a gap that narrow.
  const double reach = wedge.range.end < infinity ? wedge.range.end : std::fabs(wedge.along) + wedge.range.begin;
  const double gap = 1e-11 * (reach + wedge.aside);
  double begin = wedge.range.begin;
  for (const Interval& s : shadows) {
    if (s.begin > begin + gap) out.push_back({begin, s.begin});
    begin = std::max(begin, s.end);
  }
  if (begin < wedge.range.end && (shadows.empty() || wedge.range.end > begin + gap)) {
    out.push_back({begin, wedge.range.end});
  }
}

}  // namespace tyndall
