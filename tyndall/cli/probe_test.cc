// `tyndall probe` as a user runs it: scene files written to a folder, numbers read from its JSON.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include "tests/program.h"
#include "tests/shared_folder.h"

namespace tyndall {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class Probe : public tests::ProgramTest {
 protected:
  json probe(const json& scene, const std::string& arguments) const {
    write("x.scene.json", scene.dump());
    const tests::Outcome run = tyndall("probe x.scene.json " + arguments + " --json");
    EXPECT_EQ(run.code, 0) << run.err;
    return json::parse(run.out, nullptr, false);
  }
};

json phase_named(const std::string& name) {
  if (name == "hg0.7") return {{"law", "henyey_greenstein"}, {"g", 0.7}};
  if (name == "hazy" || name == "murky") return {{"law", "mie_" + name}};
  return {{"law", name}};
}

json medium_of(double scattering, double absorption, const std::string& law) {
  return {{"format", "tyndall-medium/1"},
          {"species", {{{"scattering", scattering}, {"absorption", absorption}, {"phase", phase_named(law)}}}}};
}

json scene_with(const json& medium, const json& lights) {
  return {{"format", "tyndall-scene/1"}, {"medium", medium}, {"lights", lights}};
}

std::string text_of(const json& numbers) {
  std::ostringstream text;
  text.precision(17);
  for (std::size_t i = 0; i < numbers.size(); ++i) text << (i > 0 ? "," : "") << numbers[i].get<double>();
  return text.str();
}
std::string text_of(double x) { return text_of(json::array({x})); }

TEST_F(Probe, SingleReachesThePublishedAirlight) {
  TYNDALL_NEEDS_SHARED_FILE(truth, "acceptance/public.json");
  const json all = json::parse(std::ifstream(truth));
  int count = 0;
  for (const char* kind : {"airlight_point", "airlight_spot"}) {
    for (const json& item : all.at(kind).at("items")) {
      for (const char* law : {"isotropic", "rayleigh", "hg0.7", "hazy", "murky"}) {
        if (!item.contains(law)) continue;
        const double sigma = item["sigma_t"], albedo = item["albedo"];
        json light;
        json origin = {0, 0, 0}, direction = {1, 0, 0};
        if (item.contains("spot_pos")) {
          light = {{"type", "spot"},
                   {"position", item["spot_pos"]},
                   {"direction", item["spot_dir_unnormalised"]},
                   {"intensity", item["intensity_W_per_sr"]},
                   {"inner_angle", item["half_angle_deg"]},
                   {"outer_angle", item["half_angle_deg"]}};
          origin = item["camera"];
          direction = item["view_dir"];
        } else {
          light = {{"type", "point"}, {"position", {item["a"], item["h"], 0}}, {"intensity", item["intensity"]}};
        }
        const json out = probe(scene_with(medium_of(sigma * albedo, sigma * (1.0 - albedo), law), json::array({light})),
                               "--origin " + text_of(origin) + " --direction " + text_of(direction) + " --distance " +
                                   text_of(item["d"].get<double>()) + " --integrator single");
        const double expected = std::stod(item[law].get<std::string>());
        for (std::size_t c = 0; c < 3; ++c) {
          EXPECT_NEAR(out["radiance"][c].get<double>() / expected, 1.0, 1e-10) << kind << item["id"] << law;
          EXPECT_EQ(out["standard_error"][c], 0) << kind << item["id"] << law;
          EXPECT_NEAR(out["transmittance"][c].get<double>(), std::exp(-sigma * item["d"].get<double>()), 1e-12);
        }
        ++count;
      }
    }
  }
  EXPECT_GE(count, 10);
}

TEST_F(Probe, UnitsOfTheSceneDoNotChangeTheLight) {
  const auto radiance = [&](double unit) {  // metres per unit; everything is stated in units
    json medium = medium_of(0.1 * unit, 0.02 * unit, "hazy");
    medium["meters_per_unit"] = unit;
    json scene = scene_with(medium, {{{"type", "point"}, {"position", {4 / unit, 1 / unit, 0}}, {"intensity", 3}}});
    scene["meters_per_unit"] = unit;
    return probe(scene, "--origin 0,0,0 --direction 2,0,0 --distance " + text_of(9 / unit))["radiance"][1]
        .get<double>();
  };
  const double metres = radiance(1.0);
  EXPECT_NEAR(radiance(0.01) / metres, 1.0, 1e-12);
  EXPECT_NEAR(radiance(1000.0) / metres, 1.0, 1e-12);
}

TEST_F(Probe, WithoutADistanceTheSkyIsAdded) {
  const json scene = scene_with(medium_of(0.0, 0.0, "isotropic"), {{{"type", "environment"}, {"radiance", {1, 2, 3}}}});
  EXPECT_EQ(probe(scene, "--origin 0,0,0 --direction 0,1,0")["radiance"], json::parse("[1,2,3]"));
  EXPECT_EQ(probe(scene, "--origin 0,0,0 --direction 0,1,0 --distance 5")["radiance"], json::parse("[0,0,0]"));
  EXPECT_EQ(probe(scene, "--origin 0,0,0 --direction 0,1,0 --distance 5")["transmittance"], json::parse("[1,1,1]"));
}

TEST_F(Probe, FluenceOfALampInVacuumIsItsIrradiance) {
  const json lamp = {{"type", "point"}, {"position", {0, 0, 2}}, {"intensity", 8}};
  for (const char* integrator : {"single", "path"}) {
    const json out = probe(scene_with(medium_of(0.0, 0.0, "isotropic"), json::array({lamp})),
                           std::string("--origin 0,0,0 --fluence --spp 64 --integrator ") + integrator);
    EXPECT_NEAR(out["radiance"][0].get<double>(), 2.0, 1e-12) << integrator;
    EXPECT_EQ(out["fluence"], out["radiance"]);
  }
}

TEST_F(Probe, PathAgreesWithSingleInThinAirAndStatesItsError) {
  const json scene =
      scene_with(medium_of(1e-4, 0.0, "hazy"), {{{"type", "point"}, {"position", {4, 1, 0}}, {"intensity", 3}}});
  const std::string ray = "--origin 0,0,0 --direction 1,0,0 --distance 9 --integrator ";
  const json single = probe(scene, ray + "single"), path = probe(scene, ray + "path --spp 20000");
  const double error = path["standard_error"][0];
  EXPECT_GT(error, 0.0);
  EXPECT_NEAR(path["radiance"][0].get<double>(), single["radiance"][0].get<double>(),
              4.0 * error + 2e-3 * single["radiance"][0].get<double>());
}

TEST_F(Probe, ARayThroughALampIsNullNotAnError) {
  const json scene =
      scene_with(medium_of(0.1, 0.0, "isotropic"), {{{"type", "point"}, {"position", {4, 0, 0}}, {"intensity", 3}}});
  EXPECT_TRUE(probe(scene, "--origin 0,0,0 --direction 1,0,0")["radiance"][0].is_null());
}

TEST_F(Probe, AnswersMisuseWithExitCode2) {
  write("x.scene.json", scene_with(medium_of(0.1, 0.0, "isotropic"), json::array()).dump());
  for (const char* arguments :
       {"", "--origin 0,0,0", "--origin 0,0 --direction 1,0,0", "--origin 0,0,0 --direction 0,0,0",
        "--origin 0,0,0 --direction 1,0,0 --distance 0", "--origin 0,0,0 --direction 1,0,0 --distance nan",
        "--origin 0,0,0 --direction 1,0,0 --distance -1", "--origin a,b,c --direction 1,0,0",
        "--origin 0,0,0 --direction 1,0,0 --integrator both", "--origin inf,0,0 --direction 1,0,0"}) {
    const tests::Outcome run = tyndall(std::string("probe x.scene.json ") + arguments);
    EXPECT_EQ(run.code, 2) << arguments;
    EXPECT_EQ(run.out, "") << arguments;
  }
}

TEST_F(Probe, AndRenderWarnOfMediaOutsideNatureUnlessQuiet) {
  json medium = medium_of(1e-3, 0.0, "isotropic");
  medium["background"] = {{"exaggeration", 3}};
  const json lamp = {{"type", "point"}, {"position", {0, 2, 0}}, {"intensity", 1}};
  write("x.scene.json", scene_with(medium, json::array({lamp})).dump());
  const std::string warning = "warning: x.scene.json:/medium/background/exaggeration: found air exaggerated";
  const auto times = [&](const std::string& text) {
    int count = 0;
    for (auto at = text.find(warning); at != text.npos; at = text.find(warning, at + 1)) ++count;
    return count;
  };
  EXPECT_EQ(times(tyndall("probe x.scene.json --origin 0,0,0 --direction 1,0,0").err), 1);
  const std::string render = "render x.scene.json --size 8x8 --spp 1 -o x.png";
  EXPECT_EQ(times(tyndall(render).err), 1);
  const tests::Outcome quiet = tyndall(render + " --quiet");
  EXPECT_EQ(quiet.code, 0);
  EXPECT_EQ(quiet.err, "");
}

}  // namespace
}  // namespace tyndall
