// Profiles as scene files say them: in any unit, with every light; and what is said of those that cannot be.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/program.h"

namespace tyndall {
namespace {

using nlohmann::json;

class ProfileProbe : public tests::ProgramTest {
 protected:
  void SetUp() override {
    tests::ProgramTest::SetUp();
    std::filesystem::copy(std::filesystem::path(TYNDALL_SOURCE_DIR) / "examples/media/cumulus.vdb",
                          folder_ / "cumulus.vdb");
  }
  tests::Outcome run(const json& scene, const std::string& arguments) const {
    write("x.scene.json", scene.dump());
    return tyndall("probe x.scene.json " + arguments + " --json");
  }
};

/// Every profile in metres, u metres to the unit of the file. 1000 and 0.01 leave the last bits to rounding.
std::vector<json> profiles(double u) {
  const auto at = [u](double x, double y, double z) { return json{x / u, y / u, z / u}; };
  return {{{"law", "constant"}},
          {{"law", "exponential"}, {"scale_height", 2.0 / u}, {"base", 0.5 / u}},
          {{"law", "layer"}, {"bottom", -0.5 / u}, {"top", 0.75 / u}},
          {{"law", "tent"}, {"centre", 0.25 / u}, {"half_width", 1.5 / u}},
          {{"law", "box"}, {"min", at(-2, -1, -5)}, {"max", at(2, 1, -1)}, {"feather", 1.0 / u}},
          {{"law", "sphere"}, {"center", at(0.5, 0, -3)}, {"radius", 1.5 / u}, {"feather", 0.5 / u}},
          {{"law", "noise"}, {"scale", 2.0 / u}, {"octaves", 2}, {"contrast", 0.9}, {"seed", 3}, {"wind", at(1, 0, 0)}},
          {{"law", "grid"},
           {"file", "cumulus.vdb"},
           {"name", "density"},
           {"scale", 2},
           {"size", 2.0 / u},
           {"position", at(0, -0.25, -3)}}};
}

std::vector<json> lights(double u) {
  const auto at = [u](double x, double y, double z) { return json{x / u, y / u, z / u}; };
  return {{{"type", "point"}, {"position", at(0.5, 1.25, -3)}, {"intensity", 3}},
          {{"type", "spot"},
           {"position", at(0.5, 1.25, -3)},
           {"direction", {-0.2, -1, 0}},
           {"intensity", 5},
           {"inner_angle", 20},
           {"outer_angle", 50}},
          {{"type", "sun"}, {"direction", {0.2, -1, 0.1}}, {"irradiance", 2}, {"angular_diameter", 0.5}},
          {{"type", "environment"}, {"radiance", {0.1, 0.2, 0.3}}}};
}

json scene_of(const json& profile, const json& light, double u) {
  const auto box = [u](double size, double feather) {
    return json{{"law", "box"},
                {"min", {-size / u, -size / u, -size / u}},
                {"max", {size / u, size / u, size / u}},
                {"feather", feather / u}};
  };
  const json coefficients = {0.3 * u, 0.4 * u, 0.5 * u};
  const json medium = {{"species",
                        {{{"density", coefficients},
                          {"albedo", 0.9},
                          {"phase", {{"law", "henyey_greenstein"}, {"g", 0.3}}},
                          {"profile", profile}}}}};
  return {{"format", "tyndall-scene/1"},
          {"meters_per_unit", u},
          {"volumes", {{{"medium", medium}, {"profile", box(7, 0.5)}}}},
          {"lights", {light}}};
}

TEST_F(ProfileProbe, GivesTheSameNumbersInEveryUnit) {
  for (std::size_t p = 0; p < profiles(1.0).size(); ++p) {
    for (std::size_t l = 0; l < lights(1.0).size(); ++l) {
      std::vector<json> found;
      for (const double u : {1.0, 0.01, 1000.0}) {
        const auto length = [u](double x) { return json(x / u).dump(); };
        const std::string ray = "--integrator path --spp 64 --origin " + length(0.25) + "," + length(0.25) + "," +
                                length(1.0) + " --direction 0.1,0.05,-1 --distance " + length(6.0);
        const tests::Outcome outcome = run(scene_of(profiles(u)[p], lights(u)[l], u), ray);
        ASSERT_EQ(outcome.code, 0) << outcome.err;
        found.push_back(json::parse(outcome.out));
        for (std::size_t c = 0; c < 3; ++c) {
          const double radiance = found.back()["radiance"][c], first = found[0]["radiance"][c];
          const double through = found.back()["transmittance"][c], first_through = found[0]["transmittance"][c];
          EXPECT_GT(first, 0.0);
          EXPECT_NEAR(radiance, first, 1e-9 * first) << profiles(u)[p] << lights(u)[l];
          EXPECT_NEAR(through, first_through, 1e-12) << profiles(u)[p];
        }
      }
    }
  }
}

TEST_F(ProfileProbe, RefusesWhatHasNoMeaning) {
  const auto says = [&](const json& profile, const std::string& words) {
    const tests::Outcome outcome = run(scene_of(profile, lights(1.0)[0], 1.0), "--origin 0,0,0 --direction 0,0,-1");
    EXPECT_EQ(outcome.code, 2) << profile;
    EXPECT_NE(outcome.err.find(words), std::string::npos) << outcome.err;
  };
  says({{"law", "grd"}}, "tent");
  says({{"law", "grid"}}, "no key \"file\"");
  says({{"law", "grid"}, {"file", "x.vdb"}}, "an existing file");
  says({{"law", "grid"}, {"file", "x.scene.json"}}, "OpenVDB");
  says({{"law", "grid"}, {"file", "cumulus.vdb"}, {"name", "dense"}}, "expected density");
  says({{"law", "grid"}, {"file", "cumulus.vdb"}, {"scale", -1}}, "at least 0");
  says({{"law", "grid"}, {"file", "cumulus.vdb"}, {"size", 0}}, "above 0");
  says({{"law", "box"}, {"min", {0, 0, 0}}, {"max", {1, 2, 3}}, {"feather", 0.6}}, "half the shortest edge");
  says({{"law", "sphere"}, {"center", {0, 0, 0}}, {"radius", 1}, {"feather", 2}}, "at most the radius");
  says({{"law", "layer"}, {"bottom", 2}, {"top", 1}}, "bottom < top");
  says({{"law", "noise"}, {"scale", 0}}, "above 0");
  says({{"law", "noise"}, {"scale", 1}, {"octaves", 9}}, "8");
  says({{"law", "noise"}, {"scale", 1}, {"octaves", 1.5}}, "whole");
  says({{"law", "noise"}, {"scale", 1}, {"contrast", 1.5}}, "1");
  says({{"law", "tent"}, {"centre", 1}, {"half_width", -1}}, "above 0");
}

TEST_F(ProfileProbe, OutlastsHostileSizes) {
  std::vector<json> scenes;
  for (const double scale : {1e-30, 1e-9, 1e9, 1e30}) {
    scenes.push_back(
        scene_of({{"law", "noise"}, {"scale", scale}, {"octaves", 8}, {"contrast", 1}}, lights(1.0)[2], 1.0));
    scenes.push_back(scene_of({{"law", "tent"}, {"centre", scale}, {"half_width", scale}}, lights(1.0)[0], 1.0));
    scenes.push_back(scene_of({{"law", "sphere"}, {"center", {0, 0, 0}}, {"radius", scale}, {"feather", scale}},
                              lights(1.0)[0], 1.0));
  }
  json crowded = scene_of({{"law", "noise"}, {"scale", 1}}, lights(1.0)[2], 1.0);
  for (int i = 0; i < 299; ++i) {
    json volume = crowded["volumes"][0];
    volume["medium"]["species"][0]["profile"]["seed"] = i;
    volume["medium"]["species"][0]["density"] = 1e-3;
    crowded["volumes"].push_back(volume);
  }
  scenes.push_back(crowded);
  json endless = crowded;  // none of them has an end
  for (json& volume : endless["volumes"]) volume["profile"] = {{"law", "layer"}, {"bottom", -1e9}, {"top", 1e9}};
  scenes.push_back(endless);
  for (const json& scene : scenes) {
    const auto began = std::chrono::steady_clock::now();
    const tests::Outcome outcome = run(scene, "--integrator path --spp 2 --origin 0.1,0.2,0.3 --direction 0.3,0.2,-1");
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began;
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_LT(took.count(), 60.0);
    const json found = json::parse(outcome.out);
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_TRUE(found["radiance"][c].is_number()) << found;  // infinite or undefined numbers are null
      EXPECT_TRUE(found["transmittance"][c].is_number()) << found;
    }
  }
}

}  // namespace
}  // namespace tyndall
