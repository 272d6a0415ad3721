#include "tyndall/scene/gltf.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "tyndall/document/file_kind.h"
#include "tyndall/document/rehearsal.h"
#include "tyndall/document/spelling.h"
#include "tyndall/document/whole_file.h"
#include "tyndall/scene/gltf_animation.h"
#include "tyndall/scene/gltf_material.h"
#include "tyndall/scene/gltf_model.h"
#include "tyndall/scene/transform.h"

namespace tyndall {
namespace {

constexpr double largest_coordinate = 1e15;  // [m]
constexpr double degrees = 180.0 / std::numbers::pi;

/// Builds scene parts from a model. One per file.
class Reading {
 public:
  Reading(const GltfModel& gltf, Scene& scene, const GltfOptions& options)
      : gltf_(gltf),
        model_(gltf.model),
        scene_(scene),
        unit_(options.meters_per_unit),
        poses_(poses_at(gltf, options.time, ignored_)),
        materials_(gltf, scene, ignored_) {}
  GltfContent run();

 private:
  void add_node(std::size_t index, const Transform& to_world);
  void add_primitive(const tinygltf::Primitive& primitive, const std::string& name, const Transform& to_world,
                     const std::string& pointer);
  std::vector<std::array<std::uint32_t, 3>> triangles(const tinygltf::Primitive& primitive, std::size_t vertices,
                                                      const std::string& pointer);
  void add_light(int index, const Transform& to_world, const std::string& pointer);
  void add_camera(int index, const Transform& to_world, const std::string& pointer);
  Transform transform_of(std::size_t index, const std::string& pointer) const;
  Vector unit_vector(const Vector& v, const std::string& pointer) const;
  void note_unsupported();

