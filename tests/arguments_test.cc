// Requests that cannot be met: each is answered in one sentence of what was found and what was possible, with exit code
// 2, and nothing is written.
#include <gmock/gmock.h>

#include "tests/program.h"

namespace tyndall {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using tests::Outcome;

class Arguments : public tests::ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    fs::copy(fs::path(TYNDALL_SOURCE_DIR) / "examples" / "geometry" / "room.glb", folder_ / "room.glb");
    fs::create_directory(folder_ / "folder");
    fs::create_directory(folder_ / "folder.exr");
    write("file", "");
    present_ = files();
  }
  void expect_refused(const std::string& arguments, const std::string& where, const std::string& found,
                      const std::string& expected) const {
    const Outcome run = tyndall(arguments);
    EXPECT_EQ(run.code, 2) << arguments << ": " << run.err;
    EXPECT_EQ(run.out, "") << arguments;
    EXPECT_EQ(files(), present_) << arguments;
    EXPECT_THAT(run.err, HasSubstr("tyndall: " + where + ": found " + found)) << arguments;
    EXPECT_THAT(run.err, HasSubstr(", expected " + expected)) << arguments;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  }
  std::size_t present_ = 0;
};

struct Refused {
  const char *arguments, *where, *found, *expected;
};

TEST_F(Arguments, WhatIsMissingUnknownOrTooMuchIsNamed) {
  for (const auto& [arguments, where, found, expected] : std::initializer_list<Refused>{
           {"shwo haze", "command", "\"shwo\"", "one of render, probe"},
           {"--json", "command", "the option \"--json\"", "one of render, probe"},
           {"show", "show", "no MEDIUM", "medium file"},
           {"phase", "phase", "no LAW|MEDIUM", "a law with its parameters"},
           {"slab haze", "slab", "no --thickness", "this option too: thickness of the layer in metres"},
           {"slab haze --thickness", "slab", "nothing after --thickness", "thickness of the layer"},
           {"slab haze --thickness 1 --thickness 2", "slab", "--thickness more than once", "each option once"},
           {"slab haze --thicknes 2", "slab", "the unknown option \"--thicknes\"", "one of"},
           {"slab haze --thicknes=2", "slab", "the unknown option \"--thicknes\"", "one of"},
           {"slab haze smoke --thickness 1", "slab", "\"smoke\", one argument too many", "MEDIUM and options"},
           {"blend haze", "blend", "no B", "medium file or preset to go to"},
           {"blend haze smoke mist --at 0 -o x.json", "blend", "\"mist\", one argument too many", "A and B and"},
           {"blend haze smoke --at 0.5", "blend", "no --output", "this option too: medium file to write"},
           {"probe room.glb", "probe", "no --origin", "this option too: where to measure"},
           {"probe room.glb --origin 0,0,0", "--direction", "nothing", "the direction to look in"},
           {"render room.glb", "render", "no --output", "this option too: where to write"},
           {"render -o x.png", "render", "no SCENE", "a .scene.json, .glb or .gltf file"},
           {"render room.glb -o", "render", "nothing after --output", "where to write"},
           {"render room.glb -o x.png --spp", "render", "nothing after --spp", "samples per pixel"},
           {"render room.glb -o x.png --qiet", "render", "the unknown option \"--qiet\"", "one of"},
           {"plot haze", "plot", "no --output", "this option too: where to write"},
           {"presets haze mist", "presets", "\"mist\", one argument too many", "NAME and options"},
           {"schema medium x", "schema", "\"x\", one argument too many", "FILES and options"}}) {
    expect_refused(arguments, where, found, expected);
  }
  EXPECT_THAT(tyndall("slab haze --thicknes 2").err, HasSubstr("did you mean \"--thickness\"?"));
  EXPECT_THAT(tyndall("slab haze --thicknes 2").err, HasSubstr("(see tyndall slab --help)"));
  EXPECT_THAT(tyndall("shwo haze").err, HasSubstr("did you mean \"show\"?"));
}

