// Work that is stopped and gone on with: the same picture as without a break, and nothing but the same picture.
#include "tyndall/render/checkpoint.h"

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>

#include "tyndall/document/fault.h"
#include "tyndall/document/whole_file.h"
#include "tyndall/render/test_scenes.h"
#include "tyndall/sampling/random_stream.h"
#include "tyndall/scene/fingerprint.h"

namespace tyndall {
namespace {

class Checkpoint : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (std::filesystem::temp_directory_path() / "tyndall-test-XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
    file_ = folder_ / "film.checkpoint";
    scene_.film = {24, 16};
    settings_.spp = 12;
    settings_.threads = 2;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  /// The fault that reading gives; empty where there is none.
  std::string fault(const CheckpointSubject& subject) const {
    try {
      read_checkpoint(file_, subject);
    } catch (const Fault& f) {
      return f.what();
    }
    return "";
  }
  std::string fault() const { return fault(subject_of(scene_, settings_)); }
  SampleFilm empty() const { return SampleFilm(scene_.film.width, scene_.film.height); }

  std::filesystem::path folder_, file_;
  Scene scene_ = tests::busy_scene();
  RenderSettings settings_;
};

void expect_same_bits(const SampleFilm& a, const SampleFilm& b) {
  const Image x = a.develop(), y = b.develop();
  ASSERT_EQ(x.planes.size(), y.planes.size());
  for (std::size_t i = 0; i < x.planes.size(); ++i)
    EXPECT_EQ(0, std::memcmp(x.planes[i].values.data(), y.planes[i].values.data(), x.pixel_count() * sizeof(float)))
        << x.planes[i].name;
}

TEST_F(Checkpoint, StoppedAnywhereAndGoneOnWithIsTheSamePicture) {
  for (const char* integrator : {"path", "single"}) {
    settings_.integrator = integrator;
    const bool single = integrator == std::string("single");
    if (single) scene_.film = {6, 4};
    const Geometry its_geometry(scene_);
    SampleFilm at_once = empty();
    EXPECT_TRUE(render(scene_, its_geometry, settings_, at_once, {}));
    const CheckpointSubject subject = subject_of(scene_, settings_);
    RandomStream random(7, 0, 0);
    for (int run = 0; run < (single ? 1 : 4); ++run) {
      write_checkpoint(file_, subject, empty());
      int pieces = 0;
      for (bool ended = false; !ended; ++pieces) {
        SampleFilm film = read_checkpoint(file_, subject);
        std::atomic<bool> stop{false};
        int left = static_cast<int>(random.next() * (single ? 6.0 : 60.0));
        RenderHooks hooks;
        hooks.wants_film = [&] {
          stop = --left < 0;
          return left % 5 == 0;
        };
        hooks.save = [](const SampleFilm&) {};
        hooks.stop = &stop;
        settings_.threads = 1 + run;
        settings_.tile_order = static_cast<std::uint32_t>(pieces);
        ended = render(scene_, its_geometry, settings_, film, hooks);
        write_checkpoint(file_, subject, film);
        ASSERT_LT(pieces, 10000);
      }
      EXPECT_GT(pieces, 1);
      expect_same_bits(read_checkpoint(file_, subject), at_once);
    }
  }
}

TEST_F(Checkpoint, AFinishedPictureIsRefinedToWhatMoreSamplesGive) {
  const Geometry geometry(scene_);
  SampleFilm film = empty(), at_once = empty();
  settings_.spp = 5;
  render(scene_, geometry, settings_, film, {});
  settings_.spp = 13;
  EXPECT_TRUE(render(scene_, geometry, settings_, film, {}));
  render(scene_, geometry, settings_, at_once, {});
  expect_same_bits(film, at_once);
  EXPECT_EQ(film.samples_taken(), (std::pair<std::uint32_t, std::uint32_t>(13, 13)));
}

TEST_F(Checkpoint, SavingWhileRenderingSeesOnlyWholeSamples) {
  const Geometry geometry(scene_);
  SampleFilm film = empty();
  settings_.threads = 3;
  settings_.spp = 40;
  RenderHooks hooks;
  int seen = 0;
  hooks.wants_film = [] { return true; };
  hooks.save = [&](const SampleFilm& now) {
    ++seen;
    write_checkpoint(file_, subject_of(scene_, settings_), now);
    expect_same_bits(read_checkpoint(file_, subject_of(scene_, settings_)), now);
  };
  std::atomic<bool> stop{false};
  hooks.report = [&](const RenderProgress& p) { stop = p.spp >= 20; };
  hooks.stop = &stop;
  render(scene_, geometry, settings_, film, hooks);
  EXPECT_GT(seen, 3);
}

TEST_F(Checkpoint, EndsAtTheNoiseAskedForWithTheSameSamplesEveryTime) {
  const Geometry geometry(scene_);
  settings_.spp = 1 << 20;
  settings_.until_noise = 0.2;
  SampleFilm first = empty();
  EXPECT_TRUE(render(scene_, geometry, settings_, first, {}));
  EXPECT_LE(first.noise(), 0.2);
  const auto [least, most] = first.samples_taken();
  EXPECT_EQ(least, most);
  settings_.threads = 3;
  SampleFilm second = empty();
  RenderHooks hooks;
  int asked = 0;
  hooks.wants_film = [&] { return ++asked % 70 == 0; };
  hooks.save = [](const SampleFilm&) {};
  EXPECT_TRUE(render(scene_, geometry, settings_, second, hooks));
  expect_same_bits(first, second);
}

TEST_F(Checkpoint, EndsInTheTimeAskedFor) {
  const Geometry geometry(scene_);
  settings_.spp = 1 << 20;
  settings_.seconds = 0.3;
  SampleFilm film = empty();
  EXPECT_TRUE(render(scene_, geometry, settings_, film, {}));
  EXPECT_LT(film.samples_taken().second, 1u << 20);
  EXPECT_GT(film.samples_taken().second, 0u);
}

TEST_F(Checkpoint, RefusesSamplesOfAnythingElseAndSaysOfWhat) {
  write_checkpoint(file_, subject_of(scene_, settings_), empty());
  EXPECT_EQ(fault(), "");
  settings_.spp = 99;  // of path: any number may follow
  EXPECT_EQ(fault(), "");
  RenderSettings other = settings_;
  other.seed = 3;
  EXPECT_NE(fault(subject_of(scene_, other)).find("seed is \"1\" where this is \"3\""), std::string::npos);
  other = settings_;
  other.max_depth = 3;
  EXPECT_NE(fault(subject_of(scene_, other)).find("max_depth"), std::string::npos);
  other = settings_;
  other.integrator = "single";
  EXPECT_NE(fault(subject_of(scene_, other)).find("integrator"), std::string::npos);
  Scene moved = scene_;
  moved.camera.position.x += 1e-9;
  EXPECT_NE(fault(subject_of(moved, settings_)).find("scene"), std::string::npos);
  std::filesystem::remove(file_);
  EXPECT_NE(fault(), "");
}

TEST_F(Checkpoint, AnswersDamageWithAMessage) {
  const Geometry geometry(scene_);
  settings_.spp = 1;
  SampleFilm film = empty();
  render(scene_, geometry, settings_, film, {});
  write_checkpoint(file_, subject_of(scene_, settings_), film);
  const std::vector<std::uint8_t> good = read_whole_file(file_);
  RandomStream random(5, 0, 0);
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random.next() * static_cast<double>(n)); };
  const auto keep = [&](const std::vector<std::uint8_t>& bytes) {
    std::ofstream(file_, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  };
  for (int i = 0; i < 1000; ++i) {
    std::vector<std::uint8_t> bad = good;
    // Half of all flips in the first line, where they have the most to break.
    bad[i % 2 == 0 ? below(250) : below(bad.size())] ^= static_cast<std::uint8_t>(1u << below(8));
    keep(bad);
    EXPECT_NE(fault(), "") << i;
  }
  for (int i = 0; i < 1000; ++i) {
    std::vector<std::uint8_t> bad = good;
    bad.resize(i < 300 ? static_cast<std::size_t>(i) : below(good.size()));
    keep(bad);
    EXPECT_NE(fault(), "") << bad.size();
  }
  std::vector<std::uint8_t> longer = good;
  longer.push_back(0);
  keep(longer);
  EXPECT_NE(fault(), "");
}

TEST(Fingerprint, ChangesWithEverythingThatAPictureDependsOn) {
  const Scene scene = tests::busy_scene();
  const std::uint64_t before = fingerprint(scene);
  EXPECT_EQ(fingerprint(tests::busy_scene()), before);
  const std::vector<void (*)(Scene&)> changes = {
      [](Scene& s) { s.meshes[0].positions[2][1] += 1e-6f; },
      [](Scene& s) { s.meshes[1].triangles[0][0] = 3; },
      [](Scene& s) { s.meshes.pop_back(); },
      [](Scene& s) {
        s.meshes[0].normals.assign(4, {0, 1, 0});
      },
      [](Scene& s) { s.meshes[0].material = -1; },
      [](Scene& s) { s.materials[0].roughness = 0.9; },
      [](Scene& s) { s.materials[2].emission[1] = 3.5; },
      [](Scene& s) { s.materials[2].double_sided = true; },
      [](Scene& s) { s.materials[0].alpha_mode = AlphaMode::blend; },
      [](Scene& s) { s.materials[0].alpha = 0.5; },
      [](Scene& s) { s.materials[0].alpha_cutoff = 0.25; },
      [](Scene& s) { s.materials[0].ior = 1.6; },
      [](Scene& s) { s.materials[0].normal_scale = 0.5; },
      [](Scene& s) { s.materials[0].normal_map.texture = 0; },
      [](Scene& s) { s.materials[0].emission_map.uv_set = 1; },
      [](Scene& s) { s.meshes[0].uvs.push_back({}); },
      [](Scene& s) {
        s.meshes[0].tangents.assign(4, {1, 0, 0, 1});
      },
      [](Scene& s) {
        s.textures.push_back({1, 1, {{0.5f, 0.5f, 0.5f}}, Wrap::repeat, Wrap::repeat, {}});
      },
      [](Scene& s) { s.points[0].intensity[2] = 1.5; },
      [](Scene& s) { s.spots[0].outer_angle = 26; },
      [](Scene& s) { s.suns.clear(); },
      [](Scene& s) { s.environment->scale[0] = 2.0; },
      [](Scene& s) { s.environment.reset(); },
      [](Scene& s) {
        s.environment->panorama = std::make_shared<Panorama>(Panorama{1, 1, {{1.f, 1.f, 1.f}}});
      },
      [](Scene& s) { s.medium.species[0].scattering[0] *= 1.0 + 1e-15; },
      [](Scene& s) { s.medium.species[1].phase = HenyeyGreenstein<double>{0.79}; },
      [](Scene& s) {
        s.medium.species[1].phase = Draine<double>{0.8, 0.0};
      },
      [](Scene& s) { std::get<BoxProfile>(s.medium.species[1].profiles[0]).feather = 0.1; },
      [](Scene& s) { s.medium.species[2].profiles.clear(); },
      [](Scene& s) { std::swap(s.medium.species[0], s.medium.species[1]); },
      [](Scene& s) { s.camera.vertical_fov = 46; },
      [](Scene& s) { s.film.height = 33; },
      [](Scene& s) { s.time = 1.0; }};
  std::vector<std::uint64_t> seen{before};
  for (std::size_t i = 0; i < changes.size(); ++i) {
    Scene changed = scene;
    changes[i](changed);
    const std::uint64_t now = fingerprint(changed);
    for (const std::uint64_t other : seen) EXPECT_NE(now, other) << "change " << i;
    seen.push_back(now);
  }
}

}  // namespace
}  // namespace tyndall
