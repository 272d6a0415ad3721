#include "tyndall/scene/scene_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tyndall/image/exr.h"
#include "tyndall/scene/geometry.h"
#include "tyndall/scene/glb_fixture.h"

namespace tyndall {
namespace {

using nlohmann::json;
using tests::Folder;
using tests::Glb;

const char* const fog = R"({"format": "tyndall-medium/1",
  "species": [{"name": "fog", "scattering": 0.02, "absorption": 0.001, "phase": {"law": "henyey_greenstein", "g": 0.8}}]})";

/// Every part of a scene file, lengths in centimetres.
json whole() {
  return json::parse(R"({
    "format": "tyndall-scene/1", "name": "street", "meters_per_unit": 0.01,
    "medium": "air/fog.medium.json",
    "geometry": ["street.glb", {"file": "street.glb", "meters_per_unit": 0.001}],
    "lights": [
      {"type": "point", "position": [100, 200, 300], "intensity": 5},
      {"type": "spot", "position": [0, 400, 0], "direction": [0, -2, 0], "intensity": [1, 2, 3],
       "inner_angle": 10, "outer_angle": 30},
      {"type": "sun", "direction": [1, -1, 0], "irradiance": 1000, "angular_diameter": 0.53},
      {"type": "environment", "radiance": [0.1, 0.2, 0.4], "scale": 2, "rotation": 45}],
    "volumes": [
      {"medium": {"species": [{"scattering": 0.5, "profile": {"law": "exponential", "scale_height": 200}}]},
       "profile": {"law": "box", "min": [-100, 0, -100], "max": [100, 50, 100]}},
      {"medium": "air/fog.medium.json", "profile": {"law": "sphere", "center": [0, 100, 0], "radius": 50}}],
    "camera": {"position": [0, 150, 500], "look_at": [0, 100, 0], "up": [0, 1, 0], "vertical_fov": 50},
    "film": {"width": 320, "height": 200}, "fps": 25,
    "integrator": {"name": "single", "spp": 16, "max_depth": 8}})");
}

struct Files {
  Folder folder;
  Files() {
    folder.put("air/fog.medium.json", std::string(fog));
    Glb glb;
    glb.node({{"mesh", glb.triangle_mesh()}});
    glb.light({{"type", "point"}, {"intensity", 7}});
    glb.node({{"translation", {4, 0, 0}}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    glb.add("cameras",
            {{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.1}, {"aspectRatio", 1.5}}}});
    glb.node({{"camera", 0}, {"translation", {0, 0, 9}}});
    folder.put("street.glb", glb.bytes());
  }
  Scene read(const json& scene, const SceneOptions& options = {}) const {
    return read_scene(folder.put("test.scene.json", scene.dump(1)), options);
  }
  std::string fault_of(const json& scene, const SceneOptions& options = {}) const {
    try {
      read(scene, options);
    } catch (const Fault& fault) {
      return fault.what();
    }
    return "";
  }
};

TEST(SceneFile, EveryPartArrivesInMetres) {
  const Files files;
  const Scene s = files.read(whole());
  EXPECT_EQ(s.meters_per_unit, 0.01);
  ASSERT_EQ(s.meshes.size(), 2U);
  EXPECT_EQ(s.meshes[0].positions[1][0], 1.0F) << "glTF is metres";
  EXPECT_EQ(s.meshes[1].positions[1][0], 0.001F);
  ASSERT_EQ(s.points.size(), 3U);
  EXPECT_EQ(s.points[0].intensity, Spectrum::grey(7));
  EXPECT_EQ(s.points[2].position, (Vector{1, 2, 3}));
  EXPECT_EQ(s.points[2].intensity, Spectrum::grey(5));
  ASSERT_EQ(s.spots.size(), 1U);
  EXPECT_EQ(s.spots[0].position, (Vector{0, 4, 0}));
  EXPECT_EQ(s.spots[0].direction, (Vector{0, -1, 0}));
  EXPECT_EQ(s.spots[0].outer_angle, 30.0);
  ASSERT_EQ(s.suns.size(), 1U);
  EXPECT_NEAR(s.suns[0].direction.x, std::sqrt(0.5), 1e-15);
  EXPECT_EQ(s.suns[0].angular_diameter, 0.53);
  ASSERT_TRUE(s.environment);
  EXPECT_EQ(s.environment->radiance, (Spectrum{{0.1, 0.2, 0.4}}));
  EXPECT_EQ(s.environment->scale, Spectrum::grey(2));
  EXPECT_EQ(s.environment->rotation, 45.0);
  EXPECT_EQ(s.camera.position, (Vector{0, 1.5, 5}));
  EXPECT_EQ(s.camera.look_at, (Vector{0, 1, 0}));
  EXPECT_EQ(s.camera.vertical_fov, 50.0);
  EXPECT_EQ(s.film.width, 320);
  EXPECT_EQ(s.film.height, 200);
  EXPECT_EQ(s.fps, 25.0);
  EXPECT_EQ(s.integrator.name, "single");
  EXPECT_EQ(s.integrator.spp, 16);
  EXPECT_EQ(s.integrator.max_depth, 8);
  EXPECT_TRUE(s.warnings.empty());
}