TEST_F(Arguments, NumbersThatCannotBeAreQuotedWithWhatCan) {
  const auto refuse_all = [&](const std::string& command, const std::string& option,
                              const std::vector<std::string>& texts, const std::string& expected) {
    for (const std::string& text : texts) {
      expect_refused(command + " " + option + " " + text, option, '"' + text + '"', expected);
    }
  };
  const std::vector<std::string> no_count{"0", "-1", "x", "nan", "inf", "1.5", "1e9", "99999999999999999999999"};
  const std::vector<std::string> no_seed{"-1", "x", "nan", "1.5", "1e99", "18446744073709551616"};
  const std::vector<std::string> no_thickness{"0", "-1", "x", "nan", "1e400", "-inf"};
  const std::string slab = "slab haze --thickness 10";
  refuse_all("slab haze", "--thickness", no_thickness, "a length in metres above 0, or inf");
  refuse_all(slab, "--mu0", {"0", "-1", "2", "x", "nan", "inf"}, "a number from 1e-06 to 1");
  refuse_all(slab, "--mu", {"0", "2", "x", "nan", "0.5,,1", "0.5,"}, "numbers from 1e-06 to 1, with commas between");
  refuse_all(slab, "--ground", {"-0.1", "1.1", "nan", "x"}, "a number from 0 to 1");
  refuse_all(slab, "--illumination", {"sun", "0"}, "one of beam, diffuse");
  refuse_all(slab, "--spp", {"0", "-1", "x", "nan", "1.5", "1e9", "4000000001"}, "a whole number from 1 to 4000000000");
  refuse_all(slab, "--seed", no_seed, "a whole number from 0 to 18446744073709551615");
  refuse_all(slab, "--threads", no_count, "a whole number from 1 to 1024");
  const std::string probe = "probe room.glb --origin 0,1,0 --direction 0,0,1";
  refuse_all(probe, "--distance", {"0", "-1", "x", "nan"}, "a number above 0");
  refuse_all(probe, "--integrator", {"pth", "1"}, "one of path, single");
  refuse_all(probe, "--spp", {"1", "-1", "x", "nan"}, "a whole number from 2 to 4000000000");
  refuse_all("probe room.glb --direction 0,0,1", "--origin", {"1", "1,2", "1,2,nan", "1,2,3,4", "1e400,0,0"}, "");
  refuse_all("probe room.glb --origin 0,0,0", "--direction", {"0,0,0", "1,2"}, "");
  const std::string render = "render room.glb -o x.png";
  refuse_all(render, "--spp", no_count, "a whole number from 1 to 16777216");
  refuse_all(render, "--threads", no_count, "a whole number from 1 to 1024");
  refuse_all(render, "--seed", no_seed, "a whole number from 0 to 18446744073709551615");
  refuse_all(render, "--size", {"5", "0x5", "-1x5", "5x", "nanx2", "1e2x2", "99999x2"}, "WIDTHxHEIGHT in pixels");
  refuse_all(render, "--exposure", {"x", "nan", "inf", "61"}, "a number from -60 to 60");
  refuse_all(render, "--tone", {"film"}, "one of filmic, none");
  refuse_all(render, "--integrator", {"sinlge"}, "one of path, single (did you mean \"single\"?)");
  refuse_all("phase rayleigh", "--at", {"2", "x", "nan", "1,", "1,,0"}, "numbers from -1 to 1, with commas between");
  refuse_all("phase rayleigh", "--sample", {"-0.1", "1.1", "nan"}, "numbers from 0 to 1, with commas between");
  refuse_all("phase rayleigh", "--moments", {"-1", "x", "nan", "1.5", "10001"}, "a whole number from 0 to 10000");
}

