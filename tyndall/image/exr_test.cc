#include "tyndall/image/exr.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <random>

#include "tests/shared_folder.h"
#include "tyndall/document/fault.h"
#include "tyndall/document/whole_file.h"

namespace tyndall {
namespace {

namespace fs = std::filesystem;

/// An empty folder of this test's own.
fs::path fresh_folder(const std::string& name) {
  const fs::path folder =
      fs::path(testing::TempDir()) / ("tyndall_image_" + name + std::to_string(std::random_device()()));
  fs::remove_all(folder);
  fs::create_directories(folder);
  return folder;
}

/// Every layer of the renderer's files, each value its own.
Image layered() {
  Image image{7, 5, {}, {{"tyndall.spp", "64"}, {"tyndall.scene", "street \"w\" = 0.5"}}};
  for (const char* layer : {"", "single", "surface", "multiple", "transmittance", "variance"}) add_layer(image, layer);
  add_plane(image, "depth", "Z", std::numeric_limits<float>::infinity());
  float value = 0.0F;
  for (Plane& plane : image.planes) {
    for (float& x : plane.values) x = plane.name == "depth.Z" ? x : value += 0.37F;
  }
  image.planes.back().values[3] = 12.5F;
  return image;
}

TEST(Exr, KeepsEveryLayerAndNoteExactly) {
  const fs::path file = fresh_folder("exr") / "picture.exr";
  const Image written = layered();
  write_exr(file, written);
  const Image read = read_exr(file);
  EXPECT_EQ(read.width, 7);
  EXPECT_EQ(read.height, 5);
  ASSERT_EQ(read.planes.size(), written.planes.size());
  for (const Plane& plane : written.planes) {
    const Plane* const same = find_plane(read, plane.name);
    ASSERT_NE(same, nullptr) << plane.name;
    EXPECT_EQ(same->values, plane.values) << plane.name;
  }
  for (const auto& note : written.notes) {
    EXPECT_NE(std::find(read.notes.begin(), read.notes.end(), note), read.notes.end()) << note.first;
  }
}

TEST(Exr, SamePictureGivesSameBytes) {
  const fs::path folder = fresh_folder("bytes");
  write_exr(folder / "a.exr", layered());
  write_exr(folder / "b.exr", layered());
  EXPECT_EQ(read_whole_file(folder / "a.exr"), read_whole_file(folder / "b.exr"));
}

TEST(Exr, ReadsOnlyTheChannelsAskedFor) {
  const fs::path file = fresh_folder("only") / "picture.exr";
  write_exr(file, layered());
  const std::vector<std::string_view> only{"single.G", "depth.Z", "no such channel"};
  const Image read = read_exr(file, only);
  ASSERT_EQ(read.planes.size(), 2U);
  EXPECT_NE(find_plane(read, "single.G"), nullptr);
  EXPECT_TRUE(std::isinf(find_plane(read, "depth.Z")->values[0]));
  EXPECT_EQ(find_plane(read, "depth.Z")->values[3], 12.5F);
}

TEST(Exr, RefusesPicturesThatCannotBe) {
  const fs::path file = fresh_folder("refused") / "picture.exr";
  Image wrong_size = layered();
  wrong_size.planes[2].values.pop_back();
  EXPECT_THROW(write_exr(file, wrong_size), Fault);
  Image twice = layered();
  twice.planes[1].name = twice.planes[0].name;
  EXPECT_THROW(write_exr(file, twice), Fault);
  EXPECT_THROW(write_exr(file, Image{}), Fault);
  EXPECT_FALSE(fs::exists(file));
}

TEST(Exr, FailingToWriteLeavesTheOldFileAndNothingElse) {
  const fs::path folder = fresh_folder("atomic");
  write_exr(folder / "picture.exr", layered());
  const auto before = read_whole_file(folder / "picture.exr");
  Image wrong = layered();
  wrong.planes[0].values.clear();
  EXPECT_THROW(write_exr(folder / "picture.exr", wrong), Fault);
  EXPECT_EQ(read_whole_file(folder / "picture.exr"), before);
  EXPECT_THROW(write_exr(folder / "absent" / "picture.exr", layered()), Fault);
  fs::create_directory(folder / "taken.exr");
  EXPECT_THROW(write_exr(folder / "taken.exr", layered()), Fault);
  std::size_t entries = 0;
  for ([[maybe_unused]] const auto& entry : fs::directory_iterator(folder)) ++entries;
  EXPECT_EQ(entries, 2U);
}

TEST(Exr, HugeSizesAreRefusedBeforeAnythingIsAllocated) {
  const fs::path file = fresh_folder("huge") / "picture.exr";
  write_exr(file, layered());
  std::vector<std::uint8_t> bytes = read_whole_file(file);
  const std::string name = "dataWindow";
  const auto at = std::search(bytes.begin(), bytes.end(), name.begin(), name.end()) - bytes.begin();
  // After the name and its 0 come "box2i", 0, the size 16, and four numbers: x and y of both corners.
  const auto corner = static_cast<std::size_t>(at) + name.size() + 1 + 6 + 4;
  for (const auto high : {std::uint8_t{0x7e}, std::uint8_t{0x01}}) {
    bytes[corner + 11] = high;
    bytes[corner + 15] = high;
    EXPECT_THROW(parse_exr("bytes", bytes), Fault);
  }
}

TEST(Exr, MessagesSayWhatWasFoundWhereTheFileIsNotAnExr) {
  const fs::path file = fresh_folder("text") / "picture.exr";
  std::ofstream(file) << "root:x:0:0:secret";
  try {
    read_exr(file);
    FAIL() << "no Fault";
  } catch (const Fault& fault) {
    EXPECT_NE(std::string(fault.what()).find("picture.exr"), std::string::npos);
    EXPECT_EQ(std::string(fault.what()).find("secret"), std::string::npos);
  }
  EXPECT_THROW(read_exr(file.parent_path()), Fault);
  EXPECT_THROW(read_exr(file.parent_path() / "absent.exr"), Fault);
  EXPECT_THROW(read_exr("/dev/zero"), Fault);
}

TEST(Exr, ReadsHalfFloatFilesOfOthers) {
  TYNDALL_NEEDS_SHARED_FILE(file, "assets/environments/openexr-images/KernerEnvLatLong.exr");
  const Image image = read_exr(file);
  EXPECT_EQ(image.width, 1024);
  EXPECT_EQ(image.height, 512);
  for (const Plane* plane : find_layer(image, "")) ASSERT_NE(plane, nullptr);
}

}  // namespace
}  // namespace tyndall
