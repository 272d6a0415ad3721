// How the answers stay exact although Embree counts in float:
// - Embree's copy of the scene is moved to the origin and scaled to unit size, and a ray is started where it enters the
//   scene's box. Its rounding errors then are a few 1e-7 of the scene's size, however far the camera or large the
//   scene.
// - Every candidate that Embree finds is intersected again in double (a filter function), and refused unless it lies
//   between the ray's true ends. The float ray starts a little before and ends a little after them, so that nothing
//   between them is lost to rounding. Leaving a surface thus takes an offset of 1e-10 of the scene, not of 1e-4.
#include "tyndall/scene/geometry.h"

#include <embree3/rtcore.h>
#include <xmmintrin.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>

#include "tyndall/geometry/shape.h"
#include "tyndall/number/digest.h"

namespace tyndall {
namespace {

Vector vector_of(const std::array<float, 3>& p) { return {p[0], p[1], p[2]}; }

/// Where a ray meets the plane of a triangle, in double.
struct Crossing {
  double t, u, v;
};

struct Triangle {
  Vector a, ab, ac, normal;  // normal: |ab x ac| long, counter-clockwise side
};

Triangle triangle_of(const Mesh& mesh, std::size_t index) {
  const auto& corner = mesh.triangles[index];
  const Vector a = vector_of(mesh.positions[corner[0]]);
  const Vector ab = vector_of(mesh.positions[corner[1]]) - a, ac = vector_of(mesh.positions[corner[2]]) - a;
  return {a, ab, ac, cross(ab, ac)};
}

/// By Cramer's rule on o + t d = a + u ab + v ac (Moeller and Trumbore 1997, without their rejections: Embree decides
/// which triangle is hit, so that closed surfaces stay closed). None when the ray lies in the plane.
std::optional<Crossing> crossing(const Triangle& triangle, const Ray& ray) {
  const double toward = -dot(ray.direction, triangle.normal);
  if (toward == 0.0) return std::nullopt;
  const Vector from_a = ray.origin - triangle.a;
  const Vector moment = cross(from_a, ray.direction);
  return Crossing{dot(from_a, triangle.normal) / toward, dot(triangle.ac, moment) / toward,
                  -dot(triangle.ab, moment) / toward};
}

/// Keeps barycentric weights inside the triangle: a hit that Embree found on an edge may lie 1e-7 beside it.
void confine(double& u, double& v) {
  u = std::clamp(u, 0.0, 1.0);
  v = std::clamp(v, 0.0, 1.0);
  if (const double both = u + v; both > 1.0) {
    u /= both;
    v /= both;
  }
}

}  // namespace

struct Geometry::Index {
  const Scene& scene;
  RTCDevice device = nullptr;
  RTCScene embree = nullptr;
  Box box;                  // of the scene, a little enlarged; low > high when there is nothing
  Vector center;            // Embree's origin
  double scale = 1.0;       // Embree units per metre, a power of two
  double size = 0.0;        // the largest coordinate, and the largest extent
  double slack = 0.0;       // [m] by which the float ray is longer than the true one, at both ends
  Material plain;           // of meshes without a material
  std::vector<bool> holed;  // by mesh: whether its material may let rays through

  explicit Index(const Scene& s) : scene(s) {
    plain.metallic = 0.0;
    plain.roughness = 1.0;
    for (const Mesh& mesh : s.meshes) holed.push_back(material_of(mesh).alpha_mode != AlphaMode::opaque);
  }
  const Material& material_of(const Mesh& mesh) const {
    return mesh.material < 0 ? plain : scene.materials[static_cast<std::size_t>(mesh.material)];
  }
  bool is_there(SurfacePlace at, const Ray& ray) const;
  ~Index() {
    if (embree != nullptr) rtcReleaseScene(embree);
    if (device != nullptr) rtcReleaseDevice(device);
  }
  Index(const Index&) = delete;
  Index& operator=(const Index&) = delete;

  void measure();
  void build();

