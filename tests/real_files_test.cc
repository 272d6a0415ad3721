// The program on files that other programs wrote: rendered in fog, and the malformed ones answered with a message.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/picture.h"
#include "tests/program.h"
#include "tests/shared_folder.h"

namespace tyndall {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using tests::Outcome;
using tests::quoted;

class RealFiles : public tests::ProgramTest {
 protected:
  /// Renders small and with few samples; returns the mean of the picture.
  double rendered(const std::string& arguments) const {
    const Outcome run = tyndall("render " + arguments + " --size 48x36 --spp 2 --quiet -o picture.exr");
    EXPECT_EQ(run.code, 0) << arguments << ": " << run.err;
    if (run.code != 0) return 0.0;
    return tests::check_picture(folder_ / "picture.exr");
  }
  static std::string fog() {
    return quoted(fs::path(TYNDALL_SOURCE_DIR) / "examples" / "media" / "harbour_fog.medium.json");
  }
};

TEST_F(RealFiles, AreRenderedInFog) {
  TYNDALL_NEEDS_SHARED_FILE(folder, "assets/gltf");
  for (const char* name :
       {"cornell/cornellBox.gltf", "khronos-lights/lights.gltf", "blender-io/02_suzanne/02_suzanne.gltf",
        "blender-io/04_lights/04_lights.gltf", "blender-io/05_metallic_sphere_light/05_metallic_sphere_light.gltf",
        "default_scene_three_lights.glb", "shaderball/shaderball.glb"}) {
    ASSERT_TRUE(fs::exists(folder / name)) << name;
    EXPECT_GT(rendered(quoted(folder / name) + " --medium " + fog()), 0.0) << name;
  }
}

TEST_F(RealFiles, AreRenderedBySingleScattering) {
  TYNDALL_NEEDS_SHARED_FILE(file, "assets/gltf/default_scene_three_lights.glb");
  EXPECT_GT(rendered(quoted(file) + " --integrator single --medium " + fog()), 0.0);
}

TEST_F(RealFiles, PanoramasLightAScene) {
  TYNDALL_NEEDS_SHARED_FILE(folder, "assets/environments");
  for (const char* name : {"gltf-transform/royal_esplanade_1k.hdr", "open-shading-language/kitchen_probe.hdr",
                           "openexr-images/KernerEnvLatLong.exr"}) {
    ASSERT_TRUE(fs::exists(folder / name)) << name;
    // Fog in a ball: an endless one would hide the panorama.
    const nlohmann::json scene = {
        {"format", "tyndall-scene/1"},
        {"lights", {{{"type", "environment"}, {"file", fs::absolute(folder / name).string()}}}},
        {"volumes",
         {{{"medium", {{"species", {{{"scattering", 0.1}, {"absorption", 0}}}}}},
           {"profile", {{"law", "sphere"}, {"center", {0, 0, 0}}, {"radius", 2}}}}}}};
    write("x.scene.json", scene.dump());
    EXPECT_GT(rendered("x.scene.json --allow-path"), 0.0) << name;
    EXPECT_GT(rendered("x.scene.json --allow-path --integrator single"), 0.0) << name;
    const Outcome refused = tyndall("render x.scene.json -o refused.exr");
    EXPECT_EQ(refused.code, 2);
    EXPECT_THAT(refused.err, HasSubstr("--allow-path"));
  }
}

TEST_F(RealFiles, MalformedOnesAreAnsweredWithTheirNameLineAndPointer) {
  TYNDALL_NEEDS_SHARED_FILE(folder, "assets/gltf/malformed");
  int refused = 0;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".gltf") continue;
    const Outcome run = tyndall("render " + quoted(entry.path()) + " --size 8x6 --spp 1 --quiet -o picture.exr");
    EXPECT_EQ(run.code, 2) << entry.path() << ": " << run.err;
    EXPECT_THAT(run.err,
                testing::ContainsRegex(entry.path().filename().string() + ":[0-9]+: at /[A-Za-z0-9/_]+: found"));
    EXPECT_THAT(run.err, HasSubstr("expected"));
    EXPECT_EQ(files(), 0u) << entry.path();
    ++refused;
  }
  EXPECT_GE(refused, 14);
}

}  // namespace
}  // namespace tyndall
