// Media that change, as the program shows, measures and renders them.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "tests/program.h"

namespace tyndall {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;
using tests::Outcome;
using tests::text_of;

/// Air in a box that clears between 1 and 3 s, with noise that the wind carries beside it.
const char* const scene = R"({"format": "tyndall-scene/1", "fps": 4, "film": {"width": 16, "height": 9},
  "camera": {"position": [0, 1, 3], "look_at": [0, 1, 0]},
  "lights": [{"type": "point", "position": [1, 2, -1], "intensity": 20}],
  "medium": {"keyframes": [
    {"time": 1, "conditions": {"model": "simple", "w": 0.9, "thickness": 0.5}},
    {"time": 3, "conditions": {"model": "two_lobes", "r": 0.8, "g1": -0.1, "g2": 0.6, "thickness": 0.01},
     "transition": "morph"}]},
  "volumes": [{"medium": {"species": [{"scattering": 0.3,
      "profile": {"law": "noise", "scale": 0.5, "contrast": 1, "wind": [0.4, 0, 0]}}]},
    "profile": {"law": "sphere", "center": [0, 1, 0], "radius": 1}}]})";

class InTime : public tests::ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write("s.scene.json", scene);
    json medium = json::parse(scene)["medium"];
    medium["format"] = "tyndall-medium/1";
    medium["name"] = "Clearing";
    write("m.medium.json", medium.dump());
  }
  json json_of(const std::string& arguments) const {
    const Outcome run = tyndall(arguments + " --json");
    EXPECT_EQ(run.code, 0) << arguments << run.err;
    return json::parse(run.out, nullptr, false);
  }
};

TEST_F(InTime, ShowSaysWhenAndWhatTheKeysAre) {
  const json at = json_of("show m.medium.json --time 2");
  EXPECT_EQ(at["time"], 2);
  EXPECT_EQ(at["keyframes"], json::parse("[1, 3]"));
  EXPECT_NEAR(at["extinction"][1].get<double>(), std::sqrt(0.5 * 0.8 * 0.01 / 0.8), 1e-12);
  EXPECT_EQ(json_of("show m.medium.json --time 0")["species"], json_of("show m.medium.json --time 1")["species"]);
  EXPECT_FALSE(json_of("show haze --time 2").contains("time"));
  for (const auto& [time, text] :
       {std::pair{"2", "At 2 s, on the way from the key at 1 s to that at 3 s (morph). Keys at 1 s, 3 s."},
        {"3", "At 3 s, a key."},
        {"-1", "At -1 s, as until the first key."},
        {"9", "At 9 s, as since the last key."}}) {
    EXPECT_THAT(tyndall("show m.medium.json --time " + std::string(time)).out, HasSubstr(text));
  }
}

TEST_F(InTime, EveryCommandThatAsksForAMediumTakesATime) {
  // What blend writes at a time is the medium that the others answer for.
  ASSERT_EQ(tyndall("blend m.medium.json m.medium.json --time 2.5 --at 0 -o then.medium.json").code, 0);
  EXPECT_FALSE(json::parse(text_of(folder_ / "then.medium.json")).contains("keyframes"));
  EXPECT_EQ(json_of("show m.medium.json --time 2.5")["species"], json_of("show then.medium.json")["species"]);
  for (const char* arguments : {"phase MEDIUM --at 1,0 --moments 2", "slab MEDIUM --thickness 10 --spp 1000"}) {
    const auto with = [&](const char* medium) {
      return std::string(arguments).replace(std::string(arguments).find("MEDIUM"), 6, medium);
    };
    const json then = json_of(with("m.medium.json") + " --time 2.5");
    EXPECT_EQ(then, json_of(with("then.medium.json"))) << arguments;
    EXPECT_NE(then, json_of(with("m.medium.json"))) << arguments;
  }
  EXPECT_EQ(tyndall("plot m.medium.json --time 2.5 -o a.svg").code, 0);
  EXPECT_EQ(tyndall("plot then.medium.json -o b.svg").code, 0);
  EXPECT_EQ(text_of(folder_ / "a.svg"), text_of(folder_ / "b.svg"));
  for (const char* time : {"nan", "inf", "1e10", "later", ""}) {
    EXPECT_EQ(tyndall("show m.medium.json --time '" + std::string(time) + "'").code, 2) << time;
  }
}

TEST_F(InTime, BlendDoesNotOverwriteWhatItReads) {
  const std::string before = text_of(folder_ / "m.medium.json");
  fs::create_symlink("m.medium.json", folder_ / "link.medium.json");
  for (const char* out : {"m.medium.json", "./m.medium.json", "link.medium.json"}) {
    for (const char* media : {"m.medium.json haze", "haze m.medium.json"}) {
      const Outcome run = tyndall("blend " + std::string(media) + " --at 0.5 --how mix -o " + out);
      EXPECT_EQ(run.code, 2) << out;
      EXPECT_THAT(run.err, HasSubstr("one of the two media"));
    }
  }
  EXPECT_EQ(text_of(folder_ / "m.medium.json"), before);
}

TEST_F(InTime, PresetsBlendByName) {
  for (const std::string how : {"interpolate", "mix", "morph"}) {
    const std::string b = how == "interpolate" ? "mist" : "radiation_fog";
    ASSERT_EQ(tyndall("blend haze " + b + " --at 0.3 --how " + how + " -o c.medium.json").code, 0) << how;
    const double from = json_of("show haze")["extinction"][1], to = json_of("show " + b)["extinction"][1];
    const double between = json_of("show c.medium.json")["extinction"][1];
    EXPECT_NEAR(between, how == "morph" ? std::pow(from, 0.7) * std::pow(to, 0.3) : 0.7 * from + 0.3 * to, 1e-9 * to)
        << how;
  }
}