  const GltfModel& gltf_;
  const tinygltf::Model& model_;
  Scene& scene_;
  double unit_;
  std::size_t vertex_count_ = 0, triangle_count_ = 0;
  std::set<std::string> ignored_;
  std::map<std::size_t, NodePose> poses_;
  GltfMaterials materials_;
  std::optional<GltfCamera> camera_;
};

Vector Reading::unit_vector(const Vector& v, const std::string& pointer) const {
  const double size = length(v);
  if (!(size > 0.0) || !std::isfinite(size)) {
    throw gltf_.fault(pointer, "a transformation that leaves no direction", "one that can be undone");
  }
  return v / size;
}

Transform Reading::transform_of(std::size_t index, const std::string& pointer) const {
  const tinygltf::Node& node = model_.nodes[index];
  const auto vector = [](const std::vector<double>& v, double missing) {
    return v.size() == 3 ? Vector{v[0], v[1], v[2]} : Vector{missing, missing, missing};
  };
  Transform t;
  if (node.matrix.size() == 16) {
    const auto& m = node.matrix;  // by columns
    t = {{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}, {m[12], m[13], m[14]}};
  } else {
    std::array<double, 4> turn{0.0, 0.0, 0.0, 1.0};
    if (node.rotation.size() == 4) std::ranges::copy(node.rotation, turn.begin());
    const auto moved = poses_.find(index);
    const NodePose pose = moved == poses_.end() ? NodePose{} : moved->second;
    t = placed(pose.translation.value_or(vector(node.translation, 0.0)), pose.rotation.value_or(turn),
               pose.scale.value_or(vector(node.scale, 1.0)));
  }
  if (!is_finite(t.x) || !is_finite(t.y) || !is_finite(t.z) || !is_finite(t.origin)) {
    throw gltf_.fault(pointer, "a transformation that is not finite", "finite numbers");
  }
  return t;
}

GltfContent Reading::run() {
  Transform to_metres = placed({}, {0.0, 0.0, 0.0, 1.0}, {unit_, unit_, unit_});
  // Depth first in file order, on a list rather than the call stack: trees from outside may be deep.
  struct Waiting {
    std::size_t node;
    Transform parent;
  };
  std::vector<Waiting> waiting;
  std::vector<bool> seen(model_.nodes.size(), false);
  const auto add = [&](const std::vector<int>& nodes, const Transform& parent, const std::string& pointer) {
    for (std::size_t i = nodes.size(); i-- > 0;) {
      element(gltf_, model_.nodes, nodes[i], item(pointer, i));
      waiting.push_back({static_cast<std::size_t>(nodes[i]), parent});
    }
  };
  if (!model_.scenes.empty()) {
    const int scene = model_.defaultScene < 0 ? 0 : model_.defaultScene;
    const std::string pointer = item("/scenes", scene) + "/nodes";
    add(element(gltf_, model_.scenes, scene, "/scene").nodes, to_metres, pointer);
  } else {
    // No scene: everything that hangs below nothing.
    std::vector<bool> child(model_.nodes.size(), false);
    for (std::size_t n = 0; n < model_.nodes.size(); ++n) {
      for (std::size_t i = 0; i < model_.nodes[n].children.size(); ++i) {
        const int index = model_.nodes[n].children[i];
        element(gltf_, model_.nodes, index, item(item("/nodes", n) + "/children", i));
        child[static_cast<std::size_t>(index)] = true;
      }
    }
    std::vector<int> roots;
    for (std::size_t n = 0; n < child.size(); ++n) {
      if (!child[n]) roots.push_back(static_cast<int>(n));
    }
    add(roots, to_metres, "/nodes");
  }
  while (!waiting.empty()) {
    const Waiting next = waiting.back();
    waiting.pop_back();
    const std::string pointer = item("/nodes", next.node);
    if (seen[next.node]) throw gltf_.fault(pointer, "a node in two places of the tree", "a strict tree of nodes");
    seen[next.node] = true;
    const Transform to_world = next.parent * transform_of(next.node, pointer);
    add_node(next.node, to_world);
    add(model_.nodes[next.node].children, to_world, pointer + "/children");
  }
  note_unsupported();
  return {camera_, !poses_.empty()};
}

void Reading::add_node(std::size_t index, const Transform& to_world) {
  const tinygltf::Node& node = model_.nodes[index];
  const std::string pointer = item("/nodes", index);
  if (node.skin >= 0) ignored_.insert("skins");
  if (node.mesh >= 0) {
    const tinygltf::Mesh& mesh = element(gltf_, model_.meshes, node.mesh, pointer + "/mesh");
    const std::string mesh_pointer = item("/meshes", node.mesh) + "/primitives";
    for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
      add_primitive(mesh.primitives[i], node.name.empty() ? mesh.name : node.name, to_world, item(mesh_pointer, i));
    }
  }
  if (node.camera >= 0) add_camera(node.camera, to_world, pointer);
  if (const auto light = node.extensions.find("KHR_lights_punctual"); light != node.extensions.end()) {
    const std::string light_pointer = pointer + "/extensions/KHR_lights_punctual/light";
    const tinygltf::Value& number = light->second.Get("light");
    if (!number.IsInt()) throw gltf_.fault(light_pointer, "no index", "the index of a light");
    add_light(number.GetNumberAsInt(), to_world, light_pointer);
  }
}

std::vector<std::array<std::uint32_t, 3>> Reading::triangles(const tinygltf::Primitive& primitive, std::size_t vertices,
                                                             const std::string& pointer) {
  std::vector<std::uint32_t> order;
  if (primitive.indices >= 0) {
    order = read_indices(gltf_, primitive.indices, pointer + "/indices");
  } else {
    order.resize(vertices);
    for (std::size_t i = 0; i < vertices; ++i) order[i] = static_cast<std::uint32_t>(i);
  }
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (order[i] < vertices) continue;
    throw gltf_.fault(pointer + "/indices",
                      "the vertex " + std::to_string(order[i]) + " in element " + std::to_string(i),
                      "less than the number of vertices, " + std::to_string(vertices));
  }
  std::vector<std::array<std::uint32_t, 3>> result;
  const auto push = [&](std::size_t a, std::size_t b, std::size_t c) {
    const std::array<std::uint32_t, 3> t{order[a], order[b], order[c]};
    // Strips turn corners with triangles that repeat a vertex: they have no area.
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) result.push_back(t);
  };
  const std::size_t n = order.size();
  if (primitive.mode == TINYGLTF_MODE_TRIANGLES) {
    if (n % 3 != 0) ignored_.insert("the last one or two corners of a triangle list");
    result.reserve(n / 3);
    for (std::size_t i = 0; i + 2 < n; i += 3) push(i, i + 1, i + 2);
  } else if (primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP) {
    for (std::size_t i = 0; i + 2 < n; ++i) push(i, i + 1 + i % 2, i + 2 - i % 2);
  } else {
    for (std::size_t i = 1; i + 1 < n; ++i) push(i, i + 1, 0);
  }
  triangle_count_ += result.size();
  if (triangle_count_ > most_elements) {
    throw gltf_.fault(pointer, "a scene of more than " + std::to_string(most_elements) + " triangles", "fewer");
  }
  return result;
}

