// The program as a user runs it: show, phase, blend, and what it says when it cannot.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "tests/program.h"
#include "tests/shared_folder.h"
#include "tyndall/document/binding.h"
#include "tyndall/document/medium_file.h"

namespace tyndall {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::StartsWith;
using tests::Outcome;
using tests::ProgramTest;
using tests::text_of;

class Program : public ProgramTest {
 protected:
  Json json_of(const std::string& arguments) const {
    const Outcome run = tyndall(arguments + " --json");
    EXPECT_EQ(run.code, 0) << run.err;
    std::istringstream said(run.err);
    for (std::string line; std::getline(said, line);) EXPECT_THAT(line, StartsWith("warning: "));
    return Json::parse(run.out, nullptr, false);
  }
  std::string example(const std::string& name) const {
    return "'" + (fs::path(TYNDALL_SOURCE_DIR) / "examples" / "media" / (name + ".medium.json")).string() + "'";
  }
};

TEST_F(Program, ShowPrintsTheKeysOfTheContract) {
  const Json json = json_of("show " + example("harbour_fog"));
  for (const char* key : {"scattering", "absorption", "extinction", "albedo", "mean_free_path", "visibility_5",
                          "visibility_2", "mean_cosine"}) {
    ASSERT_TRUE(json.at(key).is_array()) << key;
    EXPECT_EQ(json.at(key).size(), 3u) << key;
  }
  EXPECT_EQ(json.at("species").size(), 5u);
  EXPECT_EQ(json.at("exaggeration"), 1);
  const double hazy_and_murky = -std::log(0.05) / 600.0;
  EXPECT_NEAR(json["extinction"][1].get<double>(), hazy_and_murky + 1e-4 + 1.36e-5 + 7e-5, 1e-15);
}

TEST_F(Program, PresetsAreListedPrintedAndKnownByName) {
  const Json listed = json_of("presets");
  ASSERT_GE(listed.at("presets").size(), 20u);
  for (const Json& preset : listed["presets"]) {
    const std::string name = preset.at("preset");
    EXPECT_EQ(json_of("show " + name).at("visibility_5"), preset.at("visibility_5")) << name;
    const Outcome text = tyndall("presets " + name);
    write("copy.medium.json", text.out);
    EXPECT_EQ(json_of("show copy.medium.json"), json_of("show " + name)) << name;
    EXPECT_FALSE(preset.at("sources").empty()) << name;
  }
  EXPECT_THAT(tyndall("presets").out, HasSubstr("radiation_fog"));
  EXPECT_EQ(tyndall("phase haze --at 1 --json").code, 0);
  EXPECT_EQ(tyndall("blend radiation_fog advection_fog --at 0.5 -o between.medium.json").code, 0);
  const Outcome unknown = tyndall("presets radiaton_fog");
  EXPECT_EQ(unknown.code, 2);
  EXPECT_THAT(unknown.err, HasSubstr("did you mean \"radiation_fog\"?"));
  EXPECT_THAT(tyndall("show radiaton_fog").err, HasSubstr("did you mean \"radiation_fog\"?"));
  EXPECT_THAT(tyndall("phase radiaton_fog --at 1").err, HasSubstr("did you mean \"radiation_fog\"?"));
}

TEST_F(Program, ShowHoldsTheVisibilityThatWasTyped) {
  for (const char* w : {"0", "0.2", "0.5", "0.7", "1"}) {
    write("m.medium.json", R"({"format": "tyndall-medium/1", "meters_per_unit": 1000, "background": {"exaggeration": 3},
      "conditions": {"model": "simple", "w": )" +
                               std::string(w) + R"(, "thickness": {"visibility": 2.5},
      "hold": "visibility", "veil": {"density": 0.1, "albedo": 0.5}},
      "species": [{"scattering": 0.02, "absorption": 0.05}]})");
    EXPECT_NEAR(json_of("show m.medium.json")["visibility_5"][1].get<double>(), 2500.0, 1e-8) << w;
  }
}

