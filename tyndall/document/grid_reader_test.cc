// Grids from OpenVDB files: what is read, what is refused and how, and files that lie.
#include "tyndall/document/grid_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Interpolation.h>
#include <openvdb/tools/LevelSetSphere.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <random>

#include "tyndall/document/fault.h"
#include "tyndall/document/folder_test.h"
#include "tyndall/document/medium_file.h"
#include "tyndall/document/whole_file.h"
#include "tyndall/medium/lowered_medium.h"

namespace tyndall {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

class GridReader : public testing::Test {
 protected:
  GridReader() { openvdb::initialize(); }

  fs::path write(const openvdb::GridPtrVec& grids, const std::string& name = "cloud.vdb") const {
    openvdb::io::File file((folder.path / name).string());
    file.write(grids);
    return folder.path / name;
  }
  fs::path write_text(const std::string& name, const std::string& text) const { return folder.write(name, text); }

  tests::Folder folder;
};

/// A ball of fog around voxel (3, -5, 20), thickest in its middle.
template <class Grid>
typename Grid::Ptr ball(const std::string& name = "density") {
  const auto grid = Grid::create(0);
  auto accessor = grid->getAccessor();
  for (int k = -11; k <= 11; ++k) {
    for (int j = -11; j <= 11; ++j) {
      for (int i = -11; i <= 11; ++i) {
        const double r = std::sqrt(static_cast<double>(i * i + j * j + k * k));
        if (r < 11.0) accessor.setValue({3 + i, -5 + j, 20 + k}, static_cast<typename Grid::ValueType>(2.5 - r / 5.0));
      }
    }
  }
  grid->setName(name);
  grid->setGridClass(openvdb::GRID_FOG_VOLUME);
  grid->setTransform(openvdb::math::Transform::createLinearTransform(0.5));
  grid->transform().postTranslate({10.0, 0.0, 0.0});
  return grid;
}

void expect_ball(const GridFile& file) {
  ASSERT_TRUE(file.grid);
  GridProfile profile;
  profile.file = file;
  for (int i = -13; i <= 13; ++i) {
    for (int j = -13; j <= 13; j += 3) {
      const double r = std::sqrt(static_cast<double>(i * i + j * j));
      const Vector p{10.0 + 0.5 * (3 + i), 0.5 * (-5 + j), 0.5 * 20};
      const double wanted = r < 11.0 ? 2.5 - r / 5.0 : 0.0;
      ASSERT_NEAR(factor(profile, p), wanted, wanted / 1024.0);
    }
  }
}

std::string fault_of(const fs::path& file, const std::string& name = "") {
  return tests::fault_of([&] { read_grid(file, name); });
}

TEST_F(GridReader, ReadsFloatHalfAndDoubleWhereTheTransformPutsThem) {
  expect_ball(read_grid(write({ball<openvdb::FloatGrid>()}), "density"));
  expect_ball(read_grid(write({ball<openvdb::DoubleGrid>()}), "density"));
  const auto half = ball<openvdb::FloatGrid>();
  half->setSaveFloatAsHalf(true);
  expect_ball(read_grid(write({half}), ""));
}

/// OpenVDB's own trilinear sampler says the same everywhere, in a space that is turned, sheared and stretched, put
/// somewhere else by size and position.
TEST_F(GridReader, IsWhatOpenvdbsOwnSamplerSays) {
  const auto grid = ball<openvdb::FloatGrid>();
  openvdb::Mat4d bent(0.5, 0.1, 0.0, 0.0, -0.2, 0.7, 0.1, 0.0, 0.0, 0.3, -0.4, 0.0, 3.0, -2.0, 1.0, 1.0);
  grid->setTransform(openvdb::math::Transform::createLinearTransform(bent));
  std::mt19937_64 random(8);
  for (int i = 0; i < 2000; ++i) {
    const auto coordinate = [&] { return static_cast<int>(random() % 24) - 12; };
    grid->tree().setValue({3 + coordinate(), -5 + coordinate(), 20 + coordinate()},
                          static_cast<float>(random() % 1000) * 0.0025F);
  }
  GridProfile profile;
  profile.file = read_grid(write({grid}), "density");
  profile.scale = 0.5;
  profile.size = 4.0;
  profile.position = {100.0, 0.0, -7.0};
  const openvdb::tools::GridSampler<openvdb::FloatGrid, openvdb::tools::BoxSampler> sampler(*grid);
  int met = 0;
  for (int i = 0; i < 100000; ++i) {
    const auto coordinate = [&] { return 30.0 * (static_cast<double>(random() >> 11) * 0x1p-53 - 0.5); };
    const openvdb::Vec3d there =
        grid->indexToWorld(openvdb::Vec3d(3 + coordinate(), -5 + coordinate(), 20 + coordinate()));
    const double wanted = 0.5 * static_cast<double>(sampler.wsSample(there));
    const Vector p = profile.position + Vector{there.x(), there.y(), there.z()} * profile.size;
    ASSERT_NEAR(factor(profile, p), wanted, 1e-6 + wanted / 1000.0);  // kept with 11 bits
    met += wanted > 0.0 ? 1 : 0;
  }
  EXPECT_GT(met, 10000);
}

TEST_F(GridReader, FindsGridsByName) {
  const auto other = openvdb::FloatGrid::create(0);
  other->setName("heat");
  other->tree().setValue({0, 0, 0}, 7.0F);
  const fs::path file = write({other, ball<openvdb::FloatGrid>()});
  expect_ball(read_grid(file, "density"));
  EXPECT_NE(read_grid(file, "density").content, read_grid(file, "heat").content);
  EXPECT_EQ(read_grid(file, "density"), read_grid(file, "density"));
  EXPECT_THAT(fault_of(file, "densty"), AllOf(HasSubstr("no grid \"densty\""), HasSubstr("density")));
  EXPECT_THAT(fault_of(file), AllOf(HasSubstr("several grids"), HasSubstr("heat"), HasSubstr("density")));
}

TEST_F(GridReader, RefusesWhatIsNoDensity) {
  const auto one_voxel = [](double x, double background) {
    const auto grid = openvdb::FloatGrid::create(static_cast<float>(background));
    grid->tree().setValue({1, 2, 3}, static_cast<float>(x));
    return grid;
  };
  EXPECT_THAT(fault_of(write({one_voxel(-1e-6, 0.0)})), HasSubstr("below 0"));
  EXPECT_THAT(fault_of(write({one_voxel(std::nan(""), 0.0)})), HasSubstr("not finite"));
  EXPECT_THAT(fault_of(write({one_voxel(std::numeric_limits<double>::infinity(), 0.0)})), HasSubstr("not finite"));
  EXPECT_THAT(fault_of(write({one_voxel(1.0, 0.5)})), HasSubstr("background"));
  EXPECT_THAT(fault_of(write({openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(5.0F, {0, 0, 0}, 1.0F)})),
              HasSubstr("level set"));
  const auto wind = openvdb::Vec3SGrid::create();
  wind->setName("v");
  EXPECT_THAT(fault_of(write({wind})), HasSubstr("another kind"));
  const auto bent = one_voxel(1.0, 0.0);
  bent->setTransform(openvdb::math::Transform::createFrustumTransform(
      openvdb::BBoxd(openvdb::Vec3d(0, 0, 0), openvdb::Vec3d(10, 10, 10)), 0.5, 1.0, 1.0));
  EXPECT_THAT(fault_of(write({bent})), HasSubstr("transform"));
  EXPECT_THAT(fault_of(folder.path / "absent.vdb"), HasSubstr("absent.vdb"));
  EXPECT_THAT(fault_of(write_text("a.vdb", "no grid at all")), HasSubstr("OpenVDB cannot read"));
  EXPECT_THAT(fault_of(write({})), HasSubstr("no grids"));
}

TEST_F(GridReader, RefusesTooManyVoxelsBeforeItMakesThem) {
  const auto large = openvdb::FloatGrid::create(0);
  large->fill({{0, 0, 0}, {4095, 4095, 4095}}, 1.0F);  // 64 tiles
  EXPECT_THAT(fault_of(write({large})), HasSubstr("too large"));
  const auto far = openvdb::FloatGrid::create(0);
  far->tree().setValue({0, 0, 0}, 1.0F);
  far->tree().setValue({2000000000, 0, 0}, 1.0F);
  EXPECT_THAT(fault_of(write({far})), HasSubstr("too large"));
}

TEST_F(GridReader, TheLargestGridOfTilesIsRead) {
  const auto large = openvdb::FloatGrid::create(0);
  large->fill({{0, 0, 0}, {511, 511, 511}}, 1.0F);
  const GridFile file = read_grid(write({large}), "");
  EXPECT_EQ(file.grid->blocks(), 64U * 64U * 64U);
  EXPECT_EQ(file.grid->at({300.5, 200.25, 100.0}), 1.0);
  EXPECT_LT(bytes_of(*file.grid), std::uint64_t{280} << 20);
}

TEST_F(GridReader, AnEmptyGridIsNothing) {
  const GridFile file = read_grid(write({openvdb::FloatGrid::create(0)}), "");
  EXPECT_TRUE(file.grid->nothing());
}

TEST_F(GridReader, TilesAreAsGoodAsVoxels) {
  const auto tiles = openvdb::FloatGrid::create(0), voxels = openvdb::FloatGrid::create(0);
  tiles->fill({{8, 8, 8}, {23, 15, 15}}, 0.5F);
  for (int i = 0; i < 1024; ++i) voxels->tree().setValue({8 + i % 16, 8 + i / 16 % 8, 8 + i / 128}, 0.5F);
  EXPECT_EQ(read_grid(write({tiles}, "a.vdb"), ""), read_grid(write({voxels}, "b.vdb"), ""));
}

constexpr const char* medium_start = R"({"format": "tyndall-medium/1", "meters_per_unit": 100, "species": [)";

TEST_F(GridReader, MediaNameGridsAndShareThem) {
  write({ball<openvdb::FloatGrid>(), ball<openvdb::FloatGrid>("heat")});
  const std::string profile = R"("profile": {"law": "grid", "file": "cloud.vdb", "name": "density", "scale": 2})";
  const fs::path file =
      write_text("m.medium.json", medium_start + (R"({"name": "a", "density": 1, )" + profile +
                                                  R"(}, {"name": "b", "density": 2, )" + profile + "}]}"));
  const Medium medium = compile(read_medium_file(file), "m");
  ASSERT_EQ(medium.species.size(), 2U);
  const auto& a = std::get<GridProfile>(medium.species[0].profiles.at(0));
  EXPECT_EQ(a.file.grid, std::get<GridProfile>(medium.species[1].profiles.at(0)).file.grid);
  // A grid's own unit is the file's: the middle is where it says times 100.
  EXPECT_NEAR(factor(a, Vector{11.5, -2.5, 10.0} * 100.0), 5.0, 0.01);
  EXPECT_EQ(lower(medium).species[1].place, 0U);
}

TEST_F(GridReader, WrittenMediaFindTheirGridAgain) {
  write({ball<openvdb::FloatGrid>()});
  const fs::path file = write_text(
      "m.medium.json",
      medium_start + std::string(R"({"name": "a", "density": 1, "profile": {"law": "grid", "file": "cloud.vdb"}}]})"));
  const MediumFile medium = read_medium_file(file);
  write_medium_file(folder.path / "again.medium.json", medium);
  EXPECT_EQ(compile(read_medium_file(folder.path / "again.medium.json"), "").species[0].profiles,
            compile(medium, "").species[0].profiles);
}

TEST_F(GridReader, FaultsOfMediaSayWhereTheFileWasNamed) {
  write({ball<openvdb::FloatGrid>()});
  const auto fault = [&](const std::string& profile) {
    const fs::path file = write_text(
        "m.medium.json", std::string(medium_start) + R"({"name": "a", "density": 1, "profile": )" + profile + "}]}");
    return tests::fault_of([&] { read_medium_file(file); });
  };
  EXPECT_THAT(fault(R"({"law": "grid"})"), HasSubstr("no key \"file\""));
  EXPECT_THAT(fault(R"({"law": "grid", "file": "clod.vdb"})"), HasSubstr("/species/0/profile/file"));
  EXPECT_THAT(fault(R"({"law": "grid", "file": "../cloud.vdb"})"), HasSubstr("/species/0/profile/file"));
  EXPECT_THAT(fault(R"({"law": "grid", "file": "cloud.vdb", "name": "fog"})"), HasSubstr("density"));
  EXPECT_THAT(fault(R"({"law": "grid", "file": "cloud.vdb", "scale": -1})"), HasSubstr("at least 0"));
  EXPECT_THAT(tests::fault_of([&] {
                medium_from_json(
                    std::string(medium_start) + R"({"density": 1, "profile": {"law": "grid", "file": "cloud.vdb"}}]})",
                    "m");
              }),
              HasSubstr("no folder"));
}

/// Whatever became of the bytes: a grid, or a Fault that names the file.
TEST_F(GridReader, AThousandBrokenFilesAreAnswered) {
  const auto grid = ball<openvdb::FloatGrid>();
  grid->setSaveFloatAsHalf(true);
  const std::vector<std::uint8_t> sound = read_whole_file(write({grid}), 1U << 24);
  std::mt19937 random(4);
  const auto below = [&](std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(random); };
  int faults = 0, cut = 0;
  for (int i = 0; i < 1000; ++i) {
    std::string bytes(sound.begin(), sound.end());
    if (i % 4 == 0) {
      bytes.resize(below(bytes.size()));
    } else {
      // Half of the flips where the file says how it is made.
      for (int n = 0; n <= i % 3; ++n) {
        char& byte = bytes[below(i % 2 == 0 ? bytes.size() : std::min<std::size_t>(2000, bytes.size()))];
        byte = static_cast<char>(byte ^ (1 << below(8)));
      }
    }
    const std::string fault = fault_of(write_text("broken.vdb", bytes));
    if (fault == "no fault") continue;
    ++faults;
    cut += i % 4 == 0 ? 1 : 0;
    ASSERT_THAT(fault, HasSubstr("broken.vdb"));
  }
  EXPECT_GT(faults, 300);
  EXPECT_GT(cut, 240);
}

TEST_F(GridReader, NothingIsBelievedOfWhatTheChildSends) {
  const std::string good = grid_bytes(*read_grid(write({ball<openvdb::FloatGrid>()}), "").grid);
  grid_of_bytes(good, "x");
  std::mt19937 random(5);
  for (int i = 0; i < 1000; ++i) {
    std::string bytes = good;
    if (i % 4 == 0) bytes.resize(random() % bytes.size());
    if (i % 4 != 0) bytes[random() % (i % 2 == 0 ? bytes.size() : 140)] ^= static_cast<char>(1 << random() % 8);
    try {
      const BrickGrid grid = grid_of_bytes(bytes, "x");
      ASSERT_TRUE(std::isfinite(grid.at(Vector{10, 10, 10})));
    } catch (const Fault&) {
    }
  }
}

TEST(GridSequence, NamesAreNumbered) {
  EXPECT_FALSE(is_sequence("smoke.vdb"));
  EXPECT_FALSE(is_sequence("take#2/smoke.vdb")) << "a folder's name is its own";
  EXPECT_TRUE(is_sequence("caches/smoke.####.vdb"));
  EXPECT_EQ(numbered_file("smoke.####.vdb", 7), "smoke.0007.vdb");
  EXPECT_EQ(numbered_file("smoke.####.vdb", 123456), "smoke.123456.vdb");
  EXPECT_EQ(numbered_file("a##/smoke#", 3), "a##/smoke3");
  GridProfile profile;
  profile.first_frame = 1;
  profile.fps = 24.0;
  for (int n = 0; n < 2000; ++n) EXPECT_EQ(frame_of(profile, n / 24.0), n + 1);
  EXPECT_EQ(frame_of(profile, 0.45 / 24.0), 1);
  EXPECT_EQ(frame_of(profile, 0.55 / 24.0), 2);
  EXPECT_NE(tests::fault_of([&] { frame_of(profile, -1.0); }), "");
  EXPECT_NE(tests::fault_of([&] { frame_of(profile, 1e300); }), "");
}

/// A cube of one number a frame, as the files 4, 5 and 7.
TEST_F(GridReader, SequencesShowTheFileOfTheirTime) {
  for (const int frame : {4, 5, 7}) {
    const auto grid = openvdb::FloatGrid::create(0);
    for (int i = 0; i < 27; ++i) grid->getAccessor().setValue({i % 3, i / 3 % 3, i / 9}, static_cast<float>(frame));
    grid->setName("density");
    write({grid}, "smoke." + std::to_string(frame) + ".vdb");
  }
  const fs::path file = write_text("smoke.medium.json", R"({"format": "tyndall-medium/1", "species": [{"name": "smoke",
    "density": {"extinction": 1}, "phase": {"law": "isotropic"},
    "profile": {"law": "grid", "file": "smoke.#.vdb", "first_frame": 4, "fps": 10}}]})");
  MediumFile medium = read_medium_file(file);
  const auto density = [&] { return factor(compile(medium).species[0], {1, 1, 1}); };
  EXPECT_EQ(density(), 4.0);
  set_grid_time(medium, 0.1);
  EXPECT_EQ(density(), 5.0);
  EXPECT_NE(tests::fault_of([&] { set_grid_time(medium, 0.2); }).find("smoke.6.vdb"), std::string::npos);
  EXPECT_NE(tests::fault_of([&] { set_grid_time(medium, 0.2, Grids::found); }).find("smoke.6.vdb"), std::string::npos);
  EXPECT_EQ(density(), 5.0) << "what was there stays";
  set_grid_time(medium, 0.3, Grids::found);
  EXPECT_EQ(density(), 5.0) << "only looked for";
  set_grid_time(medium, 0.3);
  EXPECT_EQ(density(), 7.0);
  // Written anywhere below, it names the same files.
  fs::create_directory(folder.path / "below");
  write_medium_file(folder.path / "copy.medium.json", medium);
  MediumFile copy = read_medium_file(folder.path / "copy.medium.json");
  set_grid_time(copy, 0.1);
  medium = copy;
  EXPECT_EQ(density(), 5.0);
}

