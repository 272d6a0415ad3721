#include "tyndall/image/png.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "tyndall/document/fault.h"
#include "tyndall/document/whole_file.h"
#include "tyndall/image/decode.h"

namespace tyndall {
namespace {

TEST(Tone, NoneIsTheSrgbCurveCutAtWhite) {
  // Codes of linear greys (IEC 61966-2-1): 0.0031308 is where the curve's two parts meet.
  EXPECT_EQ(develop(Spectrum::grey(0.0), {0.0, Tone::none})[0], 0);
  EXPECT_EQ(develop(Spectrum::grey(0.0031308), {0.0, Tone::none})[0], 10);
  EXPECT_EQ(develop(Spectrum::grey(0.18), {0.0, Tone::none})[0], 118);
  EXPECT_EQ(develop(Spectrum::grey(0.5), {0.0, Tone::none})[0], 188);
  EXPECT_EQ(develop(Spectrum::grey(1.0), {0.0, Tone::none})[0], 255);
  EXPECT_EQ(develop(Spectrum::grey(7.0), {0.0, Tone::none})[0], 255);
  for (int code = 0; code < 256; ++code) {
    EXPECT_EQ(develop(Spectrum::grey(linear_from_srgb(code / 255.0)), {0.0, Tone::none})[1], code);
  }
}

TEST(Tone, ExposureDoublesPerStop) {
  for (const Tone tone : {Tone::filmic, Tone::none}) {
    EXPECT_EQ(develop({{0.1, 0.2, 0.05}}, {2.0, tone}), develop({{0.4, 0.8, 0.2}}, {0.0, tone}));
    EXPECT_EQ(develop({{0.4, 0.8, 0.2}}, {-2.0, tone}), develop({{0.1, 0.2, 0.05}}, {0.0, tone}));
  }
}

TEST(Tone, FilmicKeepsMiddleGreyAndNeutralsAndOrder) {
  EXPECT_NEAR(filmic(Spectrum::grey(0.18))[1], 0.18, 1e-5);
  double before = -1.0;
  for (double x = 0.0; x < 30.0; x = x * 1.1 + 0.001) {
    const Spectrum shown = filmic(Spectrum::grey(x));
    EXPECT_NEAR(shown[0], shown[1], 2e-5);
    EXPECT_NEAR(shown[2], shown[1], 2e-5);
    EXPECT_GE(shown[1], before);
    EXPECT_LE(shown[1], 1.0);
    before = shown[1];
  }
  EXPECT_LT(filmic(Spectrum::grey(16.0))[1], 1.0);
  EXPECT_NEAR(filmic(Spectrum::grey(17.7))[1], 1.0, 1e-4);
}

/// Angle around the neutral axis, in degrees.
double hue(const Spectrum& c) {
  return std::atan2(std::sqrt(3.0) * (c[1] - c[2]), 2.0 * c[0] - c[1] - c[2]) * 180.0 / std::numbers::pi;
}

TEST(Tone, FilmicTurnsBrightColorsPaleRatherThanIntoOthers) {
  for (const Spectrum color : {Spectrum{{1.0, 0.3, 0.05}}, Spectrum{{0.05, 0.2, 1.0}}, Spectrum{{0.1, 1.0, 0.2}}}) {
    double pale = -1.0;
    for (const double exposure : {0.05, 0.2, 1.0, 5.0, 20.0}) {
      const Spectrum shown = filmic(color * exposure);
      if (exposure <= 1.0) {
        EXPECT_NEAR(hue(shown), hue(color), 10.0) << exposure;
      }
      for (std::size_t c = 0; c < 3; ++c) {
        if (color[c] == largest(color)) {
          EXPECT_EQ(shown[c], largest(shown)) << exposure;
        }
      }
      EXPECT_GE(smallest(shown) / largest(shown), pale);
      pale = smallest(shown) / largest(shown);
    }
    EXPECT_GT(pale, 0.85);
  }
}

TEST(Tone, WhatIsNoColorIsShownAllTheSame) {
  const double nan = std::nan("");
  for (const Tone tone : {Tone::filmic, Tone::none}) {
    EXPECT_EQ(develop(Spectrum::grey(nan), {0.0, tone})[0], 0);
    EXPECT_EQ(develop(Spectrum::grey(-1.0), {0.0, tone})[0], 0);
    EXPECT_EQ(develop(Spectrum::grey(INFINITY), {0.0, tone})[0], 255);
  }
}

TEST(Png, HoldsTheDevelopedPixels) {
  const std::filesystem::path file =
      std::filesystem::path(testing::TempDir()) / ("tyndall_png" + std::to_string(std::random_device()()) + ".png");
  Image image{13, 4, {}, {}};
  add_layer(image, "");
  add_layer(image, "single", 0.25F);
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t i = 0; i < image.pixel_count(); ++i) {
      image.planes[c].values[i] = 0.03F * static_cast<float>(i) / static_cast<float>(c + 1);
    }
  }
  for (const Development how : {Development{}, Development{-1.5, Tone::none}}) {
    write_png(file, image, how);
    const auto read = decode_picture("file", read_whole_file(file));
    ASSERT_EQ(read.width, 13);
    ASSERT_EQ(read.height, 4);
    for (std::size_t i = 0; i < image.pixel_count(); ++i) {
      const Spectrum linear{{image.planes[0].values[i], image.planes[1].values[i], image.planes[2].values[i]}};
      const auto code = develop(linear, how);
      EXPECT_TRUE(std::equal(code.begin(), code.end(), read.rgb.begin() + static_cast<std::ptrdiff_t>(3 * i)));
    }
  }
  write_png(file, image, {0.0, Tone::none}, "single");
  EXPECT_EQ(decode_picture("file", read_whole_file(file)).rgb[0], 137);
  EXPECT_THROW(write_png(file, image, {}, "absent"), Fault);
  EXPECT_THROW(write_png(file, 4, 4, std::vector<std::uint8_t>(7)), Fault);
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace tyndall
