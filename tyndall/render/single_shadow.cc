#include "tyndall/render/single_shadow.h"

#include <algorithm>
#include <numeric>

namespace tyndall {
namespace {

Vector vector_of(const std::array<float, 3>& p) { return {p[0], p[1], p[2]}; }

/// The points p with dot(normal, p) >= offset.
struct HalfSpace {
  Vector normal;
  double offset;
};

struct Point2 {
  double x, y;
};

}  // namespace

/// The plane of ray and lamp: x along the ray from its origin, y from the ray toward the lamp, z across the plane. The
/// lamp stands at (along, aside), or infinitely far in direction (wx, wy), wy > 0.
struct ShadowIndex::View {
  Vector origin, x, y, z;
  bool far = false;
  double along = 0.0, aside = 0.0, slope = 0.0;  // slope = wx / wy
  Interval range;
  std::array<HalfSpace, 6> bounds;
  std::size_t bound_count = 0;

  /// The halves of space that hold everything able to throw a shadow on the range.
  void set_bounds() {
    const auto half = [&](double nx, double ny, double nz, double px, double py) {
      const Vector n = x * nx + y * ny + z * nz;
      bounds[bound_count++] = {n, dot(n, origin) + nx * px + ny * py};
    };
    bound_count = 0;
    half(0, 0, 1, 0, 0);
    half(0, 0, -1, 0, 0);
    half(0, 1, 0, 0, 0);
    if (!far) half(0, -1, 0, along, aside);
    // Right of the line from (begin, 0) to the lamp, left of that from (end, 0).
    const double wx0 = far ? slope : along - range.begin, wy = far ? 1.0 : aside;
    const double scale0 = 1.0 / std::hypot(wx0, wy);
    half(wy * scale0, -wx0 * scale0, 0, range.begin, 0);
    if (range.end < infinity) {
      const double wx1 = far ? slope : along - range.end, scale1 = 1.0 / std::hypot(wx1, wy);
      half(-wy * scale1, wx1 * scale1, 0, range.end, 0);
    }
  }

  bool reaches(const std::array<float, 3>& low, const std::array<float, 3>& high, double slack) const {
    const Vector a = vector_of(low), b = vector_of(high);
    for (std::size_t i = 0; i < bound_count; ++i) {
      const Vector& n = bounds[i].normal;
      const Vector furthest{n.x > 0.0 ? b.x : a.x, n.y > 0.0 ? b.y : a.y, n.z > 0.0 ? b.z : a.z};
      if (dot(n, furthest) < bounds[i].offset - slack) return false;
    }
    return true;
  }

  /// Shadow of a point between ray and lamp.
  double projected(const Point2& p) const {
    return far ? p.x - p.y * slope : along + (p.x - along) * aside / (aside - p.y);
  }

  /// Shadow of a triangle; empty when it misses the plane's part.
  Interval shadow(const Triangle& triangle) const {
    std::array<Vector, 3> corner;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector p = vector_of(triangle.corner[i]) - origin;
      corner[i] = {dot(p, x), dot(p, y), dot(p, z)};
    }
    // Corners on the plane count as above it, for all triangles alike: closed surfaces then cut in closed lines.
    std::array<Point2, 2> cut;
    int cuts = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector &a = corner[i], &b = corner[(i + 1) % 3];
      if ((a.z >= 0.0) == (b.z >= 0.0)) continue;
      const bool a_first = a.z < b.z;  // the same arithmetic for both triangles of an edge
      const Vector &p = a_first ? a : b, &q = a_first ? b : a;
      const double s = p.z / (p.z - q.z);
      cut[static_cast<std::size_t>(cuts++)] = {p.x + s * (q.x - p.x), p.y + s * (q.y - p.y)};
    }
    if (cuts != 2) return {0.0, 0.0};
    Point2 low = cut[0], high = cut[1];
    if (low.y > high.y) std::swap(low, high);
    if (high.y <= 0.0 || (!far && low.y >= aside)) return {0.0, 0.0};
    const auto at_height = [&](double height) {
      return Point2{low.x + (high.x - low.x) * ((height - low.y) / (high.y - low.y)), height};
    };
    double top;
    if (!far && high.y >= aside) {
      // The shadow of what reaches the lamp's own height goes on forever, on the side where it passes the lamp. What
      // passes through the lamp is what the lamp stands on: it is edge-on and throws none.
      const double offset = at_height(aside).x - along;
      const double size = std::fabs(low.x - along) + std::fabs(high.x - along) + aside;
      if (std::fabs(offset) <= 1e-9 * size) return {0.0, 0.0};
      top = offset > 0.0 ? infinity : -infinity;
    } else {
      top = projected(high);
    }
    const double bottom = projected(low.y < 0.0 ? at_height(0.0) : low);
    return {std::min(bottom, top), std::max(bottom, top)};
  }
};

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

