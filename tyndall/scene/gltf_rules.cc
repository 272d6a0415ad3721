#include "tyndall/scene/gltf_rules.h"

#include <functional>
#include <string_view>

#include "tyndall/document/spelling.h"

namespace tyndall {
namespace {

enum class Kind { objects, object, texts, text, flag, number, numbers, whole, index, indices };
enum class Presence { optional, required };
using enum Kind;
using enum Presence;

/// A member `key` of each object at `owner`, where "*" stands for every element or member.
struct Rule {
  std::string_view owner, key;
  Kind kind;
  Presence presence = optional;
  std::string_view list = {};  // that an index points into
  std::size_t count = 0;       // of numbers
};

constexpr std::string_view lights = "/extensions/KHR_lights_punctual/lights";

// glTF 2.0, section 5 (properties reference), and the texts of the extensions. Owners before what they own.
constexpr Rule rules[] = {
    {"", "asset", object, required},
    {"", "extensions", object},
    {"", "extensionsUsed", texts},
    {"", "scenes", objects},
    {"", "nodes", objects},
    {"", "meshes", objects},
    {"", "materials", objects},
    {"", "textures", objects},
    {"", "images", objects},
    {"", "samplers", objects},
    {"", "cameras", objects},
    {"", "accessors", objects},
    {"", "bufferViews", objects},
    {"", "buffers", objects},
    {"", "animations", objects},
    {"", "skins", objects},
    {"", "scene", index, optional, "/scenes"},
    {"/asset", "version", text, required},
    {"/extensions", "KHR_lights_punctual", object},
    {"/extensions/KHR_lights_punctual", "lights", objects},

    {"/scenes/*", "name", text},
    {"/scenes/*", "nodes", indices, optional, "/nodes"},
    {"/nodes/*", "name", text},
    {"/nodes/*", "children", indices, optional, "/nodes"},
    {"/nodes/*", "mesh", index, optional, "/meshes"},
    {"/nodes/*", "camera", index, optional, "/cameras"},
    {"/nodes/*", "skin", index, optional, "/skins"},
    {"/nodes/*", "matrix", numbers, optional, {}, 16},
    {"/nodes/*", "translation", numbers, optional, {}, 3},
    {"/nodes/*", "rotation", numbers, optional, {}, 4},
    {"/nodes/*", "scale", numbers, optional, {}, 3},
    {"/nodes/*", "extensions", object},
    {"/nodes/*/extensions", "KHR_lights_punctual", object},
    {"/nodes/*/extensions/KHR_lights_punctual", "light", index, required, lights},

    {"/extensions/KHR_lights_punctual/lights/*", "name", text},
    {"/extensions/KHR_lights_punctual/lights/*", "type", text, required},
    {"/extensions/KHR_lights_punctual/lights/*", "color", numbers, optional, {}, 3},
    {"/extensions/KHR_lights_punctual/lights/*", "intensity", number},
    {"/extensions/KHR_lights_punctual/lights/*", "range", number},
    {"/extensions/KHR_lights_punctual/lights/*", "spot", object},
    {"/extensions/KHR_lights_punctual/lights/*/spot", "innerConeAngle", number},
    {"/extensions/KHR_lights_punctual/lights/*/spot", "outerConeAngle", number},

    {"/cameras/*", "name", text},
    {"/cameras/*", "type", text, required},
    {"/cameras/*", "perspective", object},
    {"/cameras/*", "orthographic", object},
    {"/cameras/*/perspective", "yfov", number, required},
    {"/cameras/*/perspective", "znear", number, required},
    {"/cameras/*/perspective", "zfar", number},
    {"/cameras/*/orthographic", "xmag", number, required},
    {"/cameras/*/orthographic", "ymag", number, required},
    {"/cameras/*/orthographic", "znear", number, required},
    {"/cameras/*/orthographic", "zfar", number, required},
    {"/cameras/*/perspective", "aspectRatio", number},

    {"/meshes/*", "name", text},
    {"/meshes/*", "primitives", objects, required},
    {"/meshes/*/primitives/*", "attributes", object, required},
    {"/meshes/*/primitives/*", "indices", index, optional, "/accessors"},
    {"/meshes/*/primitives/*", "material", index, optional, "/materials"},
    {"/meshes/*/primitives/*", "mode", whole},
    {"/meshes/*/primitives/*", "targets", objects},
    {"/meshes/*/primitives/*/attributes", "*", index, optional, "/accessors"},

    {"/accessors/*", "name", text},
    {"/accessors/*", "bufferView", index, optional, "/bufferViews"},
    {"/accessors/*", "byteOffset", whole},
    {"/accessors/*", "componentType", whole, required},
    {"/accessors/*", "normalized", flag},
    {"/accessors/*", "count", whole, required},
    {"/accessors/*", "type", text, required},
    {"/accessors/*", "sparse", object},
    {"/accessors/*/sparse", "count", whole, required},
    {"/accessors/*/sparse", "indices", object, required},
    {"/accessors/*/sparse", "values", object, required},
    {"/accessors/*/sparse/indices", "bufferView", index, required, "/bufferViews"},
    {"/accessors/*/sparse/indices", "byteOffset", whole},
    {"/accessors/*/sparse/indices", "componentType", whole, required},
    {"/accessors/*/sparse/values", "bufferView", index, required, "/bufferViews"},
    {"/accessors/*/sparse/values", "byteOffset", whole},
    {"/bufferViews/*", "name", text},
    {"/bufferViews/*", "buffer", index, required, "/buffers"},
    {"/bufferViews/*", "byteOffset", whole},
    {"/bufferViews/*", "byteLength", whole, required},
    {"/bufferViews/*", "byteStride", whole},
    {"/buffers/*", "name", text},
    {"/buffers/*", "uri", text},
    {"/buffers/*", "byteLength", whole, required},

    {"/animations/*", "name", text},
    {"/animations/*", "channels", objects, required},
    {"/animations/*", "samplers", objects, required},
    {"/animations/*/channels/*", "sampler", whole, required},
    {"/animations/*/channels/*", "target", object, required},
    {"/animations/*/channels/*/target", "node", index, optional, "/nodes"},
    {"/animations/*/channels/*/target", "path", text, required},
    {"/animations/*/samplers/*", "input", index, required, "/accessors"},
    {"/animations/*/samplers/*", "output", index, required, "/accessors"},
    {"/animations/*/samplers/*", "interpolation", text},

    {"/images/*", "name", text},
    {"/images/*", "uri", text},
    {"/images/*", "mimeType", text},
    {"/images/*", "bufferView", index, optional, "/bufferViews"},
    {"/textures/*", "name", text},
    // Files in the wild have textures that lead nowhere and that no material uses: those are looked up on use.
    {"/textures/*", "sampler", whole},
    {"/textures/*", "source", whole},
    {"/samplers/*", "wrapS", whole},
    {"/samplers/*", "wrapT", whole},
    {"/samplers/*", "magFilter", whole},
    {"/samplers/*", "minFilter", whole},

    {"/materials/*", "name", text},
    {"/materials/*", "pbrMetallicRoughness", object},
    {"/materials/*", "normalTexture", object},
    {"/materials/*", "occlusionTexture", object},
    {"/materials/*", "emissiveTexture", object},
    {"/materials/*", "emissiveFactor", numbers, optional, {}, 3},
    {"/materials/*", "alphaMode", text},
    {"/materials/*", "alphaCutoff", number},
    {"/materials/*", "doubleSided", flag},
    {"/materials/*", "extensions", object},
    {"/materials/*/extensions", "KHR_materials_emissive_strength", object},
    {"/materials/*/extensions/KHR_materials_emissive_strength", "emissiveStrength", number},
    {"/materials/*/pbrMetallicRoughness", "baseColorFactor", numbers, optional, {}, 4},
    {"/materials/*/pbrMetallicRoughness", "metallicFactor", number},
    {"/materials/*/pbrMetallicRoughness", "roughnessFactor", number},
    {"/materials/*/pbrMetallicRoughness", "baseColorTexture", object},
    {"/materials/*/pbrMetallicRoughness", "metallicRoughnessTexture", object},
    {"/materials/*/normalTexture", "scale", number},
    {"/materials/*/occlusionTexture", "strength", number},
};

/// Where materials name textures: each has the same members.
constexpr std::string_view texture_owners[] = {
    "/materials/*/pbrMetallicRoughness/baseColorTexture",
    "/materials/*/pbrMetallicRoughness/metallicRoughnessTexture",
    "/materials/*/normalTexture",
    "/materials/*/occlusionTexture",
    "/materials/*/emissiveTexture",
};
constexpr Rule texture_rules[] = {
    {"", "index", index, required, "/textures"},
    {"", "texCoord", whole},
    {"", "extensions", object},
    {"/extensions", "KHR_texture_transform", object},
    {"/extensions/KHR_texture_transform", "offset", numbers, optional, {}, 2},
    {"/extensions/KHR_texture_transform", "scale", numbers, optional, {}, 2},
    {"/extensions/KHR_texture_transform", "rotation", number},
    {"/extensions/KHR_texture_transform", "texCoord", whole},
};

using Visit = std::function<void(const Json& value, const std::string& pointer)>;

/// Visits every value that a path such as "/nodes/*/matrix" names.
void visit(const Json& value, std::string_view path, const std::string& pointer, const Visit& see) {
  if (path.empty()) {
    see(value, pointer);
    return;
  }
  const std::size_t end = std::min(path.find('/', 1), path.size());
  const std::string_view step = path.substr(1, end - 1), rest = path.substr(end);
  if (step != "*") {
    if (!value.is_object()) return;
    const auto found = value.find(std::string(step));
    if (found != value.end()) visit(*found, rest, joined(pointer, step), see);
  } else if (value.is_array()) {
    for (std::size_t i = 0; i < value.size(); ++i) visit(value[i], rest, item(pointer, i), see);
  } else if (value.is_object()) {
    for (const auto& member : value.items()) visit(member.value(), rest, joined(pointer, member.key()), see);
  }
}

class Check {
 public:
  explicit Check(const GltfModel& gltf) : gltf_(gltf) {}