TEST(SceneFile, VolumesJoinTheMediumEachWithItsProfiles) {
  const Files files;
  const Scene s = files.read(whole());
  ASSERT_EQ(s.medium.species.size(), 3U);
  EXPECT_EQ(s.medium.species[0].name, "fog");
  EXPECT_EQ(s.medium.species[0].scattering, Spectrum::grey(0.02)) << "a referenced medium keeps its own unit: metres";
  EXPECT_TRUE(s.medium.species[0].profiles.empty());
  const Species& box = s.medium.species[1];
  EXPECT_NEAR(box.scattering[0], 50.0, 1e-12) << "a medium in place is in the scene's unit: 0.5 per centimetre";
  ASSERT_EQ(box.profiles.size(), 2U);
  EXPECT_EQ(std::get<ExponentialProfile>(box.profiles[0]).scale_height, 2.0);
  EXPECT_EQ(std::get<BoxProfile>(box.profiles[1]).max, (Vector{1, 0.5, 1}));
  const Species& ball = s.medium.species[2];
  EXPECT_EQ(std::get<SphereProfile>(ball.profiles.at(0)).radius, 0.5);
  EXPECT_EQ(scattering_at(s.medium, {0, 0.8, 0}), Spectrum::grey(0.04)) << "overlap adds";

  json in_metres = whole();
  in_metres["volumes"][0]["medium"]["meters_per_unit"] = 1.0;
  EXPECT_NEAR(files.read(in_metres).medium.species[1].scattering[0], 0.5, 1e-15);
}

TEST(SceneFile, UnitsDoNotChangeTheScene) {
  const Files files;
  const auto scaled = [&](double unit) {
    json j = json::parse(R"({"format": "tyndall-scene/1"})");
    const double f = 1.0 / unit;
    j["meters_per_unit"] = unit;
    j["medium"] = {{"species", {{{"scattering", 0.1 * unit}}}}};
    j["lights"] = {{{"type", "point"}, {"position", {3 * f, 4 * f, 5 * f}}, {"intensity", 2}}};
    j["camera"] = {{"position", {0, 0, 7 * f}}, {"look_at", {0, 1 * f, 0}}};
    return files.read(j);
  };
  const Scene metres = scaled(1.0);
  for (const double unit : {0.01, 1000.0, 0.3048}) {
    const Scene s = scaled(unit);
    EXPECT_NEAR(s.medium.species[0].scattering[1], metres.medium.species[0].scattering[1], 1e-15);
    EXPECT_NEAR(length(s.points[0].position - metres.points[0].position), 0.0, 1e-14);
    EXPECT_NEAR(length(s.camera.look_at - metres.camera.look_at), 0.0, 1e-14);
    EXPECT_EQ(s.points[0].intensity, metres.points[0].intensity);
  }
}

TEST(SceneFile, MediumOptionReplacesTheAirButNotTheVolumes) {
  const Files files;
  SceneOptions options;
  options.medium = files.folder.put(
      "other.medium.json", R"({"format": "tyndall-medium/1", "species": [{"name": "dust", "scattering": 1}]})");
  const Scene s = files.read(whole(), options);
  ASSERT_EQ(s.medium.species.size(), 3U);
  EXPECT_EQ(s.medium.species[0].name, "dust");
  EXPECT_EQ(s.medium.species[2].name, "fog");
  EXPECT_EQ(read_scene(files.folder.path / "street.glb", options).medium.species.at(0).name, "dust");
}

