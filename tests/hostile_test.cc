// The program in the hands of somebody who means it no good: a message and exit code 2, or a sound picture; no crash,
// no half-written file.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>
#include <thread>

#include "tests/picture.h"
#include "tests/program.h"

namespace tyndall {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;
using tests::Outcome;
using tests::quoted;

json fog(double scattering, double g) {
  return {{"species",
           {{{"scattering", scattering}, {"absorption", 0.1}, {"phase", {{"law", "henyey_greenstein"}, {"g", g}}}}}}};
}

json plain_scene() {
  return {{"format", "tyndall-scene/1"},
          {"medium", fog(0.3, 0.7)},
          {"lights",
           {{{"type", "point"}, {"position", {1, 2, -3}}, {"intensity", 20}},
            {{"type", "sun"}, {"direction", {0.3, -1, 0.2}}, {"irradiance", 1}, {"angular_diameter", 0.5}}}},
          {"camera", {{"position", {0, 1, 3}}, {"look_at", {0, 1, 0}}, {"up", {0, 1, 0}}, {"vertical_fov", 50}}},
          {"film", {{"width", 8}, {"height", 6}}}};
}

class Hostile : public tests::ProgramTest {
 protected:
  Outcome render(const json& scene, const std::string& arguments = "") const {
    write("x.scene.json", scene.dump());
    return tyndall("render x.scene.json --spp 2 --threads 2 --quiet -o x.exr " + arguments);
  }
  /// `scene` with one value, named by its JSON pointer, replaced.
  static json changed(const char* pointer, const json& value) {
    json scene = plain_scene();
    scene[json::json_pointer(pointer)] = value;
    return scene;
  }
};

TEST_F(Hostile, NumbersThatCannotBeAreRefusedWithTheirPlace) {
  const json empty_box = {{"medium", fog(1, 0)}, {"profile", {{"law", "box"}, {"min", {0, 0, 0}}, {"max", {1, 0, 1}}}}};
  const json ball_inside_out = {{"medium", fog(1, 0)},
                                {"profile", {{"law", "sphere"}, {"center", {0, 0, 0}}, {"radius", -1}}}};
  for (const auto& [pointer, value] :
       std::initializer_list<std::pair<const char*, json>>{{"/lights/0/intensity", -1},
                                                           {"/lights/0/intensity", 1e308},
                                                           {"/lights/0/position", {1e308, 0}},
                                                           {"/lights/1/direction", {0, 0, 0}},
                                                           {"/lights/1/irradiance", 1e200},
                                                           {"/medium/species/0/phase/g", 1},
                                                           {"/medium/species/0/phase/g", -1},
                                                           {"/medium", fog(1e300, 0)},
                                                           {"/film/width", 0},
                                                           {"/film/height", 1e9},
                                                           {"/film/height", 2.5},
                                                           {"/camera/up", {0, 0, 1}},
                                                           {"/camera/up", {0, 0, 0}},
                                                           {"/camera/look_at", {0, 1, 3}},
                                                           {"/camera/vertical_fov", 180},
                                                           {"/meters_per_unit", 0},
                                                           {"/integrator", {{"spp", 0}}},
                                                           {"/integrator", {{"name", "pth"}}},
                                                           {"/volumes", {empty_box}},
                                                           {"/volumes", {ball_inside_out}}}) {
    const Outcome run = render(changed(pointer, value));
    EXPECT_EQ(run.code, 2) << pointer << " " << value << ": " << run.err;
    EXPECT_THAT(run.err, HasSubstr("x.scene.json:1: at " + std::string(pointer))) << value;
    EXPECT_THAT(run.err, HasSubstr("expected"));
    EXPECT_EQ(files(), 1u) << pointer;
  }
}

TEST_F(Hostile, NumbersAtTheEdgeOfSenseGiveSoundPictures) {
  const auto ball = [](double radius, double scattering) {
    return json{
        {{"medium", fog(scattering, 0)}, {"profile", {{"law", "sphere"}, {"center", {0, 1, 0}}, {"radius", radius}}}}};
  };
  for (const auto& [pointer, value] : std::initializer_list<std::pair<const char*, json>>{
           {"/lights/0/position", {1e308, 1e308, 1e308}},
           {"/lights/0/position", {0, 1, 3}},  // in the camera
           {"/lights/0/position", {0, 1, 0}},  // on the camera's axis
           {"/lights/0/intensity", 1e30},
           {"/lights/1/angular_diameter", 1e-300},
           {"/lights/1/angular_diameter", 90},
           {"/lights/0", {{"type", "environment"}, {"radiance", 1e30}, {"scale", 1e30}}},
           {"/medium/species/0/phase/g", 0.9999},
           {"/medium/species/0/phase/g", -0.9999},
           {"/medium/species/0/phase/g", 0.99999999999999989},
           {"/medium", fog(1e6, 0.5)},
           {"/medium", fog(1e-300, 0.5)},
           {"/volumes", ball(1e-30, 1)},
           {"/volumes", ball(1e-30, 1e30)},
           {"/volumes", ball(1e200, 1)},
           {"/camera/vertical_fov", 1e-300},
           {"/camera/vertical_fov", 179.99999999},
           {"/camera/position", {1e100, 0, 0}},
           {"/meters_per_unit", 1e-20},
           {"/meters_per_unit", 1e20}}) {
    for (const char* integrator : {"path", "single"}) {
      const Outcome run = render(changed(pointer, value), std::string("--integrator ") + integrator);
      EXPECT_EQ(run.code, 0) << pointer << " " << value << ": " << run.err;
      if (run.code == 0) tests::check_picture(folder_ / "x.exr");
    }
  }
}

TEST_F(Hostile, OptionsThatCannotBeAreRefusedBeforeAnyWork) {
  write("x.scene.json", plain_scene().dump());
  fs::create_directory(folder_ / "folder.exr");
  for (const char* options : {"--spp 0 -o x.exr",
                              "--spp -1 -o x.exr",
                              "--spp 1e99 -o x.exr",
                              "--spp nan -o x.exr",
                              "--seed -1 -o x.exr",
                              "--size 0x0 -o x.exr",
                              "--size 5 -o x.exr",
                              "--size 16384x16384 -o x.exr",
                              "--size 99999999999x1 -o x.exr",
                              "--exposure nan -o x.exr",
                              "--exposure inf -o x.exr",
                              "--threads 0 -o x.exr",
                              "--tone film -o x.exr",
                              "--medium '' -o x.exr",
                              "--medium . -o x.exr",
                              "--medium absent -o x.exr",
                              "-o x",
                              "-o .exr",
                              "-o ''",
                              "-o /proc/x.exr",
                              "-o no/such/folder/x.exr",
                              "-o folder.exr",
                              "-o x.exr -o x.exr",
                              "-o x.exr -o ./x.exr",
                              ""}) {
    const Outcome run = tyndall("render x.scene.json --quiet " + std::string(options));
    EXPECT_EQ(run.code, 2) << options << ": " << run.err;
    EXPECT_NE(run.err, "");
    EXPECT_EQ(files(), 2u) << options;
  }
  // The whole night's samples are asked for: it must not start them.
  EXPECT_EQ(tyndall("render x.scene.json --spp 16777216 -o x.exr -o no/such/folder/x.exr").code, 2);
  EXPECT_EQ(files(), 2u);
}

TEST_F(Hostile, ADiskThatRunsFullIsAFailureThatLeavesNothing) {
  write("x.scene.json", changed("/film", {{"width", 200}, {"height", 150}}).dump());
  // Blocks of 512 bytes: room for the message, not for the picture.
  const Outcome run = tyndall("render x.scene.json --spp 1 --quiet -o x.exr", "ulimit -f 20; trap '' XFSZ;");
  EXPECT_EQ(run.code, 1) << run.err;
  EXPECT_THAT(run.err, HasSubstr("x.exr: could not be written"));
  EXPECT_EQ(files(), 1u);
}

TEST_F(Hostile, FilesThatAreNotWhatTheySayAreRefused) {
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  fs::create_symlink("/etc/passwd", folder_ / "link.glb");
  fs::create_symlink("circle.glb", folder_ / "circle.glb");
  fs::create_directory(folder_ / "folder.glb");
  write("empty.glb", "");
  write("text.glb", "glTF, I promise");
  write("text.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 99999 +X 99999\n");
  write("text.exr", "v/1\x01 not at all");
  write("deep.json", std::string(100000, '['));
  write("deep.scene.json", "{\"format\": \"tyndall-scene/1\", \"medium\": " + std::string(100000, '[') + "}");
  write("latin.json", "{\"name\": \"\xe9t\xe9\"}");
  const std::size_t before = files() + 1;
  for (const char* geometry : {"", ".", "pipe", "link.glb", "circle.glb", "folder.glb", "empty.glb", "text.glb",
                               "absent.glb", "x.scene.json", "/dev/zero", "../../../etc/passwd"}) {
    EXPECT_EQ(render(changed("/geometry", {geometry})).code, 2) << geometry;
    EXPECT_EQ(files(), before) << geometry;
  }
  for (const char* panorama : {"", ".", "pipe", "text.hdr", "text.exr", "empty.glb", "/dev/zero"}) {
    EXPECT_EQ(render(changed("/lights/0", {{"type", "environment"}, {"file", panorama}})).code, 2) << panorama;
  }
  for (const char* medium : {"", ".", "pipe", "deep.json", "latin.json", "x.scene.json", "text.glb", "/dev/zero"}) {
    EXPECT_EQ(render(changed("/medium", medium)).code, 2) << medium;
    EXPECT_EQ(tyndall("show '" + std::string(medium) + "'").code, 2) << medium;
  }
  EXPECT_EQ(tyndall("render deep.scene.json -o x.exr").code, 2);
  EXPECT_EQ(files(), before);
}

TEST_F(Hostile, MessagesCannotSteerATerminal) {
  write("x.medium.json", "{\"format\": \"tyndall-medium/1\", \"\\u001b[31m\\u202eevil\\n\": 1}");
  for (const char* arguments :
       {"show x.medium.json", "show \"$(printf 'a\\033[31mb\\nc')\"", "\"$(printf 'a\\033[31mb\\nc')\"",
        "render \"$(printf 'a\\033[31m')\" -o x.exr", "show x.medium.json \"$(printf -- '--\\033[31m')\"",
        "render x --spp \"$(printf '\\033[31m')\" -o x.exr"}) {
    const Outcome run = tyndall(arguments);
    EXPECT_EQ(run.code, 2) << arguments;
    EXPECT_EQ(run.err.find('\033'), std::string::npos) << arguments;
    EXPECT_EQ(run.err.find("\u202e"), std::string::npos) << arguments;
  }
}

TEST_F(Hostile, ClosedStandardStreamsDoNotGetIntoFiles) {
  write("x.scene.json", plain_scene().dump());
  const std::string program = "cd " + quoted(folder_) + " && '" TYNDALL_PROGRAM "' ";
  EXPECT_EQ(std::system((program + "render x.scene.json --spp 2 -o x.exr <&- >&- 2>&-").c_str()), 0);
  EXPECT_GT(tests::check_picture(folder_ / "x.exr"), 0.0);
  write("x.medium.json", R"({"format": "tyndall-medium/1"})");
  const int status = std::system((program + "show x.medium.json >&- 2>/dev/null").c_str());
  EXPECT_EQ(WEXITSTATUS(status), 1) << "what it was asked to print went nowhere";
}

TEST_F(Hostile, BeingStoppedWritesTheSamplesThatThereAre) {
  write("x.scene.json", plain_scene().dump());
  for (const int signal : {SIGINT, SIGTERM}) {
    int progress[2];
    ASSERT_EQ(::pipe2(progress, O_CLOEXEC), 0);
    const std::string scene = (folder_ / "x.scene.json").string(), picture = (folder_ / "x.exr").string();
    const pid_t child = ::fork();
    if (child == 0) {
      ::dup2(progress[1], STDERR_FILENO);
      ::execl(TYNDALL_PROGRAM, "tyndall", "render", scene.c_str(), "--spp", "16777216", "-o", picture.c_str(), nullptr);
      ::_exit(127);
    }
    ::close(progress[1]);
    // It is at work once it tells of it. That nobody listens any more is no reason for it to end.
    char first = 0;
    ASSERT_EQ(::read(progress[0], &first, 1), 1);
    ::close(progress[0]);
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    ::kill(child, signal);
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFEXITED(status)) << "ended by signal " << WTERMSIG(status);
    EXPECT_EQ(WEXITSTATUS(status), 128 + signal);
    EXPECT_GT(tests::check_picture(folder_ / "x.exr"), 0.0);
    fs::remove(folder_ / "x.exr");
    EXPECT_EQ(files(), 1u);
  }
}

}  // namespace
}  // namespace tyndall