  void operator()(const Rule& rule, std::string_view under = "") const {
    const std::string path = std::string(under).append(rule.owner);
    if (rule.presence == required) {
      visit(gltf_.json.root, path, "", [&](const Json& owner, const std::string& pointer) {
        if (owner.is_object() && !owner.contains(std::string(rule.key))) {
          throw gltf_.fault(pointer, "no key \"" + std::string(rule.key) + '"', expected(rule));
        }
      });
    }
    visit(gltf_.json.root, joined(path, rule.key), "",
          [&](const Json& value, const std::string& pointer) { check(rule, value, pointer); });
  }

 private:
  static bool is_whole(const Json& value) {
    return value.is_number_unsigned() || (value.is_number_integer() && value.get<std::int64_t>() >= 0);
  }

  std::size_t size_of(std::string_view list) const {
    std::size_t size = 0;
    visit(gltf_.json.root, list, "", [&](const Json& found, const std::string&) { size = found.size(); });
    return size;
  }

  std::string expected(const Rule& rule) const {
    switch (rule.kind) {
      case objects:
        return "a list of objects";
      case object:
        return "an object";
      case texts:
        return "a list of texts";
      case text:
        return "a text";
      case flag:
        return "true or false";
      case number:
        return "a number";
      case numbers:
        return "a list of " + std::to_string(rule.count) + " numbers";
      case whole:
        return "a whole number of at least 0";
      default: {
        const std::size_t size = size_of(rule.list);
        const std::string what = rule.kind == indices ? "a list of indices" : "an index";
        if (size == 0) return "no index: there are no " + std::string(rule.list.substr(rule.list.rfind('/') + 1));
        return what + " of " + std::string(rule.list) + ", from 0 to " + std::to_string(size - 1);
      }
    }
  }