TEST(SceneFile, MediaMayBePresetsAndVariants) {
  const Files files;
  json scene = whole();
  scene["medium"] = "mist";
  scene["volumes"] = json::array();
  const Spectrum mist = files.read(scene).medium.species.at(0).extinction();
  EXPECT_NEAR(mist[1], -std::log(0.05) / 2000.0, 1e-15);
  EXPECT_EQ(files.read(scene, {"mist"}).medium.species.at(0).extinction(), mist);
  // In place, in the scene's centimetres.
  scene["medium"] = {{"base", "mist"}, {"species", {{{"density", {{"visibility", 2e4}}}}}}};
  EXPECT_NEAR(files.read(scene).medium.species.at(0).extinction()[1], -std::log(0.05) / 200.0, 1e-15);
  scene["volumes"] = whole()["volumes"];
  scene["volumes"][1]["medium"] = {{"base", "air/fog.medium.json"}, {"background", {{"air", "note"}}}};
  EXPECT_EQ(files.read(scene).medium.species.size(), 4U);
  EXPECT_EQ(files.read(scene).medium.species.back().name, "fog");
  scene["volumes"][1]["medium"]["base"] = "air/fgo.medium.json";
  EXPECT_NE(files.fault_of(scene).find("at /volumes/1/medium/base: found the file name"), std::string::npos)
      << files.fault_of(scene);
  scene["volumes"] = json::array();
  scene["medium"] = "msit";
  EXPECT_NE(files.fault_of(scene).find("at /medium: found \"msit\""), std::string::npos) << files.fault_of(scene);
  EXPECT_NE(files.fault_of(scene).find("did you mean \"mist\"?"), std::string::npos) << files.fault_of(scene);
}

TEST(SceneFile, MediaWithKeyframesAreTakenAtATime) {
  Files files;
  const char* const keys = R"({"format": "tyndall-medium/1", "meters_per_unit": 0.01, "keyframes": [
    {"time": 0, "conditions": {"model": "simple", "w": 1, "thickness": 1e-4}},
    {"time": 10, "conditions": {"model": "simple", "w": 1, "thickness": 5e-4}}]})";
  files.folder.put("air/fog.medium.json", std::string(keys));
  json scene = whole();
  scene["volumes"][0]["medium"] = json::parse(keys);
  const auto read = [&](const SceneOptions& options) {
    return read_scene_in_time(files.folder.put("test.scene.json", scene.dump(1)), options);
  };
  const auto total = [](const Scene& s) { return s.medium.species.at(0).scattering[1]; };
  EXPECT_NEAR(total(read({}).scene), 0.01, 1e-15);
  SceneInTime timed = read({"", false, 5.0});
  EXPECT_EQ(timed.scene.time, 5.0);
  ASSERT_EQ(timed.scene.medium.species.size(), 3U);
  for (const Species& s : timed.scene.medium.species) EXPECT_NEAR(s.scattering[1], 0.03, 1e-15);
  EXPECT_EQ(timed.scene.medium.species[1].profiles.size(), 1U);
  EXPECT_EQ(read({"", false, 0.0, 125}).scene.time, 5.0);  // 25 pictures a second
  set_time(timed, 25.0);
  EXPECT_EQ(timed.scene.time, 25.0);
  ASSERT_EQ(timed.scene.medium.species.size(), 3U);
  EXPECT_NEAR(total(timed.scene), 0.05, 1e-15);
  EXPECT_EQ(timed.scene.medium.species[2].profiles.size(), 1U);
}

TEST(SceneFile, LightThatStandsInDoesSoAtAllTimes) {
  // Clear at first, endless fog later: an environment would be dark then.
  Files files;
  files.folder.put("clearing.medium.json", R"({"format": "tyndall-medium/1", "keyframes": [
    {"time": 0, "conditions": {"model": "simple", "w": 1, "thickness": 0}},
    {"time": 10, "conditions": {"model": "simple", "w": 1, "thickness": 0.1}}]})");
  Glb dark;
  dark.node({{"mesh", dark.triangle_mesh()}});
  const Scene scene =
      read_scene(files.folder.put("dark.glb", dark.bytes()), {files.folder.path / "clearing.medium.json"});
  EXPECT_TRUE(scene.medium.species.empty());
  EXPECT_FALSE(scene.environment);
  EXPECT_EQ(scene.points.size(), 1U);
}

