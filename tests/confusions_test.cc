// Files and names of another kind than was asked for: each is answered with what it is, not with the first thing in it
// that the reader does not know.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/program.h"

namespace tyndall {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using tests::Outcome;

class Confusions : public tests::ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    const fs::path examples = fs::path(TYNDALL_SOURCE_DIR) / "examples";
    fs::copy(examples / "geometry" / "room.glb", folder_ / "room.glb");
    fs::copy(examples / "geometry" / "room.glb", folder_ / "room.model");
    fs::copy(examples / "media" / "haze.medium.json", folder_ / "haze.medium.json");
    fs::create_directory(folder_ / "folder");
    write("x.scene.json", "{\n  \"camera\": {},\n  \"format\": \"tyndall-scene/1\"\n}");
    write("model.json", R"({"asset": {"version": "2.0"}, "scenes": []})");
    write("empty.json", "");
    write("picture.png", "\x89PNG\r\n\x1a\n");
    write("picture.glb", "\x89PNG\r\n\x1a\n");
    write("picture.jpg", "\xff\xd8\xff\xe0 JFIF");
    write("picture.exr", "v/1\x01 and so on");
    write("picture.hdr", "#?RADIANCE\n");
    write("figure.svg", "<svg/>");
    write("smoke.vdb", std::string("\x20\x42\x44\x56\0\0\0\0", 8));
    write("shown.json", tyndall("show haze --json").out);
    write("schema.json", tyndall("schema").out);
    present_ = files();
  }
  /// `arguments` is refused with a message of found and expected, and nothing is written.
  std::string refusal(const std::string& arguments) const {
    const Outcome run = tyndall(arguments);
    EXPECT_EQ(run.code, 2) << arguments << ": " << run.err;
    EXPECT_EQ(run.out, "") << arguments;
    EXPECT_EQ(files(), present_) << arguments;
    EXPECT_THAT(run.err, AllOf(HasSubstr("found "), HasSubstr("expected "), Not(HasSubstr("unknown key"))));
    return run.err;
  }
  std::size_t present_ = 0;
};

struct Mistaken {
  const char *name, *where, *found;
};
const Mistaken no_media[] = {{"x.scene.json", "x.scene.json:3: at /format", "a scene (tyndall-scene/1)"},
                             {"room.glb", "room.glb", "a glTF model (.glb)"},
                             {"model.json", "model.json:1: at /asset", "a glTF model (.gltf)"},
                             {"picture.png", "picture.png", "a PNG picture"},
                             {"picture.jpg", "picture.jpg", "a JPEG picture"},
                             {"picture.exr", "picture.exr", "an EXR picture"},
                             {"picture.hdr", "picture.hdr", "a Radiance picture"},
                             {"figure.svg", "figure.svg", "XML or HTML text"},
                             {"smoke.vdb", "smoke.vdb", "an OpenVDB volume"},
                             {"shown.json", "shown.json:1", "the numbers that tyndall show prints"},
                             {"schema.json", "schema.json:1", "a JSON Schema"},
                             {"empty.json", "empty.json", "an empty file"},
                             {"folder", "folder", "a folder"}};

TEST_F(Confusions, WhereAMediumIsAskedForOtherFilesAreCalledWhatTheyAre) {
  for (const auto& [name, where, found] : no_media) {
    const std::string file = name;
    for (const std::string& arguments :
         {"show " + file, "phase " + file, "slab " + file + " --thickness 10", "plot " + file + " -o out.svg",
          "blend " + file + " haze --at 0.5 -o out.medium.json", "blend haze " + file + " --at 0 -o out.medium.json",
          "render room.glb --medium " + file + " -o out.png"}) {
      const std::string message = refusal(arguments);
      EXPECT_THAT(message, HasSubstr(std::string(where) + ": found " + found)) << arguments;
      EXPECT_THAT(message, HasSubstr(file == "folder" ? "expected a file" : "expected a medium (tyndall-medium/1)"));
    }
  }
  EXPECT_THAT(refusal("show x.scene.json"), HasSubstr("tyndall render and probe take scenes"));
  EXPECT_THAT(refusal("show rayleigh"), HasSubstr("\"rayleigh\", a law of scattering"));
  EXPECT_THAT(refusal("show ''"), HasSubstr("an empty name"));
}