/// Halves at the median centre along the longest side: the order depends on the input only.
std::uint32_t ShadowIndex::build(std::uint32_t first, std::uint32_t end) {
  const auto index = static_cast<std::uint32_t>(nodes_.size());
  nodes_.emplace_back();
  Node node;
  node.low.fill(std::numeric_limits<float>::infinity());
  node.high.fill(-std::numeric_limits<float>::infinity());
  std::array<float, 3> centre_low = node.low, centre_high = node.high;
  const auto centre = [](const Triangle& t, std::size_t axis) {
    return t.corner[0][axis] + t.corner[1][axis] + t.corner[2][axis];
  };
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
  std::size_t longest = 0;
  for (std::size_t axis = 1; axis < 3; ++axis) {
    if (centre_high[axis] - centre_low[axis] > centre_high[longest] - centre_low[longest]) longest = axis;
  }
  if (end - first <= 4 || !(centre_high[longest] > centre_low[longest])) {
    node.first = first;
    node.count = end - first;
  } else {
    const std::uint32_t middle = first + (end - first) / 2;
    std::nth_element(
        triangles_.begin() + first, triangles_.begin() + middle, triangles_.begin() + end,
        [&](const Triangle& a, const Triangle& b) { return centre(a, longest) < centre(b, longest); });
    build(first, middle);
    node.first = build(middle, end);
    node.count = 0;
  }
  nodes_[index] = node;
  return index;
}

void ShadowIndex::collect(const View& view, std::vector<Interval>& shadows) const {
  const auto& low = nodes_[0].low;
  const auto& high = nodes_[0].high;
  const double size = length(vector_of(high) - vector_of(low)) + length(vector_of(low) - view.origin);
  const double slack = 1e-12 * size;
  std::array<std::uint32_t, 64> stack;
  std::size_t depth = 0;
  std::uint32_t at = 0;
  for (;;) {
    const Node& node = nodes_[at];
    if (view.reaches(node.low, node.high, slack)) {
      if (node.count == 0) {
        stack[depth++] = node.first;
        ++at;
        continue;
      }
      for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
        const Interval shadow = intersection(view.shadow(triangles_[i]), view.range);
        if (shadow.begin < shadow.end) shadows.push_back(shadow);
      }
    }
    if (depth == 0) return;
    at = stack[--depth];
  }
}

void ShadowIndex::lit(const View& view, const Interval& range, std::vector<Interval>& out) const {
  static thread_local std::vector<Interval> shadows;
  shadows.clear();
  collect(view, shadows);
  std::sort(shadows.begin(), shadows.end(), [](const Interval& a, const Interval& b) { return a.begin < b.begin; });
  // Neighbouring triangles share an edge up to rounding: no light falls through a gap that narrow.
  const double reach = range.end < infinity ? range.end : std::fabs(view.along) + range.begin;
  const double gap = 1e-11 * (reach + view.aside);
  double begin = range.begin;
  for (const Interval& s : shadows) {
    if (s.begin > begin + gap) out.push_back({begin, s.begin});
    begin = std::max(begin, s.end);
  }
  if (begin == range.begin || range.end > begin + gap) {
    if (begin < range.end) out.push_back({begin, range.end});
  }
}

void ShadowIndex::lit_from(const Vector& lamp, const Ray& ray, const Interval& range,
                           std::vector<Interval>& out) const {
  out.clear();
  if (range.empty()) return;
  const Vector offset = lamp - ray.origin;
  View view;
  view.origin = ray.origin;
  view.x = ray.direction;
  view.along = dot(offset, ray.direction);
  Vector across = offset - ray.direction * view.along;
  across = across - ray.direction * dot(across, ray.direction);  // once more: perpendicular even if tiny
  view.aside = length(across);
  view.range = range;
  if (empty() || !(view.aside > 1e-12 * length(offset))) {
    out.push_back(range);
    return;
  }
  view.y = across / view.aside;
  view.z = cross(view.x, view.y);
  view.set_bounds();
  lit(view, range, out);
}

void ShadowIndex::lit_from_direction(const Vector& toward, const Ray& ray, const Interval& range,
                                     std::vector<Interval>& out) const {
  out.clear();
  if (range.empty()) return;
  const double along = dot(toward, ray.direction);
  Vector across = toward - ray.direction * along;
  across = across - ray.direction * dot(across, ray.direction);
  const double aside = length(across);
  if (empty() || !(aside > 1e-12)) {
    out.push_back(range);
    return;
  }
  View view;
  view.origin = ray.origin;
  view.x = ray.direction;
  view.y = across / aside;
  view.z = cross(view.x, view.y);
  view.far = true;
  view.slope = along / aside;
  view.range = range;
  view.set_bounds();
  lit(view, range, out);
}

}  // namespace tyndall
