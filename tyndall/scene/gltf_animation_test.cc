#include "tyndall/scene/gltf_animation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tyndall/document/fault.h"
#include "tyndall/scene/glb_fixture.h"
#include "tyndall/scene/gltf.h"
#include "tyndall/scene/scene_file.h"

namespace tyndall {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using tests::Folder;
using tests::Glb;

/// A triangle that one animation moves: `path` has these keys.
struct Moved : Glb {
  int triangle = node({{"mesh", triangle_mesh()}, {"name", "triangle"}, {"translation", {9, 9, 9}}});

  int samplers() {
    if (!json.contains("animations")) add("animations", {{"channels", json::array()}, {"samplers", json::array()}});
    return static_cast<int>(json["animations"].back()["samplers"].size());
  }
  void keys(const std::string& path, const std::vector<float>& times, const std::vector<float>& values,
            const std::string& interpolation = "LINEAR", int target = -1) {
    const int sampler = samplers(), width = path == "rotation" ? 4 : 3;
    const int input = accessor<float>(times, 1), output = accessor<float>(values, width);
    auto& animation = json["animations"].back();
    animation["samplers"].push_back({{"input", input}, {"output", output}, {"interpolation", interpolation}});
    animation["channels"].push_back(
        {{"sampler", sampler}, {"target", {{"node", target < 0 ? triangle : target}, {"path", path}}}});
  }
  Scene at(double time, double meters_per_unit = 1.0) const {
    const Folder folder;
    Scene scene;
    EXPECT_TRUE(add_gltf(scene, folder.put("moved.glb", bytes()), {meters_per_unit, false, time}).moves);
    return scene;
  }
  /// A corner of the triangle, stored at (0, 0, 0), (1, 0, 0), (0, 1, 0).
  Vector corner(double time, std::size_t which = 0) const {
    const Scene scene = at(time);
    const auto& p = scene.meshes[0].positions[which];
    return {p[0], p[1], p[2]};
  }
  std::string fault() const {
    try {
      at(0.5);
    } catch (const Fault& fault) {
      return fault.what();
    }
    return "";
  }
  std::vector<std::string> warnings() const { return at(0.5).warnings; }
};

void expect_near(const Vector& a, const Vector& b) {
  EXPECT_LT(length(a - b), 1e-6) << a.x << ' ' << a.y << ' ' << a.z;
}

TEST(GltfAnimation, GoesStraightFromKeyToKeyAndStaysBeforeAndAfter) {
  Moved glb;
  glb.keys("translation", {1, 2, 4}, {0, 0, 0, 2, 0, 0, 2, 4, 0});
  for (const auto& [time, place] : {std::pair{-3.0, Vector{0, 0, 0}},
                                    {1.0, {0, 0, 0}},
                                    {1.25, {0.5, 0, 0}},
                                    {2.0, {2, 0, 0}},
                                    {3.0, {2, 2, 0}},
                                    {4.0, {2, 4, 0}},
                                    {99.0, {2, 4, 0}}}) {
    expect_near(glb.corner(time), place);
  }
  EXPECT_EQ(glb.at(1.25, 10.0).meshes[0].positions[0][0], 5.0f);
}

TEST(GltfAnimation, LeavesTheRestOfANodeAsItIs) {
  Moved glb;
  glb.keys("scale", {0, 1}, {1, 1, 1, 3, 3, 3});
  expect_near(glb.corner(1.0, 1), {12, 9, 9});
}

TEST(GltfAnimation, StepsHoldAKeyUntilTheNext) {
  Moved glb;
  glb.keys("translation", {0, 1}, {0, 0, 0, 5, 0, 0}, "STEP");
  expect_near(glb.corner(0.999), {0, 0, 0});
  expect_near(glb.corner(1.0), {5, 0, 0});
}

TEST(GltfAnimation, CubicSplinesAreHermites) {
  // x = t^3 from 0 to 2 s: slopes 0 and 12.
  Moved glb;
  glb.keys("translation", {0, 2}, {0, 0, 0, 0, 0, 0, 0, 0, 0, 12, 0, 0, 8, 0, 0, 0, 0, 0}, "CUBICSPLINE");
  for (const double t : {0.0, 0.3, 1.0, 1.7, 2.0, 3.0})
    expect_near(glb.corner(t), {std::pow(std::min(t, 2.0), 3), 0, 0});
}

TEST(GltfAnimation, RotationsGoTheShorterWayAtEvenSpeed) {
  // Two unit quaternions about Z, the second written with the other sign: 0 and 120 degrees.
  const float half = std::numbers::pi_v<float> / 3.0f;
  Moved glb;
  glb.json["nodes"][0].erase("translation");
  glb.keys("rotation", {0, 1}, {0, 0, 0, 1, 0, 0, -std::sin(half), -std::cos(half)});
  for (const double t : {0.0, 0.25, 0.5, 1.0}) {
    const double angle = 2.0 * half * t;
    expect_near(glb.corner(t, 1), {std::cos(angle), std::sin(angle), 0});
  }
}

TEST(GltfAnimation, MovesLampsAndCamerasBelowTheNode) {
  Moved glb;
  const int lamp = glb.light({{"type", "point"}, {"intensity", 5}});
  glb.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.1}}}});
  const int below = glb.add(
      "nodes",
      {{"extensions", {{"KHR_lights_punctual", {{"light", lamp}}}}}, {"camera", 0}, {"translation", {0, 0, 1}}});
  glb.json["nodes"][0]["children"] = {below};
  glb.keys("translation", {0, 1}, {0, 0, 0, 4, 0, 0});
  const Folder folder;
  Scene scene;
  const GltfContent content = add_gltf(scene, folder.put("moved.glb", glb.bytes()), {1.0, false, 0.5});
  expect_near(scene.points.at(0).position, {2, 0, 1});
  expect_near(content.camera->camera.position, {2, 0, 1});
  EXPECT_TRUE(content.moves);
}