TEST_F(GridReader, SequencesStayInTheirFolderAtEveryTime) {
  write({ball<openvdb::FloatGrid>()}, "smoke.0.vdb");
  const tests::Folder elsewhere;
  fs::copy_file(folder.path / "smoke.0.vdb", elsewhere.path / "foreign.vdb");
  fs::create_symlink(elsewhere.path / "foreign.vdb", folder.path / "smoke.1.vdb");
  const fs::path file = write_text("smoke.medium.json", R"({"format": "tyndall-medium/1", "species": [{"name": "smoke",
    "density": {"extinction": 1}, "phase": {"law": "isotropic"},
    "profile": {"law": "grid", "file": "smoke.#.vdb", "fps": 1}}]})");
  MediumFile medium = read_medium_file(file);
  EXPECT_NE(tests::fault_of([&] { set_grid_time(medium, 1.0); }).find("--allow-path"), std::string::npos);
  medium = read_medium_file(file, true);
  set_grid_time(medium, 1.0);
  EXPECT_NE(tests::fault_of([&] {
              read_medium_file(write_text("absent.medium.json",
                                          R"({"format": "tyndall-medium/1", "species": [{"name": "smoke",
    "density": {"extinction": 1}, "phase": {"law": "isotropic"},
    "profile": {"law": "grid", "file": "smoke.#.vdb", "first_frame": 9}}]})"));
            }).find("absent.medium.json:3"),
            std::string::npos);
}

}  // namespace
}  // namespace tyndall