TEST_F(Program, ShowSaysNullWhereNothingIsThere) {
  write("m.medium.json", R"({"format": "tyndall-medium/1"})");
  const Json json = json_of("show m.medium.json");
  for (const char* key : {"albedo", "mean_free_path", "visibility_5", "visibility_2", "mean_cosine"}) {
    EXPECT_TRUE(json.at(key)[0].is_null()) << key;
  }
  EXPECT_EQ(json["extinction"], Json::parse("[0,0,0]"));
  EXPECT_THAT(tyndall("show m.medium.json").out, HasSubstr("vacuum"));
}

TEST_F(Program, ShowSaysTheExtinctionInEveryForm) {
  write("m.medium.json", R"({"format": "tyndall-medium/1", "meters_per_unit": 0.01,
    "species": [{"density": {"transmittance": [0.5, 0.25, 0.1], "distance": 10000}}]})");
  const Json json = json_of("show m.medium.json");
  const double green = std::log(4.0) / 100.0;
  EXPECT_NEAR(json["extinction"][1].get<double>(), green, 1e-16);
  // Each form means the same extinction when it is read back, in a file in metres.
  for (const Json& form : json["densities"]) {
    write("form.medium.json", R"({"format": "tyndall-medium/1", "species": [{"density": )" + form.dump() + "}]}");
    const Json again = json_of("show form.medium.json");
    for (std::size_t c = 0; c < 3; ++c) {
      const double expected = json["extinction"][c];
      EXPECT_NEAR(again["extinction"][c].get<double>(), expected, 1e-13 * expected) << form;
    }
  }
  EXPECT_EQ(json["densities"].size(), 7u);
  EXPECT_EQ(json["warnings"], Json::array());
  const std::string table = tyndall("show m.medium.json").out;
  for (const char* row : {"half of the light is gone after", "50 m", "90 % of the light", "transmittance of 100 m",
                          "optical depth of 100 m", "1.386", "extinction per unit of 1 cm", "0.0001386"}) {
    EXPECT_THAT(table, HasSubstr(row));
  }
}

TEST_F(Program, ShowNamesTheChannelsAsTheFileDoes) {
  write("m.medium.json", R"({"format": "tyndall-medium/1", "channels": {"wavelengths_nm": [700, 600, 500]},
    "background": {"air": "standard"}})");
  EXPECT_THAT(tyndall("show m.medium.json").out, HasSubstr("700 nm"));
  EXPECT_THAT(tyndall("show " + example("harbour_fog")).out, HasSubstr("red"));
  const Json json = json_of("show m.medium.json");
  EXPECT_NEAR(json["scattering"][1].get<double>(), 8.05e-6, 0.02e-6);  // Bodhaine et al. 1999 at 600 nm
}

TEST_F(Program, ShowSaysWhereNumbersComeFrom) {
  const Json json = json_of("show " + example("airport_haze"));
  EXPECT_NEAR(json["visibility_5"][1].get<double>(), 9000.0, 1e-8);
  ASSERT_EQ(json["sources"].size(), 3u);
  for (const char* source : {"Bodhaine et al. 1999", "956 hPa", "300 DU", "OPAC"}) {
    EXPECT_THAT(json["sources"].dump(), HasSubstr(source));
    EXPECT_THAT(tyndall("show " + example("airport_haze")).out, HasSubstr(source));
  }
  EXPECT_EQ(json["warnings"], Json::array());
}

TEST_F(Program, WhatIsNotInNatureIsWarnedAboutOnceForEachDial) {
  write("m.medium.json", R"({"format": "tyndall-medium/1", "background": {"exaggeration": 3},
    "conditions": {"model": "two_lobes", "r": 0.5, "g1": 0.5, "g2": 0, "thickness": 0.01}})");
  const auto lines = [](const std::string& text) { return std::count(text.begin(), text.end(), '\n'); };
  for (const char* command : {"show m.medium.json", "show m.medium.json --json", "phase m.medium.json",
                              "slab m.medium.json --thickness 10 --spp 1000",
                              "blend m.medium.json m.medium.json --at 0.5 -o out.medium.json"}) {
    const Outcome run = tyndall(command);
    EXPECT_EQ(run.code, 0) << run.err;
    EXPECT_THAT(run.err, HasSubstr("warning: m.medium.json:/background/exaggeration: found air exaggerated by a factor "
                                   "of 3, expected 1: real air"));
    EXPECT_THAT(run.err, HasSubstr("warning: m.medium.json:/conditions/g1: found"));
    EXPECT_EQ(lines(run.err), 2) << command;
  }
  const Json json = json_of("show m.medium.json");
  ASSERT_EQ(json["warnings"].size(), 2u);
  EXPECT_EQ(json["warnings"][0]["field"], "background/exaggeration");
}

