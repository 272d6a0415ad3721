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

/// What a material means for the primitives that carry it.
struct MaterialUse {
  int index = -1;         // in Scene::materials
  int texture_set = 0;    // n of TEXCOORD_n
  Transform texture_map;  // KHR_texture_transform, on (u, v, 0)
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
  Spectrum read_emission(const tinygltf::Material& from, const std::string& pointer);
  void read_texture_map(const tinygltf::TextureInfo& info, MaterialUse& use, const std::string& pointer);
  Spectrum color(const std::vector<double>& values, double most, const std::string& pointer) const;
  double fraction(double value, const std::string& pointer) const;
  double number(const tinygltf::Value& value, const std::string& pointer) const;
  int color_texture(int texture, const std::string& pointer);
  Spectrum mean_of(int texture, bool srgb, const std::string& pointer);
  int picture(int texture, const std::string& pointer);
  const Decoded<std::uint8_t>& pixels(int image);

  const GltfModel& gltf_;
  Scene& scene_;
  std::set<std::string>& ignored_;
  std::map<int, MaterialUse> known_;
  std::map<std::tuple<int, int, int>, int> textures_;  // (image, wrap by u, by v) to Scene::textures
  int decoded_ = -1;                                   // the image that is in pixels_
  Decoded<std::uint8_t> pixels_;
};

}  // namespace tyndall