  /// A ray made ready for Embree, or none when it misses the scene's box.
  struct Query : RTCIntersectContext {
    const Index* index;
    Ray ray;
    double begin, end;  // a candidate counts when begin < t < end ...
    double height;      // ... and the ray's origin and end lie more than this off its plane [m]
    RTCRayHit embree;
  };
  bool prepare(Query& query, const Ray& ray, double begin, double end, double height) const;
  bool any(const Ray& ray, double begin, double end, double height) const;
  static void filter(const RTCFilterFunctionNArguments* arguments);
};

void Geometry::Index::measure() {
  Vector low{infinity, infinity, infinity}, high = -low;
  for (const Mesh& mesh : scene.meshes) {
    for (const auto& p : mesh.positions) {
      low = {std::min<double>(low.x, p[0]), std::min<double>(low.y, p[1]), std::min<double>(low.z, p[2])};
      high = {std::max<double>(high.x, p[0]), std::max<double>(high.y, p[1]), std::max<double>(high.z, p[2])};
    }
  }
  if (!(low.x <= high.x)) {
    box = {{1.0, 1.0, 1.0}, {-1.0, -1.0, -1.0}};
    return;
  }
  center = (low + high) * 0.5;
  const Vector extent = high - low;
  const double largest = std::max({extent.x, extent.y, extent.z, 1e-30});
  size = largest;
  for (int axis = 0; axis < 3; ++axis) size = std::max({size, std::fabs(low[axis]), std::fabs(high[axis])});
  scale = std::exp2(-std::ceil(std::log2(largest)));
  // Rounding of an origin and of vertices within [-1, 1]^3 is 6e-8 each and grows in Embree's products; 2^-18 = 4e-6
  // leaves room. Candidates found in that margin are refused by the filter.
  slack = std::exp2(-18.0) / scale;
  const Vector margin{slack, slack, slack};
  box = {low - margin, high + margin};
}

void Geometry::Index::build() {
  device = rtcNewDevice(nullptr);
  if (device == nullptr) throw std::runtime_error("Embree cannot start");
  embree = rtcNewScene(device);
  rtcSetSceneFlags(embree, static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
  for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
    const Mesh& mesh = scene.meshes[m];
    if (mesh.triangles.empty()) continue;
    const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* const positions = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), mesh.positions.size()));
    auto* const corners = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), mesh.triangles.size()));
    if (positions == nullptr || corners == nullptr) throw std::bad_alloc();
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      const Vector p = (vector_of(mesh.positions[i]) - center) * scale;
      for (int axis = 0; axis < 3; ++axis)
        positions[3 * i + static_cast<std::size_t>(axis)] = static_cast<float>(p[axis]);
    }
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) std::ranges::copy(mesh.triangles[i], corners + 3 * i);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(embree, geometry, static_cast<unsigned>(m));
    rtcReleaseGeometry(geometry);
  }
  // Embree may build with denormals flushed to zero in this thread; everybody else's arithmetic must not notice.
  const unsigned int arithmetic = _mm_getcsr();
  rtcCommitScene(embree);
  _mm_setcsr(arithmetic);
  if (const RTCError error = rtcGetDeviceError(device); error == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
  else if (error != RTC_ERROR_NONE)
    throw std::runtime_error("Embree cannot index the scene (error " + std::to_string(error) + ")");
}

bool Geometry::Index::prepare(Query& query, const Ray& ray, double begin, double end, double height) const {
  const Interval within = intersection(inside(box, ray), {begin, end});
  if (within.empty()) return false;
  // From far away the point of entry is rounded too.
  const double start = within.begin - slack - 1e-14 * within.begin;
  const Vector origin = (ray.at(start) - center) * scale;
  rtcInitIntersectContext(&query);
  query.filter = filter;
  query.index = this;
  query.ray = ray;
  query.begin = begin;
  query.end = end;
  query.height = height;
  RTCRay& r = query.embree.ray;
  r.org_x = static_cast<float>(origin.x);
  r.org_y = static_cast<float>(origin.y);
  r.org_z = static_cast<float>(origin.z);
  r.dir_x = static_cast<float>(ray.direction.x);
  r.dir_y = static_cast<float>(ray.direction.y);
  r.dir_z = static_cast<float>(ray.direction.z);
  r.tnear = 0.0F;
  r.tfar = static_cast<float>((within.end + slack - start) * scale);
  r.time = 0.0F;
  r.mask = ~0U;
  r.id = 0;
  r.flags = 0;
  query.embree.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.embree.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  return true;
}

void Geometry::Index::filter(const RTCFilterFunctionNArguments* arguments) {
  if (arguments->valid[0] != -1) return;  // N is 1: single rays only
  const auto& query = *static_cast<const Query*>(arguments->context);
  const auto* const hit = reinterpret_cast<const RTCHit*>(arguments->hit);
  const Triangle triangle = triangle_of(query.index->scene.meshes[hit->geomID], hit->primID);
  const auto met = crossing(triangle, query.ray);
  bool counts = met && met->t > query.begin && met->t < query.end;
  if (counts && query.height > 0.0) {
    const double slope = std::fabs(dot(query.ray.direction, triangle.normal)) / length(triangle.normal);
    counts = std::min(met->t, query.end - met->t) * slope > query.height;
  }
  if (counts && query.index->holed[hit->geomID]) {
    counts = query.index->is_there({hit->geomID, hit->primID, met->u, met->v}, query.ray);
  }
  if (!counts) arguments->valid[0] = 0;
}