TEST_F(Program, ShowPrintsATable) {
  const Outcome run = tyndall("show " + example("river_mist"));
  EXPECT_EQ(run.code, 0);
  for (const char* part :
       {"River mist", "visibility, 5 % contrast", "219.9 m", "murky", "mie_murky", "exaggerated by a factor of 4"}) {
    EXPECT_THAT(run.out, HasSubstr(part));
  }
}

TEST_F(Program, PhaseOfALawGivesScalars) {
  const Json json = json_of("phase henyey_greenstein:g=0.7 --at -1,0,1 --moments 3 --sample 0,0.5,1");
  EXPECT_EQ(json["mu"], Json::parse("[-1,0,1]"));
  EXPECT_NEAR(json["density"][2].get<double>(), 1.50313001809012, 1e-13);
  EXPECT_NEAR(json["density"][1].get<double>(), 0.0223141788394392, 1e-15);
  EXPECT_NEAR(json["mean_cosine"].get<double>(), 0.7, 1e-15);
  EXPECT_NEAR(json["legendre"][3].get<double>(), 0.343, 1e-15);
  EXPECT_EQ(json["legendre"].size(), 4u);
  EXPECT_EQ(json["sampled_mu"][0], -1);
  EXPECT_NEAR(json["sampled_mu"][1].get<double>(), 0.8785, 1e-14);
  EXPECT_EQ(json["sampled_mu"][2], 1);
}

TEST_F(Program, PhaseOfAMediumGivesChannels) {
  const Json json = json_of("phase " + example("harbour_fog") + " --at 1,-1 --moments 1 --sample 0.25");
  for (const char* key : {"density", "legendre", "sampled_mu"}) {
    for (const Json& entry : json.at(key)) EXPECT_EQ(entry.size(), 3u) << key;
  }
  EXPECT_EQ(json["mean_cosine"].size(), 3u);
  const Json shown = json_of("show " + example("harbour_fog"));
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(json["mean_cosine"][c].get<double>(), shown["mean_cosine"][c].get<double>(), 1e-14);
    EXPECT_NEAR(json["legendre"][1][c].get<double>(), shown["mean_cosine"][c].get<double>(), 1e-14);
  }
  // Air is in the mixture, so that it is coloured although every law is grey.
  EXPECT_NE(json["density"][0][0], json["density"][0][2]);
  write("m.medium.json", R"({"format": "tyndall-medium/1", "species": [{"absorption": 1}]})");
  EXPECT_EQ(json_of("phase m.medium.json --at 0")["density"], Json::parse("[[null,null,null]]"));
}