TEST_F(Confusions, WhereASceneIsAskedForOtherFilesAreCalledWhatTheyAre) {
  for (const std::string command : {"render NAME -o out.png", "probe NAME --origin 0,0,0 --direction 0,0,1"}) {
    const auto of = [&](const std::string& name) {
      std::string text = command;
      return refusal(text.replace(text.find("NAME"), 4, name));
    };
    EXPECT_THAT(of("haze.medium.json"), AllOf(HasSubstr("at /format: found a medium (tyndall-medium/1)"),
                                              HasSubstr("expected a scene"), HasSubstr("--medium")));
    EXPECT_THAT(of("haze"), AllOf(HasSubstr("\"haze\", a preset of a medium"), HasSubstr("--medium haze")));
    EXPECT_THAT(of("rayleigh"), HasSubstr("a law of scattering"));
    EXPECT_THAT(of("''"), HasSubstr("an empty name"));
    EXPECT_THAT(of("room.model"), AllOf(HasSubstr("a glTF model (.glb)"), HasSubstr("the name of a model ends so")));
    EXPECT_THAT(of("model.json"), HasSubstr("a glTF model (.gltf)"));
    EXPECT_THAT(of("picture.png"), HasSubstr("found a PNG picture, expected a scene"));
    EXPECT_THAT(of("picture.glb"), HasSubstr("found a PNG picture, expected a glTF model"));
    EXPECT_THAT(of("smoke.vdb"), HasSubstr("found an OpenVDB volume (.vdb), expected a scene"));
    EXPECT_THAT(of("empty.json"), HasSubstr("found an empty file, expected a scene"));
    EXPECT_THAT(of("folder"), HasSubstr("found a folder"));
  }
}

TEST_F(Confusions, SoAreThoseThatFilesName) {
  const auto of = [&](const std::string& file, const nlohmann::json& text) {
    write(file, text.dump());
    ++present_;
    const std::string message = refusal((file == "names.scene.json" ? "render " : "show ") + file +
                                        (file == "names.scene.json" ? " -o out.png" : ""));
    fs::remove(folder_ / file);
    --present_;
    return message;
  };
  const auto scene = [&](const char* key, const nlohmann::json& value) {
    return of("names.scene.json", {{"format", "tyndall-scene/1"}, {key, value}});
  };
  EXPECT_THAT(scene("medium", "room.glb"), HasSubstr("room.glb: found a glTF model (.glb), expected a medium"));
  EXPECT_THAT(scene("medium", "x.scene.json"), HasSubstr("found a scene (tyndall-scene/1), expected a medium"));
  EXPECT_THAT(scene("geometry", {"haze.medium.json"}), HasSubstr("found a medium (tyndall-medium/1), expected a glTF"));
  EXPECT_THAT(scene("geometry", {"picture.exr"}), HasSubstr("found an EXR picture, expected a glTF model"));
  const auto sky = [](const char* file) { return nlohmann::json{{{"type", "environment"}, {"file", file}}}; };
  EXPECT_THAT(scene("lights", sky("room.glb")), HasSubstr("found a glTF model (.glb), expected a panorama"));
  EXPECT_THAT(scene("lights", sky("picture.png")), HasSubstr("found a PNG picture, expected a panorama"));
  EXPECT_THAT(scene("lights", sky("empty.json")), HasSubstr("found an empty file, expected a panorama"));
  EXPECT_THAT(of("based.medium.json", {{"format", "tyndall-medium/1"}, {"base", "x.scene.json"}}),
              HasSubstr("found a scene (tyndall-scene/1), expected a medium"));
}

}  // namespace
}  // namespace tyndall