void Reading::add_primitive(const tinygltf::Primitive& primitive, const std::string& name, const Transform& to_world,
                            const std::string& pointer) {
  if (primitive.mode < TINYGLTF_MODE_POINTS || primitive.mode > TINYGLTF_MODE_TRIANGLE_FAN) {
    throw gltf_.fault(pointer + "/mode", std::to_string(primitive.mode), "a number from 0 to 6");
  }
  if (primitive.mode < TINYGLTF_MODE_TRIANGLES) {
    ignored_.insert("points and lines");
    return;
  }
  const auto attribute = [&](const std::string& key) {
    const auto found = primitive.attributes.find(key);
    return found == primitive.attributes.end() ? -1 : found->second;
  };
  const std::string attributes = pointer + "/attributes";
  if (attribute("POSITION") < 0) {
    ignored_.insert("primitives without positions");
    return;
  }
  if (!primitive.targets.empty()) ignored_.insert("morph targets");
  if (attribute("COLOR_0") >= 0) ignored_.insert("vertex colours");

  const int position_accessor = attribute("POSITION");
  const auto& accessor = element(gltf_, model_.accessors, position_accessor, attributes + "/POSITION");
  vertex_count_ += std::min(accessor.count, most_elements + 1);
  if (vertex_count_ > most_elements) {
    throw gltf_.fault(pointer, "a scene of more than " + std::to_string(most_elements) + " vertices", "fewer");
  }
  Mesh mesh;
  mesh.name = name;
  mesh.positions = read_vectors<3>(gltf_, position_accessor, attributes + "/POSITION");
  mesh.triangles = triangles(primitive, mesh.positions.size(), pointer);
  if (mesh.triangles.empty()) return;
  if (to_world.determinant() < 0.0) {
    for (auto& t : mesh.triangles) std::swap(t[1], t[2]);  // keeps fronts fronts in a mirror
  }
  for (auto& p : mesh.positions) {
    const Vector q = to_world.point({p[0], p[1], p[2]});
    if (!(std::max({std::fabs(q.x), std::fabs(q.y), std::fabs(q.z)}) <= largest_coordinate)) {
      throw gltf_.fault(pointer, "a vertex beyond 1e15 m", "coordinates within 1e15 m");
    }
    p = {static_cast<float>(q.x), static_cast<float>(q.y), static_cast<float>(q.z)};
  }
  const auto check_count = [&](std::size_t count, const std::string& key) {
    if (count != mesh.positions.size()) {
      throw gltf_.fault(attributes + "/" + key, std::to_string(count) + " elements",
                        std::to_string(mesh.positions.size()) + ", as many as positions");
    }
  };
  if (attribute("NORMAL") >= 0) {
    mesh.normals = read_vectors<3>(gltf_, attribute("NORMAL"), attributes + "/NORMAL");
    check_count(mesh.normals.size(), "NORMAL");
    for (auto& n : mesh.normals) {
      const Vector m = to_world.normal({n[0], n[1], n[2]});
      const double size = length(m);
      // A normal that a flattening node took away stays zero; Geometry then uses the triangle's own.
      const Vector u = size > 0.0 && std::isfinite(size) ? m / size : Vector{};
      n = {static_cast<float>(u.x), static_cast<float>(u.y), static_cast<float>(u.z)};
    }
  }
  const MaterialUse& use = materials_.use(primitive.material, pointer + "/material");
  mesh.material = use.index;
  for (const UvUse& wanted : use.uv_sets) {
    auto& uvs = mesh.uvs.emplace_back();
    const std::string key = "TEXCOORD_" + std::to_string(wanted.texture_set);
    if (attribute(key) < 0) {
      ignored_.insert("textures of meshes without texture coordinates");
      continue;
    }
    uvs = read_vectors<2>(gltf_, attribute(key), attributes + "/" + key);
    check_count(uvs.size(), key);
    for (auto& uv : uvs) {
      const Vector t = wanted.transform.point({uv[0], uv[1], 0.0});
      uv = {static_cast<float>(t.x), static_cast<float>(t.y)};
    }
  }
  if (use.bends_normals && attribute("TANGENT") >= 0) {
    mesh.tangents = read_vectors<4>(gltf_, attribute("TANGENT"), attributes + "/TANGENT");
    check_count(mesh.tangents.size(), "TANGENT");
    const float side = to_world.determinant() < 0.0 ? -1.0F : 1.0F;
    for (auto& t : mesh.tangents) {
      const Vector m = to_world.vector({t[0], t[1], t[2]});
      const double size = length(m);
      const Vector u = size > 0.0 && std::isfinite(size) ? m / size : Vector{};
      t = {static_cast<float>(u.x), static_cast<float>(u.y), static_cast<float>(u.z), t[3] * side};
    }
  }
  scene_.meshes.push_back(std::move(mesh));
}

