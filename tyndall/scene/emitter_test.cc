#include "tyndall/scene/emitter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace tyndall {
namespace {

/// Two lamps and a wall between them: a large dim single-sided mesh of two triangles, one of them without area, and a
/// small bright double-sided one.
Scene lamps() {
  Scene scene;
  scene.materials.resize(3);
  scene.materials[0].emission = {{1, 2, 3}};
  scene.materials[2].emission = {{30, 30, 30}};
  scene.materials[2].double_sided = true;
  Mesh large;
  large.positions = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
  large.triangles = {{0, 1, 1}, {0, 1, 2}};
  large.material = 0;
  Mesh wall = large;
  wall.material = 1;
  Mesh plain = large;
  plain.material = -1;
  Mesh small;
  small.positions = {{0, 0, 5}, {1, 0, 5}, {0, 1, 5}, {1, 1, 6}};
  small.triangles = {{0, 1, 2}, {1, 3, 2}};
  small.material = 2;
  scene.meshes = {large, wall, plain, small};
  return scene;
}

TEST(Emitters, AreFoundWithTheirPower) {
  const Scene scene = lamps();
  const Emitters emitters(scene);
  ASSERT_EQ(emitters.triangles().size(), 3U);
  EXPECT_EQ(emitters.triangles()[0].area, 8.0);
  EXPECT_EQ(emitters.triangles()[0].normal, (Vector{0, 0, 1}));
  EXPECT_EQ(emitters.triangles()[2].mesh, 3U);
  EXPECT_EQ(emitters.triangles()[2].triangle, 1U);
  const double small = 0.5 + emitters.triangles()[2].area;
  EXPECT_NEAR(emitters.power()[0], std::numbers::pi * (8 * 1 + 2 * 30 * small), 1e-9);
  EXPECT_NEAR(emitters.power()[2], std::numbers::pi * (8 * 3 + 2 * 30 * small), 1e-9);
  const Scene dark;
  EXPECT_TRUE(Emitters(dark).empty());
}

TEST(Emitters, DensitiesIntegrateToOneAndZeroElsewhere) {
  const Scene scene = lamps();
  const Emitters emitters(scene);
  double total = 0.0;
  for (const EmissiveTriangle& t : emitters.triangles()) total += emitters.density(t.mesh, t.triangle) * t.area;
  EXPECT_NEAR(total, 1.0, 1e-14);
  EXPECT_EQ(emitters.density(0, 0), 0.0) << "no area";
  EXPECT_EQ(emitters.density(1, 1), 0.0) << "no emission";
  EXPECT_EQ(emitters.density(2, 1), 0.0) << "no material";
  // Power: 8 m^2 of mean radiance 2 on one side against 0.5 m^2 of 30 on two sides.
  EXPECT_NEAR(emitters.density(3, 0) / emitters.density(0, 1), 2 * 30 / 2.0, 1e-12);
}

TEST(Emitters, SamplesFollowTheDensityUniformlyOverTriangles) {
  const Scene scene = lamps();
  const Emitters emitters(scene);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform;
  constexpr int samples = 300000;
  std::array<double, 3> counts{};
  std::array<Vector, 3> sums{};
  for (int i = 0; i < samples; ++i) {
    const EmitterSample s = emitters.sample(uniform(random), uniform(random), uniform(random));
    const auto index = static_cast<std::size_t>(s.emitter - emitters.triangles().data());
    ASSERT_LT(index, 3U);
    EXPECT_EQ(s.density, emitters.density(s.emitter->mesh, s.emitter->triangle));
    EXPECT_NEAR(dot(s.point - s.emitter->a, s.emitter->normal), 0.0, 1e-12);
    ++counts[index];
    sums[index] += s.point;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const EmissiveTriangle& t = emitters.triangles()[i];
    const double expected = emitters.density(t.mesh, t.triangle) * t.area * samples;
    // False alarms: 5 standard deviations, 12 comparisons: 7e-6.
    EXPECT_NEAR(counts[i], expected, 5.0 * std::sqrt(expected));
    const Vector centroid = t.a + (t.ab + t.ac) / 3.0, found = sums[i] / counts[i];
    const double spread = 5.0 * std::max(length(t.ab), length(t.ac)) / std::sqrt(18.0 * counts[i]);
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(found[axis], centroid[axis], spread);
  }
}

TEST(Emitters, SidesShineAsTheirMaterialSays) {
  const Scene scene = lamps();
  const Emitters emitters(scene);
  EmitterSample s = emitters.sample(0.0, 0.5, 0.5);
  EXPECT_EQ(s.emitter->mesh, 0U);
  EXPECT_EQ(s.radiance_toward({0.1, 0, 0.2}), (Spectrum{{1, 2, 3}}));
  EXPECT_EQ(s.radiance_toward({0.1, 0, -0.2}), Spectrum{});
  s = emitters.sample(0.999999, 0.5, 0.5);
  EXPECT_EQ(s.emitter->mesh, 3U);
  EXPECT_EQ(s.radiance_toward({0, 0, -1}), Spectrum::grey(30));
  EXPECT_EQ(emitted(scene, scene.materials[0], {0, 1}, true), (Spectrum{{1, 2, 3}}));
  EXPECT_EQ(emitted(scene, scene.materials[0], {0, 1}, false), Spectrum{});
  EXPECT_EQ(emitted(scene, scene.materials[2], {3, 0}, false), Spectrum::grey(30));
}

/// A picture of one bright texel among dark ones on the large triangle.
TEST(Emitters, MapsShineWhereTheyAreBright) {
  Scene scene = lamps();
  scene.textures.push_back({8, 8, std::vector<std::array<float, 3>>(64), Wrap::clamp, Wrap::clamp, {}});
  scene.textures[0].color[2 * 8 + 2] = {1.0F, 0.5F, 0.0F};
  scene.materials[0].emission_map = {0, 0};
  scene.meshes[0].uvs = {{{0, 0}, {1, 0}, {0, 1}}};
  const Emitters emitters(scene);
  const EmissiveTriangle& large = emitters.triangles()[0];
  // A tent whose peak lies at (2.5, 2.5) / 8 and which ends a texel from there: all of it in the triangle, and its mean
  // is 1/64 of the square's, 1/32 of the triangle's.
  EXPECT_NEAR(large.radiance[0], 1.0 / 32.0, 0.005);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform;
  Spectrum sum;
  constexpr int samples = 200000;
  const double chance = emitters.density(0, 1) * large.area;
  for (int i = 0; i < samples; ++i) {
    const EmitterSample s = emitters.sample(uniform(random) * chance, uniform(random), uniform(random));
    ASSERT_EQ(s.emitter->mesh, 0U);
    sum += s.radiance_toward({0, 0, 1});
  }
  EXPECT_NEAR(sum[0] / samples, 1.0 / 32.0, 0.002);  // standard error 3e-4
  EXPECT_NEAR(sum[1] / samples, 2.0 * 0.5 / 32.0, 0.002);
  EXPECT_EQ(sum[2], 0.0);
}

}  // namespace
}  // namespace tyndall
