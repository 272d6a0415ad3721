// Renders of hours, in seconds: killed at any moment and gone on with, ended by time or noise, looked at meanwhile.
#include "tests/program.h"
#include "tyndall/image/exr.h"
#include "tyndall/sampling/random_stream.h"

namespace tyndall::tests {
namespace {

class LongWork : public ProgramTest {
 protected:
  Outcome render(const std::string& options, const std::string& before = "") const {
    return tyndall("render " + quoted(std::filesystem::path(TYNDALL_SOURCE_DIR) / "examples/street.scene.json") +
                       " --size 64x36 --threads 2 " + options,
                   before);
  }
  void expect_same_picture(const char* a, const char* b) const {
    const Image x = read_exr(folder_ / a), y = read_exr(folder_ / b);
    ASSERT_EQ(x.planes.size(), y.planes.size());
    for (std::size_t i = 0; i < x.planes.size(); ++i)
      EXPECT_EQ(x.planes[i].values, y.planes[i].values) << x.planes[i].name;
    EXPECT_EQ(x.notes, y.notes);
  }
};

TEST_F(LongWork, KilledAtAnyMomentAndResumedIsTheSamePicture) {
  ASSERT_EQ(render("--spp 48 --quiet -o whole.exr").code, 0);
  RandomStream random(11, 0, 0);
  int killed = 0;
  for (int run = 0; run < 200; ++run) {
    char before[64];
    std::snprintf(before, sizeof before, "timeout -s KILL %.3f", 0.05 + 0.6 * random.next());
    const Outcome outcome =
        render("--spp 48 --checkpoint film.checkpoint --checkpoint-every 0.02 --resume --quiet -o resumed.exr", before);
    if (outcome.code == 0) break;
    EXPECT_EQ(outcome.code, -1) << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "resumed.exr"));
    ++killed;
  }
  EXPECT_GT(killed, 2);
  expect_same_picture("whole.exr", "resumed.exr");
}

TEST_F(LongWork, CtrlCLeavesAPictureAndACheckpoint) {
  const Outcome outcome = render("--spp 1000000 --checkpoint film.checkpoint -o picture.exr",
                                 "timeout --foreground --preserve-status -s INT 1");
  EXPECT_EQ(outcome.code, 130) << outcome.err;
  EXPECT_NE(outcome.err.find("stopped"), std::string::npos);
  EXPECT_EQ(read_exr(folder_ / "picture.exr").width, 64);
  // What is in the checkpoint is what the picture shows: going on for no more samples gives it again.
  const Outcome again = render("--spp 1 --checkpoint film.checkpoint --resume --quiet -o again.exr");
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(find_plane(read_exr(folder_ / "picture.exr"), "G")->values,
            find_plane(read_exr(folder_ / "again.exr"), "G")->values);
}

TEST_F(LongWork, AHigherNumberOfSamplesRefinesAFinishedPicture) {
  ASSERT_EQ(render("--spp 16 --quiet -o whole.exr").code, 0);
  ASSERT_EQ(render("--spp 5 --checkpoint film.checkpoint --quiet -o first.exr").code, 0);
  ASSERT_EQ(render("--spp 16 --checkpoint film.checkpoint --resume --quiet -o resumed.exr").code, 0);
  expect_same_picture("whole.exr", "resumed.exr");
}

TEST_F(LongWork, ThePreviewIsThereBeforeTheEnd) {
  const Outcome outcome = render("--spp 1000000 --preview now.png -o picture.exr", "timeout -s KILL 4");
  EXPECT_EQ(outcome.code, -1);
  EXPECT_GT(std::filesystem::file_size(folder_ / "now.png"), 1000u);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "picture.exr"));
}

TEST_F(LongWork, EndsByNoiseAndByTime) {
  EXPECT_EQ(render("--until-noise 40% -o noise.exr").code, 0);
  EXPECT_EQ(render("--seconds 1 -o time.exr").code, 0);
  EXPECT_EQ(read_exr(folder_ / "time.exr").width, 64);
}

TEST_F(LongWork, AnswersMisuseWithExitCode2AndTouchesNothing) {
  write("there.checkpoint", "something of somebody's");
  write("empty.checkpoint", "");
  for (const auto& [options, answer] : {std::pair{"--checkpoint there.checkpoint", "already there"},
                                        {"--checkpoint there.checkpoint --resume", "there.checkpoint"},
                                        {"--checkpoint empty.checkpoint --resume", "empty.checkpoint"},
                                        {"--resume", "--checkpoint"},
                                        {"--preview now.jpg", ".png"},
                                        {"--checkpoint absent/film.checkpoint", "absent"},
                                        {"--preview absent/now.png", "absent"},
                                        {"--until-noise 0", "--until-noise"},
                                        {"--until-noise nan", "--until-noise"},
                                        {"--until-noise 2%%", "--until-noise"},
                                        {"--until-noise 0.1 --integrator single", "single"},
                                        {"--seconds -1", "--seconds"},
                                        {"--seconds nan", "--seconds"},
                                        {"--checkpoint-every 0 --checkpoint x", "--checkpoint-every"}}) {
    const Outcome outcome = render(std::string(options) + " --spp 1 -o picture.exr");
    EXPECT_EQ(outcome.code, 2) << options << outcome.err;
    EXPECT_NE(outcome.err.find(answer), std::string::npos) << options << ": " << outcome.err;
    EXPECT_EQ(files(), 2u) << options;
  }
  EXPECT_EQ(text_of(folder_ / "there.checkpoint"), "something of somebody's");
}

}  // namespace
}  // namespace tyndall::tests