TEST_F(Program, PhaseAgreesWithTheReferenceDensitiesAndMoments) {
  TYNDALL_NEEDS_SHARED_FILE(truth, "acceptance/public.json");
  const std::map<std::string, std::string> laws = {{"isotropic", "isotropic"},
                                                   {"rayleigh", "rayleigh"},
                                                   {"hg_0.7", "henyey_greenstein:g=0.7"},
                                                   {"hg_0.98", "henyey_greenstein:g=0.98"},
                                                   {"cornette_shanks_0.76", "cornette_shanks:g=0.76"},
                                                   {"schlick_k=.7", "schlick:k=0.7"},
                                                   {"hgdraine_d10", "droplet:diameter=10"},
                                                   {"mie_hazy", "mie_hazy"},
                                                   {"mie_murky", "mie_murky"}};
  const auto number = [](const Json& x) { return x.is_string() ? std::stod(x.get<std::string>()) : x.get<double>(); };
  int checked = 0;
  const Json all = Json::parse(std::ifstream(truth));
  for (const Json& item : all.at("phase_functions").at("items")) {
    const auto law = laws.find(item.at("name"));
    ASSERT_NE(law, laws.end()) << "how is " << item.at("name") << " said on the command line?";
    std::ostringstream mus;
    mus.precision(17);
    std::vector<double> densities;
    for (const auto& [degrees, density] : item.at("p(theta_deg)").items()) {
      mus << (densities.empty() ? "" : ",") << std::cos(std::stod(degrees) * std::acos(-1.0) / 180.0);
      densities.push_back(number(density));
    }
    const Json json = json_of("phase " + law->second + " --moments 8 --at=" + mus.str());
    for (std::size_t i = 0; i < densities.size(); ++i) {
      EXPECT_NEAR(json["density"][i].get<double>(), densities[i], 2e-11 * densities[i]) << law->first << " " << i;
    }
    for (std::size_t l = 0; l <= 8; ++l) {
      EXPECT_NEAR(json["legendre"][l].get<double>(), number(item.at("chi_0..8")[l]), 1e-12) << law->first << " " << l;
    }
    ++checked;
  }
  EXPECT_GE(checked, 6);
}

TEST_F(Program, EveryFigureOfASlabHasItsStandardError) {
  const Json json = json_of("slab mist --thickness 300 --mu0 0.6 --mu 0.1,0.5,1 --ground 0.2 --spp 20000");
  EXPECT_EQ(json["mu"], Json::parse("[0.1, 0.5, 1]"));
  for (const char* key : {"reflectance", "transmittance_diffuse"}) {
    for (std::size_t c = 0; c < 3; ++c) {
      const double error = json["standard_error"][key][c], value = json[key][c];
      EXPECT_GT(error, 0.0) << key;
      EXPECT_LT(error, 0.05 * value) << key;
    }
  }
  for (const char* key : {"reflection", "transmission"}) {
    ASSERT_EQ(json["standard_error"][key].size(), 3u);
    for (std::size_t m = 0; m < 3; ++m) {
      for (std::size_t c = 0; c < 3; ++c) {
        const double error = json["standard_error"][key][m][c], value = json[key][m][c];
        EXPECT_GT(error, 0.0) << key;
        EXPECT_LT(error, 0.1 * value) << key;
      }
    }
  }
}

TEST_F(Program, BlendStartsAtAAndEndsAtB) {
  const std::string media = example("harbour_fog") + " " + example("river_mist");
  for (const char* how : {"interpolate", "mix", "morph"}) {
    for (const auto& [at, end] : {std::pair{"0", "harbour_fog"}, std::pair{"1", "river_mist"}}) {
      const Outcome run = tyndall("blend " + media + " --at " + at + " --how " + how + " -o c.medium.json");
      ASSERT_EQ(run.code, 0) << run.err;
      Json expected = json_of("show " + example(end)), got = json_of("show c.medium.json");
      EXPECT_EQ(expected, got) << how << at;
    }
    ASSERT_EQ(tyndall("blend " + media + " --at 0.3 --how " + how + " -o c.medium.json").code, 0);
    EXPECT_EQ(tyndall("show c.medium.json").code, 0);
  }
  EXPECT_EQ(files(), 1u);  // nothing temporary is left
}

TEST_F(Program, BlendInterpolatesWAndThickness) {
  const auto medium = [](const char* w, const char* thickness) {
    return std::string(R"({"format": "tyndall-medium/1", "conditions": {"model": "simple", "w": )") + w +
           ", \"thickness\": " + thickness + "}}";
  };
  write("a.medium.json", medium("0.4", "1e-4"));
  write("b.medium.json", medium("0.8", "4e-2"));
  ASSERT_EQ(tyndall("blend a.medium.json b.medium.json --at 0.5 -o c.medium.json").code, 0);
  const Json json = Json::parse(text_of(folder_ / "c.medium.json"));
  EXPECT_NEAR(json["conditions"]["w"].get<double>(), 0.6, 1e-15);
  EXPECT_NEAR(json["conditions"]["thickness"].get<double>(), 0.02005, 1e-17);
}