void Reading::add_light(int index, const Transform& to_world, const std::string& pointer) {
  const tinygltf::Light& light = element(gltf_, model_.lights, index, pointer);
  const std::string here = item("/extensions/KHR_lights_punctual/lights", index);
  if (!(light.intensity >= 0.0 && light.intensity <= 1e30))
    throw gltf_.fault(here + "/intensity", "a number out of range", "a number of at least 0");
  Spectrum power = Spectrum::grey(light.intensity);
  for (std::size_t i = 0; i < 3 && light.color.size() == 3; ++i) {
    if (!(light.color[i] >= 0.0 && light.color[i] <= 1e6))
      throw gltf_.fault(here + "/color", "a number out of range", "numbers from 0 to 1");
    power[i] *= light.color[i];
  }
  const Vector position = to_world.origin;
  if (light.range > 0.0) ignored_.insert("the range of lights (light does not end)");
  if (light.type == "point") {
    scene_.points.push_back({position, power});
  } else if (light.type == "directional") {
    scene_.suns.push_back({unit_vector(-to_world.z, pointer), power, 0.0});
  } else if (light.type == "spot") {
    const double inner = light.spot.innerConeAngle * degrees, outer = light.spot.outerConeAngle * degrees;
    if (!(inner >= 0.0 && inner <= outer && outer > 0.0 && outer <= 90.0 + 1e-4)) {
      throw gltf_.fault(here + "/spot", "cone angles out of range",
                        "0 <= innerConeAngle <= outerConeAngle <= pi / 2, and outerConeAngle above 0");
    }
    scene_.spots.push_back(
        {position, unit_vector(-to_world.z, pointer), power, std::min(inner, 90.0), std::min(outer, 90.0)});
  } else {
    throw gltf_.fault(here + "/type", "the kind " + in_quotes(light.type),
                      one_of(light.type, {"point", "spot", "directional"}));
  }
}

void Reading::add_camera(int index, const Transform& to_world, const std::string& pointer) {
  const tinygltf::Camera& from = element(gltf_, model_.cameras, index, pointer + "/camera");
  if (from.type != "perspective") {
    ignored_.insert("orthographic cameras");
    return;
  }
  if (camera_) return;
  const double fov = from.perspective.yfov * degrees, aspect = from.perspective.aspectRatio;
  const std::string here = item("/cameras", index) + "/perspective";
  if (!(fov > 0.0 && fov < 180.0))
    throw gltf_.fault(here + "/yfov", "a number out of range", "a number above 0 and below pi");
  GltfCamera result;
  result.camera.position = to_world.origin;
  result.camera.look_at = to_world.origin + unit_vector(-to_world.z, pointer);
  result.camera.up = unit_vector(to_world.y, pointer);
  result.camera.vertical_fov = fov;
  if (length(cross(to_world.y, to_world.z)) <= 1e-9 * length(to_world.y) * length(to_world.z)) {
    throw gltf_.fault(pointer, "a transformation that leaves the camera no upright", "one that can be undone");
  }
  if (aspect > 0.0 && std::isfinite(aspect)) result.aspect = aspect;
  camera_ = result;
}

void Reading::note_unsupported() {
  for (const std::string& name : model_.extensionsUsed) {
    if (name != "KHR_lights_punctual" && name != "KHR_materials_emissive_strength" && name != "KHR_texture_transform" &&
        name != "KHR_mesh_quantization" && name != "KHR_materials_ior") {
      ignored_.insert("the extension " + in_quotes(name));
    }
  }
  for (const std::string& what : ignored_) scene_.warnings.push_back(place(gltf_.json.file) + ": ignored: " + what);
}

GltfContent load(Scene& scene, const std::filesystem::path& file, std::span<const std::uint8_t> bytes,
                 const GltfOptions& options) {
  try {
    const GltfModel gltf = parse_gltf(file, bytes, options.allow_path);
    return Reading(gltf, scene, options).run();
  } catch (const std::bad_alloc&) {
    throw Fault(place(file.string()), "a file that asks for too much memory", "a smaller one");
  }
}

}  // namespace

GltfContent add_gltf(Scene& scene, const std::filesystem::path& file, const GltfOptions& options) {
  refuse_other_kinds(file, FileKind::model);
  const std::vector<std::uint8_t> bytes = read_whole_file(file);
  rehearse(place(file.string()), "a sound glTF 2.0 file", [&] {
    Scene scratch;
    load(scratch, file, bytes, options);
  });
  return load(scene, file, bytes, options);
}

}  // namespace tyndall
