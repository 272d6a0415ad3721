// tyndall plot as a user runs it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <string>

#include "tests/program.h"

namespace tyndall {
namespace {

using testing::HasSubstr;
using tests::Outcome;
using tests::ProgramTest;
using tests::text_of;

class PlotProgram : public ProgramTest {
 protected:
  static std::string example(const std::string& name) {
    return "'" TYNDALL_SOURCE_DIR "/examples/media/" + name + ".medium.json'";
  }
  /// Width and height in the header of a PNG file, 0 where it is none.
  std::pair<unsigned, unsigned> png_size(const std::string& name) const {
    const std::string bytes = text_of(folder_ / name);
    if (bytes.size() < 24 || bytes.substr(1, 3) != "PNG") return {0, 0};
    const auto word = [&](std::size_t at) {
      unsigned x = 0;
      for (std::size_t i = at; i < at + 4; ++i) x = x << 8 | static_cast<std::uint8_t>(bytes[i]);
      return x;
    };
    return {word(16), word(20)};
  }
};

TEST_F(PlotProgram, WritesTheSameSvgEveryTimeAndNothingElse) {
  const std::string arguments = "plot " + example("harbour_fog") + " mie_hazy --species -o ";
  for (const char* name : {"a.svg", "b.svg"}) {
    const Outcome run = tyndall(arguments + name);
    EXPECT_EQ(run.code, 0);
    EXPECT_EQ(run.out + run.err, "");
  }
  const std::string svg = text_of(folder_ / "a.svg");
  EXPECT_EQ(svg, text_of(folder_ / "b.svg"));
  for (const char* part : {"Harbour fog at dawn", "mie hazy", "visibility", "sr\u207b\u00b9", "</svg>\n"}) {
    EXPECT_THAT(svg, HasSubstr(part));
  }
  EXPECT_EQ(files(), 2u);
}

TEST_F(PlotProgram, GivesAPngTheSizeAskedFor) {
#if TYNDALL_HAS_CAIRO
  EXPECT_EQ(tyndall("plot rayleigh -o a.png --size 800x700").code, 0);
  EXPECT_EQ(png_size("a.png"), std::pair(800u, 700u));
  EXPECT_EQ(tyndall("plot rayleigh -o b.png --size 800x700").code, 0);
  EXPECT_EQ(text_of(folder_ / "a.png"), text_of(folder_ / "b.png"));
  EXPECT_EQ(tyndall("plot rayleigh -o c.png").code, 0);
  EXPECT_EQ(png_size("c.png").first, 1600u);
#else
  const Outcome run = tyndall("plot rayleigh -o a.png");
  EXPECT_EQ(run.code, 2);
  EXPECT_THAT(run.err, HasSubstr("cairo"));
#endif
}

TEST_F(PlotProgram, NamesChannelsByTheirWavelengths) {
  write("m.medium.json", R"({"format": "tyndall-medium/1", "channels": {"wavelengths_nm": [650, 532, 450]},
    "species": [{"scattering": [0.1, 0.2, 0.4]}]})");
  ASSERT_EQ(tyndall("plot m.medium.json -o a.svg").code, 0);
  EXPECT_THAT(text_of(folder_ / "a.svg"), HasSubstr(">532 nm<"));
}

TEST_F(PlotProgram, CallsAFileWithoutANameByItsOwn) {
  write("morning.medium.json", R"({"format": "tyndall-medium/1", "species": [{"scattering": 1}]})");
  ASSERT_EQ(tyndall("plot morning.medium.json -o a.svg").code, 0);
  EXPECT_THAT(text_of(folder_ / "a.svg"), HasSubstr(">morning<"));
}

TEST_F(PlotProgram, AnswersMisuseWithExitCode2AndWritesNothing) {
  for (const std::string& arguments :
       {std::string("plot"),
        std::string("plot rayleigh"),
        std::string("plot -o a.svg"),
        std::string("plot rayleigh -o a.pdf"),
        std::string("plot rayleigh -o svg"),
        std::string("plot rayleigh -o ''"),
        std::string("plot raleigh -o a.svg"),
        std::string("plot absent.medium.json -o a.svg"),
        std::string("plot henyey_greenstein:g=1 -o a.svg"),
        std::string("plot rayleigh -o a.svg --what everything"),
        std::string("plot rayleigh -o a.svg --what polar,"),
        std::string("plot rayleigh -o a.svg --what transmittance"),
        std::string("plot rayleigh -o a.svg --size 800"),
        std::string("plot rayleigh -o a.svg --size 800x"),
        std::string("plot rayleigh -o a.svg --size -800x600"),
        std::string("plot rayleigh -o a.svg --size 8x6"),
        std::string("plot rayleigh -o a.svg --size 1e3x600"),
        std::string("plot rayleigh -o a.svg --size 99999x99999"),
        std::string("plot rayleigh -o a.svg --size 16384x16384"),
        std::string("plot rayleigh -o a.svg --size 3000x100"),
        std::string("plot rayleigh -o no/such/folder/a.svg"),
        std::string("plot rayleigh -o a.svg --lgo"),
        std::string("plot i i i -o a.svg"),
        std::string(
            "plot rayleigh rayleigh rayleigh rayleigh rayleigh rayleigh rayleigh rayleigh rayleigh -o a.svg")}) {
    const Outcome run = tyndall(arguments);
    EXPECT_EQ(run.code, 2) << arguments << ": " << run.err;
    EXPECT_EQ(run.out, "") << arguments;
    EXPECT_NE(run.err, "") << arguments;
    EXPECT_EQ(files(), 0u) << arguments;
  }
  EXPECT_THAT(tyndall("plot rayleigh -o a.pdf").err, HasSubstr(".svg or .png"));
  EXPECT_THAT(tyndall("plot raleigh -o a.svg").err, HasSubstr("did you mean \"rayleigh\"?"));
  EXPECT_THAT(tyndall("plot rayleigh -o a.svg --what pahse").err, HasSubstr("did you mean \"phase\"?"));
}

TEST_F(PlotProgram, LeavesTheOldFileWhereItCannotDraw) {
  write("a.svg", "old");
  EXPECT_EQ(tyndall("plot absent.medium.json -o a.svg").code, 2);
  EXPECT_EQ(text_of(folder_ / "a.svg"), "old");
}

}  // namespace
}  // namespace tyndall