TEST(GltfAnimation, FilesWithoutMovedNodesDoNotMove) {
  Moved glb;
  const Folder folder;
  Scene scene;
  EXPECT_FALSE(add_gltf(scene, folder.put("still.glb", glb.bytes()), {1.0, false, 2.0}).moves);
  glb.keys("weights", {0, 1}, {0, 0, 0, 1, 1, 1});
  EXPECT_FALSE(add_gltf(scene, folder.put("morphs.glb", glb.bytes())).moves);
  EXPECT_THAT(scene.warnings, testing::Contains(HasSubstr("ignored: animations of morph targets")));
}

TEST(GltfAnimation, SaysWhatItDoesNotFollow) {
  Moved glb;
  glb.keys("translation", {0, 1}, {0, 0, 0, 1, 0, 0});
  glb.keys("translation", {0, 1}, {7, 7, 7, 7, 7, 7});
  glb.keys("pointer", {0, 1}, {0, 0, 0, 1, 0, 0});
  EXPECT_THAT(glb.warnings(), testing::Contains(HasSubstr("a second animation of what one moves already")));
  EXPECT_THAT(glb.warnings(), testing::Contains(HasSubstr("animations of what is no node")));
  expect_near(glb.corner(0.5), {0.5, 0, 0});
}

TEST(GltfAnimation, KeysThatAreNoneAreFaultsWithTheirPlace) {
  const auto with = [](auto change) {
    Moved glb;
    glb.keys("translation", {0, 1}, {0, 0, 0, 1, 0, 0});
    change(glb);
    return glb.fault();
  };
  const auto keys = [](std::vector<float> times, std::vector<float> values, const char* how = "LINEAR") {
    return [=](Moved& glb) {
      glb.json.erase("animations");
      glb.keys("translation", times, values, how);
    };
  };
  EXPECT_THAT(with(keys({0, 1, 1}, {0, 0, 0, 1, 1, 1, 2, 2, 2})), HasSubstr("not after the one before it"));
  EXPECT_THAT(with(keys({0, 1}, {0, 0, 0})), HasSubstr("/animations/0/samplers/0/output: found 1 values, expected 2"));
  EXPECT_THAT(with(keys({0, 1}, {0, 0, 0, 1, 1, 1}, "CUBICSPLINE")), HasSubstr("expected 6"));
  EXPECT_THAT(with(keys({}, {})), HasSubstr("at least one key"));
  EXPECT_THAT(with(keys({0, 1}, {0, 0, 0, 1, 1, 1}, "LINEER")), HasSubstr("did you mean \"LINEAR\"?"));
  EXPECT_THAT(with(keys({0, std::nanf("")}, {0, 0, 0, 1, 1, 1})), HasSubstr("not finite"));
  EXPECT_THAT(with([](Moved& glb) {
                glb.json["nodes"][0] = {{"mesh", 0}, {"matrix", std::vector<int>(16, 1)}};
              }),
              HasSubstr("/nodes/0/matrix: found a matrix on a node that /animations/0/channels/0 moves"));
  EXPECT_THAT(with([](Moved& glb) { glb.json["animations"][0]["channels"][0]["sampler"] = 4; }),
              HasSubstr("/animations/0/channels/0/sampler: found the index 4"));
  EXPECT_THAT(with([](Moved& glb) { glb.json["animations"][0]["channels"][0]["target"]["node"] = 4; }),
              HasSubstr("/animations/0/channels/0/target/node: found"));
  EXPECT_THAT(with([](Moved& glb) { glb.json["animations"][0].erase("samplers"); }), HasSubstr("/animations/0"));
}

TEST(SceneInTime, ReadsAnewOnlyWhatMoves) {
  const Folder folder;
  Moved glb;
  glb.keys("translation", {0, 1}, {0, 0, 0, 4, 0, 0});
  glb.light({{"type", "point"}, {"intensity", 5}});
  folder.put("moved.glb", glb.bytes());
  const auto file =
      folder.put("s.scene.json", std::string(R"({"format": "tyndall-scene/1", "fps": 10, "geometry": ["moved.glb"],
      "lights": [{"type": "environment", "radiance": 1}]})"));
  SceneInTime scene = read_scene_in_time(file, {{}, false, 0.0, 5});
  EXPECT_TRUE(scene.moves);
  EXPECT_EQ(scene.scene.meshes[0].positions[0][0], 2.0f);
  const Camera camera = scene.scene.camera;
  scene.scene.film.width = 77;
  EXPECT_FALSE(set_time(scene, 0.5));
  EXPECT_TRUE(set_time(scene, 1.0));
  EXPECT_EQ(scene.scene.meshes[0].positions[0][0], 4.0f);
  EXPECT_EQ(scene.scene.time, 1.0);
  EXPECT_EQ(scene.scene.film.width, 77);
  EXPECT_EQ(scene.scene.camera.position, camera.position) << "a camera that nobody states does not follow";
  folder.put("moved.glb", std::string("glTF"));
  EXPECT_THROW(set_time(scene, 0.0), Fault);
}

}  // namespace
}  // namespace tyndall
