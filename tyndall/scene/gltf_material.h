#pragma once
// Materials of a glTF file and the pictures they use. For gltf.cc only, like gltf_model.h.
#include <map>
#include <set>
#include <string>
#include <tuple>

#include "tyndall/image/decode.h"
#include "tyndall/scene/gltf_model.h"
#include "tyndall/scene/scene.h"
#include "tyndall/scene/transform.h"

namespace tyndall {

/// A set of texture coordinates that a material asks for.
struct UvUse {
  int texture_set = 0;  // n of TEXCOORD_n
  Transform transform;  // KHR_texture_transform, on (u, v, 0)
};

/// What a material means for the primitives that carry it.
struct MaterialUse {
  int index = -1;              // in Scene::materials
  std::vector<UvUse> uv_sets;  // by Map::uv_set
  bool bends_normals = false;
};

/// Turns materials into the scene's, each when it is first used.
class GltfMaterials {
 public:
  /// What is not done is added to `ignored`.
  GltfMaterials(const GltfModel& gltf, Scene& scene, std::set<std::string>& ignored)
      : gltf_(gltf), scene_(scene), ignored_(ignored) {}

  /// The material of an index named at `pointer`; -1 is the default one. Throws Fault.
  const MaterialUse& use(int index, const std::string& pointer);

 private:
  Material read(const tinygltf::Material& from, MaterialUse& use, const std::string& pointer);
  void read_alpha(const tinygltf::Material& from, Material& into, const std::string& pointer);
  double read_strength(const tinygltf::Material& from, const std::string& pointer);
  double read_ior(const tinygltf::Material& from, const std::string& pointer);
  /// The map that a texture makes; what its numbers stand for: sRGB codes or linear numbers.
  enum class Codes { srgb, linear };
  template <class Info>
  Map read_map(const Info& info, Codes codes, MaterialUse& use, const std::string& pointer);
  UvUse read_uv_use(int texture_set, const tinygltf::ExtensionMap& extensions, const std::string& pointer);
  Spectrum color(const std::vector<double>& values, double most, const std::string& pointer) const;
  double fraction(double value, const std::string& pointer) const;
  double number(const tinygltf::Value& value, const std::string& pointer) const;
  int texture(int index, Codes codes, const std::string& pointer);
  int picture(int texture, const std::string& pointer);
  const Decoded<std::uint8_t>& pixels(int image);

  const GltfModel& gltf_;
  Scene& scene_;
  std::set<std::string>& ignored_;
  std::map<int, MaterialUse> known_;
  std::map<std::tuple<int, int, int, Codes>, int> textures_;  // (image, wrap by u, by v, codes) to Scene::textures
  int decoded_ = -1;                                          // the image that is in pixels_
  Decoded<std::uint8_t> pixels_;
};

}  // namespace tyndall