TEST_F(Program, BlendRefusesUnlikeModelsAndPointsToMix) {
  const Outcome run =
      tyndall("blend " + example("harbour_fog") + " " + example("dusty_room") + " --at 0.5 -o c.medium.json");
  EXPECT_EQ(run.code, 2);
  EXPECT_THAT(run.err, HasSubstr("mix"));
  EXPECT_EQ(files(), 0u);
}

TEST_F(Program, AnswersEveryBadFileWithExitCode2AndItsPlace) {
  for (const auto& entry : fs::directory_iterator(fs::path(TYNDALL_SOURCE_DIR) / "tests" / "bad" / "media")) {
    const Outcome run = tyndall("show '" + entry.path().string() + "'");
    EXPECT_EQ(run.code, 2) << entry.path();
    EXPECT_EQ(run.out, "");
    EXPECT_THAT(run.err, StartsWith("tyndall: " + entry.path().string() + ":"));
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  }
}

TEST_F(Program, AnswersMisuseWithExitCode2AndNothingOnStdout) {
  const std::string media = example("harbour_fog") + " " + example("haze");
  for (const std::string& arguments : {std::string(""),
                                       std::string("shwo x"),
                                       std::string("show"),
                                       std::string("show absent.medium.json"),
                                       std::string("show . --json"),
                                       "show " + example("haze") + " --jsn",
                                       std::string("phase"),
                                       std::string("phase henyey_greenstien:g=0.5"),
                                       std::string("phase henyey_greenstein:g=1"),
                                       std::string("phase isotropic --at 2"),
                                       std::string("phase isotropic --at 0,,1"),
                                       std::string("phase isotropic --at nan"),
                                       std::string("phase isotropic --moments -1"),
                                       std::string("phase isotropic --moments 1000000"),
                                       std::string("phase isotropic --moments two"),
                                       std::string("phase isotropic --sample 1.5"),
                                       "blend " + media + " --at 0.5",
                                       "blend " + media + " -o c.medium.json",
                                       "blend " + media + " --at nan -o c.medium.json",
                                       "blend " + media + " --at 1.1 -o c.medium.json",
                                       "blend " + media + " --at 0.5 --how interpolat -o c.medium.json",
                                       "blend " + media + " --at 0.5 --how mix -o no/such/folder/c.medium.json",
                                       "blend " + media + " --at 0.5 --how mix -o .",
                                       "blend " + example("haze") + " --at 0 -o c.medium.json"}) {
    const Outcome run = tyndall(arguments);
    EXPECT_EQ(run.code, 2) << arguments << ": " << run.err;
    EXPECT_EQ(run.out, "") << arguments;
    EXPECT_NE(run.err, "") << arguments;
    EXPECT_EQ(files(), 0u) << arguments;
  }
  EXPECT_THAT(tyndall("shwo x").err, HasSubstr("did you mean \"show\"?"));
}

TEST_F(Program, SaysSoWhenItsOutputCannotBeWritten) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  const std::string command = "'" TYNDALL_PROGRAM "' show " + example("haze") + " >/dev/full 2>/dev/null";
  const int status = std::system(command.c_str());
  EXPECT_EQ(WEXITSTATUS(status), 1);
}

TEST_F(Program, HelpExplainsEveryCommandWithAnExample) {
  const Outcome all = tyndall("--help");
  EXPECT_EQ(all.code, 0);
  EXPECT_EQ(all.err, "");
  std::istringstream lines(all.out.substr(all.out.find("Subcommands:")));
  std::string line;
  std::getline(lines, line);
  int commands = 0;
  while (std::getline(lines, line) && !line.empty()) {
    if (line.substr(0, 2) != "  " || line[2] == ' ') continue;
    const Outcome help = tyndall(line.substr(2, line.find(' ', 2) - 2) + " --help");
    EXPECT_EQ(help.code, 0);
    EXPECT_THAT(help.out, HasSubstr("Example: tyndall ")) << line;
    ++commands;
  }
  EXPECT_GE(commands, 3);
}