#if TYNDALL_HAS_RENDER
TEST_F(InTime, ProbeMeasuresThen) {
  const std::string probe = "probe s.scene.json --origin 0,1,3 --direction 0,0,-1 --distance 2 --time ";
  const double early = json_of(probe + "1")["transmittance"][1], late = json_of(probe + "3")["transmittance"][1];
  EXPECT_NEAR(early, std::exp(-0.4 * 2.0), 0.2);
  EXPECT_GT(late, early + 0.2);
}

TEST_F(InTime, FramesAreThePicturesOfTheirTimes) {
  const Outcome run = tyndall("render s.scene.json --spp 2 --frames 4-6 -o a.exr -o a.png");
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("frame 6 (3 of 3)"));
  for (const char* const number : {"0004", "0005", "0006"}) {
    const std::string time = std::to_string(std::stoi(number) / 4.0);
    ASSERT_EQ(tyndall("render s.scene.json --quiet --spp 2 --time " + time + " -o b.exr -o b.png").code, 0);
    for (const std::string kind : {".exr", ".png"}) {
      EXPECT_EQ(text_of(folder_ / ("a." + std::string(number) + kind)), text_of(folder_ / ("b" + kind))) << number;
    }
  }
  EXPECT_NE(text_of(folder_ / "a.0004.png"), text_of(folder_ / "a.0006.png"));
  EXPECT_EQ(files(), 2U + 6U + 2U);
}

TEST_F(InTime, FramesOfAModelThatMovesAreThePicturesOfTheirTimes) {
  const std::string street =
      std::string(TYNDALL_SOURCE_DIR) + "/examples/street.scene.json --quiet --size 32x18 --spp 1 ";
  ASSERT_EQ(tyndall("render " + street + "--frames 11-13 -o a.exr").code, 0);
  ASSERT_EQ(tyndall("render " + street + "--time 0.5 -o b.exr").code, 0);
  EXPECT_EQ(text_of(folder_ / "a.0012.exr"), text_of(folder_ / "b.exr"));
  EXPECT_NE(text_of(folder_ / "a.0011.exr"), text_of(folder_ / "b.exr"));
}

TEST_F(InTime, FramesThatCannotBeAreRefusedBeforeAnyWork) {
  for (const char* frames : {"3-1", "5", "-1-3", "a-b", "1-2x", "1-", "-", "1.5-2", "0-100000", "1-99999999999999"}) {
    const Outcome run = tyndall("render s.scene.json --quiet -o x.exr --frames=" + std::string(frames));
    EXPECT_EQ(run.code, 2) << frames;
    EXPECT_THAT(run.err, HasSubstr("--frames")) << frames;
  }
  EXPECT_EQ(tyndall("render s.scene.json --quiet -o x.exr --frames 0-1 --time 3").code, 2);
  fs::create_directory(folder_ / "x.0002.exr");  // of three pictures one cannot be written
  EXPECT_EQ(tyndall("render s.scene.json --quiet --spp 16777216 -o x.exr --frames 0-2").code, 2);
  fs::remove(folder_ / "x.0002.exr");
  // Too dense on the way from frame 0 to frame 4: read without complaint, known before the first picture.
  const json key = json::parse(R"({"time": 0, "conditions": {"model": "simple", "w": 1, "thickness": 1e30,
      "profile": {"law": "exponential", "scale_height": 1, "base": -60}}})");
  json dense = json::parse(scene);
  dense["medium"]["keyframes"] = {key, key};
  dense["medium"]["keyframes"][1]["time"] = 1;
  dense["medium"]["keyframes"][1]["conditions"]["thickness"] = 1;
  dense["medium"]["keyframes"][1]["conditions"]["profile"]["base"] = 60;
  write("s.scene.json", dense.dump());
  const Outcome run = tyndall("render s.scene.json --quiet --spp 16777216 -o x.exr --frames 0-4");
  EXPECT_EQ(run.code, 2);
  EXPECT_THAT(run.err, HasSubstr("at /medium: at /keyframes/1: found a species too dense"));
  EXPECT_THAT(run.err, HasSubstr("0.75 s, on the way to this key"));
  EXPECT_EQ(files(), 2U);
}

TEST_F(InTime, BeingStoppedEndsTheSequence) {
  const fs::path said = folder_ / "said";
  const pid_t child = ::fork();
  if (child == 0) {
    const int file = ::open(said.c_str(), O_CREAT | O_WRONLY, 0600);
    if (::chdir(folder_.c_str()) != 0 || ::dup2(file, STDERR_FILENO) < 0) ::_exit(126);
    ::execl(TYNDALL_PROGRAM, "tyndall", "render", "s.scene.json", "--spp", "16777216", "--frames", "7-9", "-o", "x.exr",
            nullptr);
    ::_exit(127);
  }
  // It is at work once it tells of it.
  for (int i = 0; i < 1200 && text_of(said).empty(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(50));
  ::kill(child, SIGINT);
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 130);
  EXPECT_TRUE(fs::exists(folder_ / "x.0007.exr"));
  EXPECT_THAT(text_of(said), HasSubstr("stopped at frame 7; its picture has"));
  EXPECT_EQ(files(), 4U);
}
#endif

}  // namespace
}  // namespace tyndall