/// Whether a surface of partial alpha stops a ray. Where it is the part of the surface that is there, chance decides: a
/// hash of the ray and the triangle, the same whenever and wherever the same ray asks.
bool Geometry::Index::is_there(SurfacePlace at, const Ray& ray) const {
  confine(at.u, at.v);
  const Mesh& mesh = scene.meshes[at.mesh];
  const Material& material = material_of(mesh);
  const double alpha = alpha_at(scene, material, at);
  if (material.alpha_mode == AlphaMode::mask) return alpha >= material.alpha_cutoff;
  Digest digest;
  add_value(digest, ray.origin);
  add_value(digest, ray.direction);
  digest.add(std::uint64_t{at.mesh});
  digest.add(std::uint64_t{at.triangle});
  return static_cast<double>(digest.value() >> 11) * 0x1p-53 < alpha;
}

bool Geometry::Index::any(const Ray& ray, double begin, double end, double height) const {
  Query query;
  if (!prepare(query, ray, begin, end, height)) return false;
  rtcOccluded1(embree, &query, &query.embree.ray);
  return query.embree.ray.tfar < 0.0F;
}

Geometry::Geometry(const Scene& scene) : index_(std::make_unique<Index>(scene)) {
  index_->measure();
  index_->build();
}
Geometry::~Geometry() = default;

std::optional<Hit> Geometry::intersect(const Ray& ray, double end) const {
  Index::Query query;
  if (!index_->prepare(query, ray, 0.0, end, 0.0)) return std::nullopt;
  rtcIntersect1(index_->embree, &query, &query.embree);
  const RTCHit& found = query.embree.hit;
  if (found.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;

  const Mesh& mesh = index_->scene.meshes[found.geomID];
  const Triangle triangle = triangle_of(mesh, found.primID);
  const auto met = crossing(triangle, ray);
  if (!met) return std::nullopt;
  Hit hit;
  hit.t = met->t;
  hit.at = {found.geomID, found.primID, met->u, met->v};
  confine(hit.at.u, hit.at.v);
  const auto [m, index, u, v] = hit.at;
  // On the triangle rather than on the ray: shadow rays then start from the surface to the last digit.
  hit.point = triangle.a + triangle.ab * u + triangle.ac * v;
  hit.front = dot(ray.direction, triangle.normal) < 0.0;
  const double side = hit.front ? 1.0 : -1.0;
  hit.geometric_normal = normalized(triangle.normal) * side;
  hit.shading_normal = hit.geometric_normal;
  if (!mesh.normals.empty()) {
    const auto& corner = mesh.triangles[index];
    const Vector smooth = (vector_of(mesh.normals[corner[0]]) * (1.0 - u - v) + vector_of(mesh.normals[corner[1]]) * u +
                           vector_of(mesh.normals[corner[2]]) * v) *
                          side;
    // A smooth normal that looks away from the ray, or from its own triangle, shades nothing: the true one does.
    if (dot(smooth, ray.direction) < 0.0 && dot(smooth, hit.geometric_normal) > 0.0) {
      hit.shading_normal = normalized(smooth);
    }
  }
  hit.material = &index_->material_of(mesh);
  if (hit.material->normal_map.texture >= 0) {
    const Vector bent = mapped_normal(index_->scene, *hit.material, hit.at, hit.shading_normal * side) * side;
    // One that would look away from the ray is turned toward it until it just does not.
    const double seen = -dot(bent, ray.direction);
    hit.shading_normal = seen >= 0.01 ? bent : normalized(bent - ray.direction * (0.01 - seen));
  }
  return hit;
}

bool Geometry::occluded(const Ray& ray, double end) const { return index_->any(ray, 0.0, end, 0.0); }

bool Geometry::occluded(const Vector& from, const Vector& to) const {
  const Vector step = to - from;
  const double distance = length(step);
  // Both ends may lie on surfaces, exact to a few roundings of the largest coordinate. Those surfaces, and what the
  // segment merely runs along, do not count: 1e-13 is a thousand such roundings.
  const double height = 1e-13 * std::max({index_->size, length(from), length(to)});
  if (!(distance > 2.0 * height)) return false;
  return index_->any({from, step / distance}, 0.0, distance, height);
}

Vector Geometry::leave(const Vector& point, const Vector& normal) const {
  return point + normal * (1e-10 * std::max(index_->size, length(point)));
}

const Scene& Geometry::scene() const { return index_->scene; }

}  // namespace tyndall
