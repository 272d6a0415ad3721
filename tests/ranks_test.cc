// One picture by several processes: the same as by one, whoever is slow, dies or is given something else.
#include "tests/program.h"
#include "tyndall/image/exr.h"

namespace tyndall::tests {
namespace {

class RanksTest : public ProgramTest {
 protected:
  std::string arguments(const std::string& options) const {
    return "render " + quoted(std::filesystem::path(TYNDALL_SOURCE_DIR) / "examples/street.scene.json") +
           " --size 72x40 --quiet " + options;
  }
  /// mpirun may run as root here, with more processes than processors, its sessions in this test's own folder.
  std::string mpirun(int count) const {
    return "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 TMPDIR=/tmp '" TYNDALL_MPIEXEC
           "' --oversubscribe --bind-to none -n " +
           std::to_string(count);
  }
  Outcome alone(const std::string& options) const { return tyndall(arguments(options)); }
  Outcome by(int count, const std::string& options) const { return tyndall(arguments(options), mpirun(count)); }
  void expect_same_picture(const char* a, const char* b) const {
    const Image x = read_exr(folder_ / a), y = read_exr(folder_ / b);
    ASSERT_EQ(x.planes.size(), y.planes.size());
    for (std::size_t i = 0; i < x.planes.size(); ++i)
      EXPECT_EQ(x.planes[i].values, y.planes[i].values) << x.planes[i].name;
    EXPECT_EQ(x.notes, y.notes);
  }
};

TEST_F(RanksTest, ThePictureIsThatOfOneProcess) {
  ASSERT_EQ(alone("--spp 7 --threads 2 -o one.exr").code, 0);
  const Outcome two = by(2, "--spp 7 --threads 1 -o two.exr");
  EXPECT_EQ(two.code, 0) << two.err;
  expect_same_picture("one.exr", "two.exr");
  const Outcome three = by(3, "--spp 7 --threads 3 --checkpoint film.checkpoint --checkpoint-every 0.1 -o three.exr");
  EXPECT_EQ(three.code, 0) << three.err;
  expect_same_picture("one.exr", "three.exr");
}

TEST_F(RanksTest, OfOneThatDiesNothingIsLostButWhatWasUnderWay) {
  ASSERT_EQ(alone("--spp 32 --threads 2 -o one.exr").code, 0);
  const std::string options =
      "--spp 32 --threads 1 --checkpoint film.checkpoint --checkpoint-every 0.05 --resume -o two.exr";
  // Rank 0 and rank 1 in turns are killed after a while.
  write("mortal.sh",
        "[ \"$OMPI_COMM_WORLD_RANK\" = $1 ] && { shift; exec timeout -s KILL \"$@\"; }; shift 2; exec \"$@\"");
  int died = 0;
  for (int run = 0; run < 60; ++run) {
    const std::string fate =
        run < 6 ? " sh mortal.sh " + std::to_string(run % 2) + " 0." + std::to_string(4 + run) : "";
    const Outcome outcome = tyndall(arguments(options), mpirun(2) + fate);
    if (outcome.code == 0) break;
    EXPECT_TRUE(run < 6) << outcome.err;
    ++died;
  }
  EXPECT_GT(died, 0);
  expect_same_picture("one.exr", "two.exr");
}

TEST_F(RanksTest, AFaultIsToldOnceAndEndsAll) {
  const Outcome outcome = by(3, "--spp 1 -o absent/two.exr");
  EXPECT_EQ(outcome.code, 2);
  const std::size_t at = outcome.err.find("tyndall: absent/two.exr");
  EXPECT_NE(at, std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find("tyndall: absent/two.exr", at + 1), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace tyndall::tests
