// What breaks the rules of glTF is answered with its pointer, and in a .gltf with its line; tinygltf would pass over
// most of it as if it were not there.
#include "tyndall/scene/gltf_rules.h"

#include <gmock/gmock.h>

#include "tyndall/document/fault.h"
#include "tyndall/scene/glb_fixture.h"
#include "tyndall/scene/gltf.h"

namespace tyndall {
namespace {

using nlohmann::json;
using testing::HasSubstr;

/// A sound model with something of everything.
json sound() {
  tests::Glb glb;
  glb.node({{"mesh", glb.triangle_mesh()}, {"name", "triangle"}, {"translation", {0, 1, 2}}});
  glb.node(
      {{"extensions", {{"KHR_lights_punctual", {{"light", glb.light({{"type", "point"}, {"color", {1, 1, 1}}})}}}}}});
  glb.node(
      {{"camera", glb.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 1.0}, {"znear", 0.1}}}})}});
  glb.add("materials", {{"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, 1}}}}, {"doubleSided", true}});
  glb.json["meshes"][0]["primitives"][0]["material"] = 0;
  json whole = glb.json;
  whole["buffers"] = {{{"byteLength", glb.binary.size()}, {"uri", "data.bin"}}};
  return whole;
}

/// What is said of a .gltf of this text; empty where it is read.
std::string answer(const json& model, int indent = 1) {
  const tests::Folder folder;
  folder.put("data.bin", std::vector<std::uint8_t>(36));
  try {
    Scene scene;
    add_gltf(scene, folder.put("x.gltf", model.dump(indent)));
  } catch (const Fault& fault) {
    return fault.what();
  }
  return "";
}

TEST(GltfRules, ASoundModelIsRead) { EXPECT_EQ(answer(sound()), ""); }

TEST(GltfRules, EveryValueOfTheWrongTypeIsAnsweredWithItsPointer) {
  const struct {
    const char* pointer;
    json value;
    const char* expected;
  } changes[] = {
      {"/asset", 5, "an object"},
      {"/asset/version", 2.0, "a text"},
      {"/extensionsUsed/0", 1, "a list of texts"},
      {"/scene", 1, "an index of /scenes, from 0 to 0"},
      {"/scenes/0/nodes/1", 7, "a list of indices of /nodes, from 0 to 2"},
      {"/scenes/0/name", 42, "a text"},
      {"/nodes/0/mesh", "0", "an index of /meshes"},
      {"/nodes/0/mesh", 0.5, "an index of /meshes"},
      {"/nodes/0/skin", 0, "no index: there are no skins"},
      {"/nodes/0/translation", json::array({0, 1}), "a list of 3 numbers"},
      {"/nodes/0/rotation", json::array({0, 0, 0, 1, 0}), "a list of 4 numbers"},
      {"/nodes/0/matrix", "identity", "a list of 16 numbers"},
      {"/nodes/0/translation/1", nullptr, "a list of 3 numbers"},
      {"/nodes/1/extensions/KHR_lights_punctual/light", 3, "an index of /extensions/KHR_lights_punctual/lights"},
      {"/nodes/1/extensions/KHR_lights_punctual", 0, "an object"},
      {"/nodes/2/camera", -1, "an index of /cameras"},
      {"/extensions/KHR_lights_punctual/lights/0/color", 1, "a list of 3 numbers"},
      {"/extensions/KHR_lights_punctual/lights/0/intensity", "bright", "a number"},
      {"/cameras/0/perspective/yfov", true, "a number"},
      {"/meshes/0/primitives/0", json::array(), "a list of objects"},
      {"/meshes/0/primitives/0/attributes/POSITION", -1, "an index of /accessors"},
      {"/meshes/0/primitives/0/material", 1, "an index of /materials"},
      {"/accessors/0/normalized", 1, "true or false"},
      {"/accessors/0/count", -3, "a whole number of at least 0"},
      {"/bufferViews/0/byteLength", 1e300, "a whole number of at least 0"},
      {"/buffers/0/uri", 1, "a text"},
      {"/materials/0", "grey", "a list of objects"},
      {"/materials/0/pbrMetallicRoughness", json::array({"none"}), "an object"},
      {"/materials/0/pbrMetallicRoughness/metallicFactor", "shiny", "a number"},
      {"/materials/0/doubleSided", "yes", "true or false"},
  };
  for (const auto& [pointer, value, expected] : changes) {
    json model = sound();
    model[json::json_pointer(pointer)] = value;
    const std::string said = answer(model);
    EXPECT_THAT(said, HasSubstr("at " + std::string(pointer) + ": found ")) << value;
    EXPECT_THAT(said, HasSubstr(expected)) << pointer;
    EXPECT_THAT(said, testing::ContainsRegex("x\\.gltf:[0-9]+: at /")) << pointer;
  }
}

TEST(GltfRules, TexturesOfAnyKindNeedAnIndexOfATexture) {
  for (const char* owner : {"/materials/0/normalTexture", "/materials/0/occlusionTexture",
                            "/materials/0/emissiveTexture", "/materials/0/pbrMetallicRoughness/baseColorTexture"}) {
    json model = sound();
    model["textures"] = json::array({json::object()});
    model[json::json_pointer(owner)] = {{"index", -1}};
    EXPECT_THAT(answer(model), HasSubstr("at " + std::string(owner) +
                                         "/index: found the number -1, expected an index "
                                         "of /textures, from 0 to 0"));
    model[json::json_pointer(owner)] = json::object();
    EXPECT_THAT(answer(model), HasSubstr("at " + std::string(owner) + ": found no key \"index\""));
  }
}

TEST(GltfRules, WhatIsMissingIsAnsweredAtItsOwner) {
  for (const auto& [owner, key] : std::initializer_list<std::pair<const char*, const char*>>{
           {"", "asset"},
           {"/meshes/0", "primitives"},
           {"/meshes/0/primitives/0", "attributes"},
           {"/accessors/0", "count"},
           {"/accessors/0", "type"},
           {"/bufferViews/0", "buffer"},
           {"/buffers/0", "byteLength"},
           {"/cameras/0/perspective", "yfov"},
           {"/extensions/KHR_lights_punctual/lights/0", "type"},
           {"/nodes/1/extensions/KHR_lights_punctual", "light"}}) {
    json model = sound();
    model[json::json_pointer(owner)].erase(key);
    EXPECT_THAT(answer(model),
                HasSubstr((*owner == 0 ? "" : "at " + std::string(owner) + ": ") + "found no key \"" + key + '"'))
        << owner;
  }
}

TEST(GltfRules, AFileThatIsNotThereIsAnsweredWhereItIsNamed) {
  json model = sound();
  model["buffers"][0]["uri"] = "no%20such.bin";
  EXPECT_THAT(answer(model), HasSubstr("at /buffers/0/uri: found the file name \"no such.bin\", which does not exist"));
}

}  // namespace
}  // namespace tyndall