TEST(SceneFile, GlbAloneIsAScene) {
  const Files files;
  const Scene s = read_scene(files.folder.path / "street.glb");
  EXPECT_EQ(s.meshes.size(), 1U);
  EXPECT_EQ(s.points.size(), 1U);
  EXPECT_FALSE(s.environment);
  EXPECT_EQ(s.camera.position, (Vector{0, 0, 9}));
  EXPECT_NEAR(s.camera.vertical_fov, 0.5 * 180 / std::numbers::pi, 1e-12);
  EXPECT_EQ(s.film.width, 540);
  EXPECT_EQ(s.film.height, 360);
  EXPECT_TRUE(s.medium.species.empty());
  EXPECT_TRUE(s.warnings.empty());
}

TEST(SceneFile, GlbWithoutCameraOrLightGetsBoth) {
  const Folder folder;
  Glb glb;
  glb.node({{"mesh", glb.triangle_mesh()}, {"translation", {1000, 5, 5}}, {"scale", {30, 3, 1}}});
  const Scene s = read_scene(folder.put("bare.glb", glb.bytes()));
  ASSERT_TRUE(s.environment);
  EXPECT_EQ(s.environment->radiance, Spectrum::grey(1.0));
  EXPECT_EQ(s.warnings.size(), 1U);
  // All corners are in the picture, in front of the camera.
  const Vector forward = normalized(s.camera.look_at - s.camera.position);
  const Vector right = normalized(cross(forward, s.camera.up)), up = cross(right, forward);
  const double half = std::tan(s.camera.vertical_fov * std::numbers::pi / 360);
  for (const auto& p : s.meshes[0].positions) {
    const Vector d = Vector{p[0], p[1], p[2]} - s.camera.position;
    EXPECT_GT(dot(d, forward), 0.0);
    EXPECT_LT(std::fabs(dot(d, up) / dot(d, forward)), half);
    EXPECT_LT(std::fabs(dot(d, right) / dot(d, forward)), half * s.film.width / s.film.height);
  }
  EXPECT_TRUE(Geometry(s).intersect({s.camera.position, normalized(Vector{1008, 5.8, 5} - s.camera.position)}));
  EXPECT_NO_THROW(read_scene(folder.put("empty.gltf", R"({"asset": {"version": "2.0"}})")));
}

TEST(SceneFile, EndlessAirLetsNoLightInFromOutside) {
  const Folder folder;
  Glb glb;
  glb.node({{"mesh", glb.triangle_mesh()}});
  const auto file = folder.put("bare.glb", glb.bytes());
  // A lamp stands in, where an environment would leave the picture black.
  const Scene lamp = read_scene(file, {folder.put("fog.medium.json", std::string(fog)), false});
  EXPECT_FALSE(lamp.environment);
  ASSERT_EQ(lamp.points.size(), 1U);
  const Vector middle = Vector{lamp.camera.look_at} - lamp.camera.position;
  EXPECT_LT(length(lamp.points[0].position - lamp.camera.position), 0.5 * length(middle));
  EXPECT_EQ(lamp.warnings.size(), 1U);
  // One that thins out above lets the sky in.
  const auto layer = folder.put("layer.medium.json", R"({"format": "tyndall-medium/1", "species": [
    {"scattering": 0.02, "profile": {"law": "exponential", "scale_height": 10}}]})");
  EXPECT_TRUE(read_scene(file, {layer, false}).environment);
  const auto warnings = [&](const char* medium) {
    json scene = {{"format", "tyndall-scene/1"}, {"medium", medium}};
    scene["lights"] = {{{"type", "sun"}, {"direction", {0, -1, 0}}, {"irradiance", 1}}};
    return read_scene(folder.put("test.scene.json", scene.dump())).warnings;
  };
  ASSERT_EQ(warnings("fog.medium.json").size(), 1U);
  EXPECT_NE(warnings("fog.medium.json")[0].find("endless"), std::string::npos);
  EXPECT_TRUE(warnings("layer.medium.json").empty());
}

TEST(SceneFile, LittleIsNeeded) {
  const Files files;
  const Scene s = files.read(json::parse(R"({"format": "tyndall-scene/1"})"));
  EXPECT_EQ(s.film.width, 640);
  EXPECT_EQ(s.integrator.name, "path");
  EXPECT_EQ(s.fps, 24.0);
  ASSERT_EQ(s.warnings.size(), 1U);
  EXPECT_NE(s.warnings[0].find("no light"), std::string::npos);
  const Scene with_camera = files.read(json::parse(R"({"format": "tyndall-scene/1", "geometry": ["street.glb"]})"));
  EXPECT_EQ(with_camera.camera.position, (Vector{0, 0, 9}));
}