  void check(const Rule& rule, const Json& value, const std::string& pointer) const {
    const auto wrong = [&](const Json& what, const std::string& where) {
      return gltf_.fault(where, described(what), expected(rule));
    };
    const auto all = [&](auto good) {
      if (!value.is_array()) throw wrong(value, pointer);
      for (std::size_t i = 0; i < value.size(); ++i) {
        if (!good(value[i])) throw wrong(value[i], item(pointer, i));
      }
    };
    const auto points = [&](const Json& x) { return is_whole(x) && x.get<std::uint64_t>() < size_of(rule.list); };
    const auto one = [&](bool good) {
      if (!good) throw wrong(value, pointer);
    };
    switch (rule.kind) {
      case objects:
        return all([](const Json& x) { return x.is_object(); });
      case texts:
        return all([](const Json& x) { return x.is_string(); });
      case indices:
        return all(points);
      case numbers:
        if (value.is_array() && value.size() != rule.count) throw wrong(value, pointer);
        return all([](const Json& x) { return x.is_number(); });
      case object:
        return one(value.is_object());
      case text:
        return one(value.is_string());
      case flag:
        return one(value.is_boolean());
      case number:
        return one(value.is_number());
      case whole:
        return one(is_whole(value));
      case index:
        return one(points(value));
    }
  }

  const GltfModel& gltf_;
};

}  // namespace

void check_gltf_rules(const GltfModel& gltf) {
  const Check check(gltf);
  for (const Rule& rule : rules) check(rule);
  for (const std::string_view owner : texture_owners) {
    for (const Rule& rule : texture_rules) check(rule, owner);
  }
}

}  // namespace tyndall