TEST_F(Arguments, SlabsThatHaveNoAnswerSayWhatStandsInTheWay) {
  write("ball.medium.json",
        R"({"format": "tyndall-medium/1", "species": [{"scattering": 1, "absorption": 1,
            "profile": {"law": "sphere", "center": [0, 0, 0], "radius": 1}}]})");
  write("layer.medium.json",
        R"({"format": "tyndall-medium/1", "species": [{"scattering": 1, "absorption": 1,
            "profile": {"law": "layer", "bottom": 0, "top": 1}}]})");
  write("fog.medium.json",
        R"({"format": "tyndall-medium/1", "species": [{"scattering": 1, "absorption": 1,
            "profile": {"law": "exponential", "scale_height": 30}}]})");
  write("white.medium.json", R"({"format": "tyndall-medium/1", "species": [{"scattering": 1, "absorption": 0}]})");
  write("grey.medium.json", R"({"format": "tyndall-medium/1", "species": [{"scattering": 1, "absorption": 1}]})");
  present_ = files();
  const std::string metres = "a thickness in metres";
  expect_refused("slab ball.medium.json --thickness 1", "ball.medium.json", "a species in a box, a sphere or noise",
                 "species that vary with height only");
  expect_refused("slab layer.medium.json --thickness inf", "--thickness", "inf for a medium that ends", metres);
  expect_refused("slab fog.medium.json --thickness inf", "--thickness", "inf for a medium that thickens without end",
                 metres);
  expect_refused("slab white.medium.json --thickness inf", "--thickness", "inf for a medium that absorbs nothing",
                 metres);
  expect_refused("slab grey.medium.json --thickness inf --ground 0.5", "--ground", "the ground of a slab that never",
                 "no ground");
}

TEST_F(Arguments, PlacesThatCannotBeWrittenAreNamedBeforeAnyWork) {
  for (const auto& [arguments, where, found, expected] : std::initializer_list<Refused>{
           {"render room.glb -o x", "--output", "the file name \"x\"", "a name ending in .exr or .png"},
           {"render room.glb -o x.tif", "--output", "the file name \"x.tif\"", "a name ending in .exr or .png"},
           {"render room.glb -o ''", "--output", "the file name \"\"", "a name ending in .exr or .png"},
           {"render room.glb -o no/x.png", "no/x.png", "no way to write it", "a place that can be written to"},
           {"render room.glb -o file/x.png", "file/x.png", "no way to write it", "a place that can be written to"},
           {"render room.glb -o /proc/x.png", "/proc/x.png", "no way to write it", "a place that can be written to"},
           {"render room.glb -o folder.exr", "folder.exr", "a folder", "a place that can be written to"},
           {"plot haze -o x.pdf", "--output", "the file name \"x.pdf\"", "a name ending in .svg or .png"},
           {"plot haze -o no/x.svg", "no/x.svg", "no way to write it", "a place that can be written to"},
           {"plot haze -o /proc/x.png", "/proc/x.png", "no way to write it", "a place that can be written to"},
           {"blend haze haze --at 0 -o no/x.medium.json", "no/x.medium.json", "no way to write it", "a place"},
           {"blend haze haze --at 0 -o /proc/x.medium.json", "/proc/x.medium.json", "no way to write it", "a place"}}) {
    expect_refused(arguments, where, found, expected);
  }
}

TEST_F(Arguments, OptionsMayComeBeforeWhatTheyAreAbout) {
  EXPECT_EQ(tyndall("render --size 4x3 --spp 1 --quiet -o x.png -o x.exr room.glb").code, 0);
  EXPECT_TRUE(fs::exists(folder_ / "x.png") && fs::exists(folder_ / "x.exr"));
  EXPECT_EQ(tyndall("slab --mu 0.5,1 haze --thickness 10 --spp 1000").code, 0);
}

TEST_F(Arguments, ProgressInPlainLinesEndsOnce) {
  const Outcome run = tyndall("render room.glb --size 8x6 --spp 8 -o x.png");
  EXPECT_EQ(run.code, 0) << run.err;
  const std::size_t end = run.err.find("100 %");
  ASSERT_NE(end, std::string::npos) << run.err;
  EXPECT_EQ(run.err.find("100 %", end + 1), std::string::npos) << run.err;
}

TEST_F(Arguments, HelpListsLawsWithTheirParameters) {
  for (const char* command : {"phase", "plot"}) {
    const std::string help = tyndall(std::string(command) + " --help").out;
    for (const char* line : {"g: a number above -1 and below 1", "diameter: a number", "[um]",
                             "depolarisation: a number", "slope: a number", "parts: a list", "  isotropic\n"}) {
      EXPECT_THAT(help, HasSubstr(line)) << command;
    }
  }
}

}  // namespace
}  // namespace tyndall