TEST(SceneFile, EnvironmentsComeFromFiles) {
  const Files files;
  Image image{4, 2, {}, {}};
  add_layer(image, "", 0.5F);
  write_exr(files.folder.path / "sky.exr", image);
  json j = json::parse(R"({"format": "tyndall-scene/1", "lights": [{"type": "environment", "file": "sky.exr"}]})");
  const Scene s = files.read(j);
  ASSERT_TRUE(s.environment && s.environment->panorama);
  EXPECT_EQ(s.environment->panorama->width, 4);
  EXPECT_TRUE(s.warnings.empty());
  image = {4, 4, {}, {}};
  add_layer(image, "", 0.5F);
  write_exr(files.folder.path / "sky.exr", image);
  EXPECT_EQ(files.read(j).warnings.size(), 1U) << "a square picture is hardly a latitude-longitude one";
  j["lights"].push_back({{"type", "environment"}, {"radiance", 1}});
  EXPECT_NE(files.fault_of(j).find("/lights/1"), std::string::npos);
}

TEST(SceneFile, MistakesAreAnsweredWithPlaceAndPossibilities) {
  const Files files;
  struct Mistake {
    const char* pointer;
    json value;
    const char* place;
    const char* says;
  };
  const std::vector<Mistake> mistakes{
      {"/format", "tyndall-scene/2", "/format", "tyndall-scene/1"},
      {"/meters_per_unit", 0, "/meters_per_unit", "above 0"},
      {"/geometri", json::array(), "/geometri", "did you mean \"geometry\"?"},
      {"/lights/0/type", "pont", "/lights/0/type", "did you mean \"point\"?"},
      {"/lights/0/intensity", -1, "/lights/0/intensity", "from 0 to 1e+30"},
      {"/lights/0/intensity", {1, 2}, "/lights/0/intensity", "list of 3"},
      {"/lights/1/direction", {0, 0, 0}, "/lights/1/direction", "not all 0"},
      {"/lights/1/inner_angle", 31, "/lights/1/inner_angle", "inner_angle <= outer_angle"},
      {"/lights/1/outer_angle", 91, "/lights/1/outer_angle", "90"},
      {"/lights/2/direction", {0, 0, 0}, "/lights/2/direction", "not all 0"},
      {"/lights/3/file", "sky.exr", "/lights/3", "one of file, radiance"},
      {"/volumes/0/profile/law", "ball", "/volumes/0/profile/law", "sphere"},
      {"/volumes/0/profile/max", {-200, 0, 0}, "/volumes/0/profile/max", "min < max"},
      {"/volumes/0/medium/species/0/scattering", -1, "/volumes/0/medium/species/0/scattering", "at least 0"},
      {"/volumes/1/medium", "air/fgo.medium.json", "/volumes/1/medium", "existing file"},
      {"/medium", "../fog.medium.json", "/medium", "under the folder"},
      {"/medium", "/etc/passwd", "/medium", "under the folder"},
      {"/medium", 5, "/medium", "medium"},
      {"/geometry/0", "absent.glb", "/geometry/0", "existing file"},
      {"/geometry/1/file", "../street.glb", "/geometry/1/file", "under the folder"},
      {"/geometry/0", "air", "/geometry/0", "regular file"},
      {"/camera/look_at", {0, 150, 500}, "/camera/look_at", "apart from position"},
      {"/camera/up", {0, 50, 500}, "/camera/up", "beside the line of sight"},
      {"/camera/vertical_fov", 180, "/camera/vertical_fov", "below 180"},
      {"/film/width", 0, "/film/width", "from 1 to 16384"},
      {"/film/width", 20000, "/film/width", "16384"},
      {"/film/width", 3.5, "/film/width", "whole number"},
      {"/integrator/name", "bidirectional", "/integrator/name", "path, single"},
      {"/integrator/spp", 0, "/integrator/spp", "1"},
      {"/fps", -1, "/fps", "above 0"},
  };
  for (const Mistake& mistake : mistakes) {
    json scene = whole();
    scene[json::json_pointer(mistake.pointer)] = mistake.value;
    const std::string text = files.fault_of(scene);
    EXPECT_NE(text.find(std::string("at ") + mistake.place), std::string::npos) << mistake.pointer << ": " << text;
    EXPECT_NE(text.find(mistake.says), std::string::npos) << mistake.pointer << ": " << text;
    EXPECT_NE(text.find("test.scene.json:"), std::string::npos) << text;
  }
}