TEST_F(Program, ReadsATableFromAFileInOneWord) {
  write("t.csv", "angle;value\r\n0;10\r\n90;1\r\n180;2\r\n");
  const Json grey = json_of("phase tabulated:file=t.csv --at 1,0,-1 --moments 2 --sample 0,1");
  // Linear in mu: the integral over mu is (10 + 1)/2 + (1 + 2)/2 = 7.
  EXPECT_NEAR(grey["density"][0].get<double>(), 10.0 / 7.0 / (2.0 * std::acos(-1.0)), 1e-15);
  EXPECT_NEAR(grey["density"][1].get<double>() * 10.0, grey["density"][0].get<double>(), 1e-15);
  EXPECT_NEAR(grey["legendre"][0].get<double>(), 1.0, 1e-15);
  EXPECT_EQ(grey["legendre"][1], grey["mean_cosine"]);
  EXPECT_EQ(grey["sampled_mu"], Json::parse("[-1, 1]"));

  write("rgb.csv", "0 9 4 1\n60 1 2 1\n180 .5 1 1\n");
  const Json colored = json_of("phase tabulated:file=rgb.csv --at 0.5 --moments 1 --sample 0.5");
  for (const char* key : {"density", "legendre", "sampled_mu"}) EXPECT_EQ(colored[key][0].size(), 3u) << key;
  EXPECT_NEAR(colored["mean_cosine"][2].get<double>(), 0.0, 1e-15);
  EXPECT_NEAR(colored["density"][0][2].get<double>(), 1.0 / (4.0 * std::acos(-1.0)), 1e-15);

  write("bad.csv", "0,1\n12,secret\n");
  const Outcome refused = tyndall("phase tabulated:file=bad.csv");
  EXPECT_EQ(refused.code, 2);
  EXPECT_EQ(refused.out, "");
  EXPECT_THAT(refused.err, HasSubstr("bad.csv:2: found no number in column 2"));
  EXPECT_EQ(refused.err.find("secret"), std::string::npos);
  EXPECT_EQ(tyndall("phase tabulated:file=absent.csv").code, 2);
}

// Deirmendjian's cloud by Mie's theory (scripts/cloud_table.cc): the mean cosines that the sums over spheres give
// themselves, to what 320 knots can say; one species to the reader.
TEST_F(Program, ShowsACloudOfDropletsAsOneSpecies) {
  const Json json = json_of("show " + example("cloud"));
  ASSERT_EQ(json["species"].size(), 2u);
  const Json& droplets = json["species"][1];
  EXPECT_EQ(droplets["name"], "droplets");
  EXPECT_EQ(droplets["phase"], Json::parse(R"({"law": "tabulated", "file": "cloud_c1.csv"})"));
  const double exact[] = {0.84868, 0.85316, 0.85614};
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(droplets["mean_cosine"][c].get<double>(), exact[c], 3e-4);
}

TEST_F(Program, BlendKeepsATableByReferenceOrByItsNumbers) {
  write("t.csv", "0,10\n90,1\n180,2\n");
  write("a.medium.json", R"({"format": "tyndall-medium/1", "species": [{"name": "x", "scattering": 1,
                             "phase": {"law": "tabulated", "file": "t.csv"}}]})");
  write("b.medium.json", R"({"format": "tyndall-medium/1", "species": [{"name": "y", "scattering": 1}]})");
  fs::create_directory(folder_ / "below");
  for (const char* out : {"c.medium.json", "below/c.medium.json"}) {
    EXPECT_EQ(tyndall("blend a.medium.json b.medium.json --at 0.25 --how mix -o " + std::string(out)).code, 0);
    const Json phase = json_of("show " + std::string(out))["species"][0]["phase"];
    EXPECT_EQ(phase.contains("file"), out[0] == 'c') << out;
    EXPECT_EQ(phase.contains("angles"), out[0] != 'c') << out;
    const Json mixed = json_of("phase " + std::string(out) + " --at 1");
    EXPECT_NEAR(mixed["density"][0][0].get<double>(), (0.75 * 10.0 / 7.0 + 0.25 * 0.5) / (2.0 * std::acos(-1.0)),
                1e-14);
  }
}

}  // namespace
}  // namespace tyndall
