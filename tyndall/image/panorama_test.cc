#include "tyndall/image/panorama.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <random>

#include "tests/shared_folder.h"
#include "tyndall/document/fault.h"
#include "tyndall/document/whole_file.h"
#include "tyndall/image/exr.h"
#include "tyndall/image/radiance_picture.h"

namespace tyndall {
namespace {

namespace fs = std::filesystem;

fs::path fresh_file(const std::string& name) {
  return fs::path(testing::TempDir()) / ("tyndall_panorama" + std::to_string(std::random_device()()) + name);
}

/// A flat (not run-length coded) Radiance picture: 2 x 2 pixels of mantissas and a common exponent, 128 being 1/256.
std::vector<std::uint8_t> tiny_hdr() {
  const std::string head = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 2\n";
  std::vector<std::uint8_t> bytes(head.begin(), head.end());
  for (const int b : {128, 64, 32, 129, 1, 2, 3, 136, 0, 0, 0, 0, 255, 255, 255, 128}) {
    bytes.push_back(static_cast<std::uint8_t>(b));
  }
  return bytes;
}

TEST(Panorama, RadianceFilesAreReadTopRowFirst) {
  const fs::path file = fresh_file(".hdr");
  write_whole_file(file, tiny_hdr());
  const Panorama p = read_panorama(file);
  ASSERT_EQ(p.width, 2);
  ASSERT_EQ(p.height, 2);
  EXPECT_EQ(p.radiance[0], (std::array<float, 3>{1.0F, 0.5F, 0.25F}));
  EXPECT_EQ(p.radiance[1], (std::array<float, 3>{1.0F, 2.0F, 3.0F}));
  EXPECT_EQ(p.radiance[2], (std::array<float, 3>{0.0F, 0.0F, 0.0F}));
  EXPECT_EQ(p.radiance[3], (std::array<float, 3>{0.99609375F, 0.99609375F, 0.99609375F}));
  fs::remove(file);
}

std::string radiance_head(const std::string& size) { return "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n" + size + "\n"; }

Decoded<float> decoded(const std::string& head, const std::vector<int>& pixels) {
  std::vector<std::uint8_t> bytes(head.begin(), head.end());
  for (const int b : pixels) bytes.push_back(static_cast<std::uint8_t>(b));
  return decode_radiance("bytes", bytes);
}

TEST(Panorama, RadianceRowsMayRunEitherWay) {
  const std::vector<int> pixels{128, 0, 0, 129, 0, 128, 0, 129};  // red, then green
  EXPECT_EQ(decoded(radiance_head("-Y 1 +X 2"), pixels).rgb, (std::vector<float>{1, 0, 0, 0, 1, 0}));
  EXPECT_EQ(decoded(radiance_head("-Y 1 -X 2"), pixels).rgb, (std::vector<float>{0, 1, 0, 1, 0, 0}));
  EXPECT_EQ(decoded(radiance_head("+Y 2 +X 1"), pixels).rgb, (std::vector<float>{0, 1, 0, 1, 0, 0}));
  EXPECT_THROW(decoded(radiance_head("+X 2 -Y 1"), pixels), Fault);
  EXPECT_THROW(decoded("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 2\n", pixels), Fault);
}

TEST(Panorama, OldAndNewRunsOfRadianceFilesAreReadAlike) {
  const auto old = decoded(radiance_head("-Y 1 +X 9"), {128, 64, 0, 129, 1, 1, 1, 8});
  const auto fresh = decoded(radiance_head("-Y 1 +X 9"), {2, 2, 0, 9, 137, 128, 137, 64, 137, 0, 137, 129});
  EXPECT_EQ(old.rgb, fresh.rgb);
  EXPECT_EQ(old.rgb[26], 0.0F);
  EXPECT_EQ(old.rgb[25], 0.5F);
  EXPECT_THROW(decoded(radiance_head("-Y 1 +X 9"), {1, 1, 1, 8}), Fault) << "nothing to repeat";
  EXPECT_THROW(decoded(radiance_head("-Y 1 +X 9"), {128, 64, 0, 129, 1, 1, 1, 9}), Fault) << "too long";
  EXPECT_THROW(decoded(radiance_head("-Y 1 +X 9"), {2, 2, 0, 9, 137}), Fault) << "cut short";
  EXPECT_THROW(decoded(radiance_head("-Y 1 +X 9"), {2, 2, 0, 9, 0}), Fault) << "a run of nothing";
  EXPECT_THROW(decoded(radiance_head("-Y 16384 +X 8192"), {128, 64, 0, 129}), Fault) << "more than its bytes hold";
}

TEST(Panorama, ExrFilesAreToldByContentAndMended) {
  const fs::path file = fresh_file(".hdr");  // misnamed
  Image image{2, 1, {}, {}};
  add_layer(image, "", 0.5F);
  image.planes[0].values = {std::numeric_limits<float>::infinity(), -3.0F};
  image.planes[1].values = {std::numeric_limits<float>::quiet_NaN(), 7.0F};
  write_exr(file, image);
  const Panorama p = read_panorama(file);
  EXPECT_EQ(p.radiance[0], (std::array<float, 3>{65504.0F, 0.0F, 0.5F}));
  EXPECT_EQ(p.radiance[1], (std::array<float, 3>{0.0F, 7.0F, 0.5F}));

  image.planes.clear();
  add_plane(image, "", "Y", 0.25F);
  write_exr(file, image);
  EXPECT_EQ(read_panorama(file).radiance[1], (std::array<float, 3>{0.25F, 0.25F, 0.25F}));
  image.planes[0].name = "albedo.R";
  write_exr(file, image);
  EXPECT_THROW(read_panorama(file), Fault);
  fs::remove(file);
}

TEST(Panorama, RealEnvironmentsHaveTheirSizesAndLight) {
  TYNDALL_NEEDS_SHARED_FILE(folder, "assets/environments");
  const auto check = [&](const char* name, int width, int height) {
    const Panorama p = read_panorama(folder / name);
    EXPECT_EQ(p.width, width) << name;
    EXPECT_EQ(p.height, height) << name;
    double light = 0.0;
    for (const auto& c : p.radiance) {
      for (const float x : c) {
        ASSERT_TRUE(x >= 0.0F && std::isfinite(x)) << name;
        light += x;
      }
    }
    EXPECT_GT(light / static_cast<double>(p.radiance.size()), 0.1) << name;
  };
  check("gltf-transform/royal_esplanade_1k.hdr", 1024, 512);
  check("open-shading-language/kitchen_probe.hdr", 640, 640);
  check("openexr-images/KernerEnvLatLong.exr", 1024, 512);
}

/// Seeded damage: truncations and flipped bits, in turn.
std::vector<std::uint8_t> damaged(std::vector<std::uint8_t> bytes, unsigned seed) {
  std::mt19937 random(seed);
  if (seed % 2 == 0) {
    bytes.resize(random() % bytes.size());
  } else {
    // Early bytes (headers, tables) matter most, so that half of the flips go there.
    for (unsigned flips = 1 + random() % 4; flips > 0; --flips) {
      const std::size_t range = random() % 2 == 0 ? std::min<std::size_t>(bytes.size(), 400) : bytes.size();
      bytes[random() % range] ^= static_cast<std::uint8_t>(1U << random() % 8);
    }
  }
  return bytes;
}

/// A small picture in both formats, with run-length coded rows in the Radiance file.
std::vector<std::uint8_t> small_hdr() {
  const std::string head = "#?RADIANCE\nSOFTWARE=test\nFORMAT=32-bit_rle_rgbe\nEXPOSURE=1.0\n\n-Y 8 +X 16\n";
  std::vector<std::uint8_t> bytes(head.begin(), head.end());
  for (int row = 0; row < 8; ++row) {
    for (const int b : {2, 2, 0, 16}) bytes.push_back(static_cast<std::uint8_t>(b));
    for (int component = 0; component < 4; ++component) {
      for (const int b : {128 + 10, 100 + row, 6, 1, 2, 3, 4, 5, 6}) bytes.push_back(static_cast<std::uint8_t>(b));
    }
  }
  return bytes;
}

TEST(Panorama, DamagedFilesAreAnsweredWithAMessageOrAPicture) {
  const fs::path folder = fresh_file("");
  fs::create_directories(folder);
  Image image{16, 8, {}, {{"note", "text"}}};
  add_layer(image, "", 0.5F);
  for (std::size_t i = 0; i < image.pixel_count(); ++i)
    image.planes[0].values[i] = 0.1F * static_cast<float>(i * i % 37);
  write_exr(folder / "good.exr", image);
  write_whole_file(folder / "good.hdr", small_hdr());
  ASSERT_NO_THROW(read_panorama(folder / "good.hdr"));
  for (const char* name : {"good.exr", "good.hdr"}) {
    const auto good = read_whole_file(folder / name);
    int refused = 0;
    for (unsigned seed = 0; seed < 1000; ++seed) {
      write_whole_file(folder / "bad", damaged(good, seed));
      try {
        const Panorama p = read_panorama(folder / "bad");
        ASSERT_EQ(p.radiance.size(), static_cast<std::size_t>(p.width) * static_cast<std::size_t>(p.height));
        for (const auto& c : p.radiance) ASSERT_TRUE(std::isfinite(c[0]) && std::isfinite(c[1]) && std::isfinite(c[2]));
      } catch (const Fault& fault) {
        ++refused;
        EXPECT_FALSE(fault.found.empty());
        EXPECT_FALSE(fault.expected.empty());
      }
    }
    EXPECT_GT(refused, 330) << name;
    EXPECT_LT(refused, 1000) << name;
  }
  fs::remove_all(folder);
}

}  // namespace
}  // namespace tyndall