TEST(SceneFile, AFilmIsNotLargerThanMemory) {
  const Files files;
  json scene = whole();
  scene["film"] = {{"width", 16384}, {"height", 16384}};
  EXPECT_NE(files.fault_of(scene).find("smaller picture"), std::string::npos);
}

TEST(SceneFile, PathsOutsideAreFollowedWhenAllowed) {
  const Files files;
  json scene = whole();
  scene["medium"] = (files.folder.path / "air/fog.medium.json").string();
  const Folder elsewhere;
  SceneOptions options;
  scene["geometry"] = json::array();
  scene["volumes"] = json::array();
  const auto file = elsewhere.put("test.scene.json", scene.dump());
  EXPECT_THROW(read_scene(file, options), Fault);
  options.allow_path = true;
  EXPECT_EQ(read_scene(file, options).medium.species.size(), 1U);
}

TEST(SceneFile, FilesThatAreNoScenesAreAnswered) {
  const Folder folder;
  for (const char* text : {"", "[]", "null", "{", "{\"format\": \"tyndall-medium/1\"}", "\xff\xfe", "glTF"}) {
    EXPECT_THROW(read_scene(folder.put("x.scene.json", text)), Fault) << text;
    EXPECT_THROW(read_scene(folder.put("x.glb", text)), Fault) << text;
    EXPECT_THROW(read_scene(folder.put("x.gltf", text)), Fault) << text;
  }
  EXPECT_THROW(read_scene(folder.path), Fault);
  EXPECT_THROW(read_scene(folder.path / "absent.glb"), Fault);
  EXPECT_THROW(read_scene("/dev/null"), Fault);
}

TEST(SceneFile, DamagedFilesAreAnsweredWithAMessageOrAScene) {
  const Files files;
  const std::string good = whole().dump(1);
  int refused = 0;
  for (unsigned seed = 0; seed < 300; ++seed) {
    std::mt19937 random(seed);
    std::string text = good;
    if (seed % 4 == 0) text.resize(random() % text.size());
    if (seed % 4 == 1) text[random() % text.size()] ^= static_cast<char>(1U << random() % 8);
    for (auto digits = seed % 4 < 2 ? 0 : 1 + random() % 3; digits > 0;) {
      char& c = text[random() % text.size()];
      if (c < '0' || c > '9') continue;
      c = "0123456789-.e"[random() % 13];
      --digits;
    }
    try {
      const Scene s = read_scene(files.folder.put("bad.scene.json", text));
      EXPECT_TRUE(is_finite(s.camera.position)) << seed;
    } catch (const Fault& fault) {
      ++refused;
      EXPECT_NE(std::string(fault.what()).find("bad.scene.json"), std::string::npos) << seed << ": " << fault.what();
    }
  }
  EXPECT_GT(refused, 100);
  EXPECT_LT(refused, 300);
}

TEST(SceneFile, MixedMeaningsOfChannelsAreWarnedAbout) {
  const Files files;
  files.folder.put("nm.medium.json", R"({"format": "tyndall-medium/1", "channels": {"wavelengths_nm": [680, 550, 440]},
    "species": [{"scattering": 1}]})");
  json scene = whole();
  scene["volumes"][1]["medium"] = "nm.medium.json";
  const Scene s = files.read(scene);
  ASSERT_EQ(s.warnings.size(), 1U);
  EXPECT_NE(s.warnings[0].find("channels"), std::string::npos);
}

TEST(SceneFile, MediaOutsideNatureAreWarnedAboutOnceWithTheirPlace) {
  const Files files;
  files.folder.put("odd.medium.json", R"({"format": "tyndall-medium/1", "background": {"exaggeration": 3},
    "species": [{"scattering": 1}]})");
  json scene = whole();
  scene["volumes"][0]["medium"] = scene["volumes"][1]["medium"] = "odd.medium.json";
  scene["medium"] = {{"background", {{"air", "note"}, {"exaggeration", 2}}}};
  const Scene s = files.read(scene);
  ASSERT_EQ(s.warnings.size(), 2U);
  EXPECT_NE(s.warnings[0].find("scene.json:/medium/background/exaggeration: found"), std::string::npos)
      << s.warnings[0];
  EXPECT_NE(s.warnings[1].find("odd.medium.json:/background/exaggeration: found"), std::string::npos) << s.warnings[1];
}

}  // namespace
}  // namespace tyndall
