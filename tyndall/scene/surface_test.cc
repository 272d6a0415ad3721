#include "tyndall/scene/surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tyndall/scene/geometry.h"

namespace tyndall {
namespace {

/// A square of side 2 `half` around a point, front toward +Z, textured all over; of the scene's first material.
Mesh square(const Vector& center, double half) {
  Mesh mesh;
  for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
    mesh.positions.push_back({static_cast<float>(center.x + x * half), static_cast<float>(center.y + y * half),
                              static_cast<float>(center.z)});
  }
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.uvs = {{{0, 1}, {1, 1}, {1, 0}, {0, 0}}};  // v points down, as in glTF
  mesh.material = 0;
  return mesh;
}

/// That square at the origin with half 1, and a texture of one colour.
Scene textured(std::array<float, 3> color) {
  Scene scene;
  scene.textures.push_back({1, 1, {color}, Wrap::clamp, Wrap::clamp, {}});
  scene.materials.push_back({});
  scene.meshes.push_back(square({0, 0, 0}, 1));
  return scene;
}

TEST(Surface, BaseColorsAreInterpolatedAndWrapped) {
  Scene scene;
  scene.textures.push_back({2, 2, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}}, Wrap::repeat, Wrap::repeat, {}});
  scene.materials.push_back({});
  scene.materials[0].base_color = {{0.5, 1, 1}};
  scene.materials[0].color_map = {0, 0};
  Mesh mesh = square({0, 0, 0}, 1);
  mesh.uvs = {{{0, 1}, {1, 1}, {1, 0}, {0, 0}}};  // v points down, as in glTF
  mesh.material = 0;
  scene.meshes.push_back(mesh);
  const auto at = [&](double x, double y) {
    const Geometry geometry(scene);
    const auto hit = geometry.intersect({{x, y, 1}, {0, 0, -1}});
    const Spectrum c = base_color_at(scene, *hit->material, hit->at);
    return std::array{c[0], c[1], c[2]};
  };
  const auto expect = [&](double x, double y, std::array<double, 3> color) {
    const auto found = at(x, y);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(found[i], color[i], 2e-6) << x << ", " << y;
  };
  expect(-0.5, 0.5, {0.5, 0, 0});          // centre of the first texel: top left
  expect(0.5, 0.5, {0, 1, 0});             // top right
  expect(-0.5, -0.5, {0, 0, 1});           // bottom left
  expect(0, 0, {0.25, 0.5, 0.5});          // between all four
  expect(-0.999999, 0.5, {0.25, 0.5, 0});  // the left edge shows half of what is right
  scene.textures[0].wrap_u = Wrap::clamp;
  expect(-0.999999, 0.5, {0.5, 0, 0});
  scene.meshes[0].uvs = {{{1.25F, 0.25F}, {1.25F, 0.25F}, {1.25F, 0.25F}, {1.25F, 0.25F}}};
  expect(0.3, 0.3, {0, 1, 0});
  scene.textures[0].wrap_u = Wrap::mirror;
  expect(0.3, 0.3, {0, 1, 0});
  scene.textures[0].wrap_u = Wrap::repeat;
  expect(0.3, 0.3, {0.5, 0, 0});
  scene.meshes[0].uvs.clear();
  expect(0.3, 0.3, {0.5, 1, 1});
}

TEST(Surface, MasksAreCutAtTheirThreshold) {
  Scene scene = textured({1, 1, 1});
  scene.textures[0] = {2, 1, {{1, 1, 1}, {1, 1, 1}}, Wrap::clamp, Wrap::clamp, {0.0F, 1.0F}};
  scene.materials[0].color_map = {0, 0};
  scene.meshes.push_back(square({0, 0, -1}, 1));
  scene.meshes[1].material = -1;
  const auto met = [&](double x) { return Geometry(scene).intersect({{x, 0.2, 1}, {0, 0, -1}})->at.mesh; };
  EXPECT_EQ(met(-0.6), 0U) << "opaque: alpha does not count";
  scene.materials[0].alpha_mode = AlphaMode::mask;
  // Alpha grows from 0 at x = -0.5 to 1 at x = 0.5.
  EXPECT_EQ(met(-0.01), 1U);
  EXPECT_EQ(met(0.01), 0U);
  scene.materials[0].alpha = 0.8;
  EXPECT_EQ(met(0.1), 1U);
  EXPECT_EQ(met(0.13), 0U);
  scene.materials[0].alpha_cutoff = 0.0;
  EXPECT_EQ(met(-0.9), 0U);
  const Geometry geometry(scene);
  scene.materials[0].alpha_cutoff = 0.5;
  EXPECT_FALSE(geometry.occluded({{-0.6, 0.2, 1}, {0, 0, -1}}, 1.5));
  EXPECT_TRUE(geometry.occluded({{0.6, 0.2, 1}, {0, 0, -1}}, 1.5));
  EXPECT_FALSE(geometry.occluded({-0.6, 0.2, 1}, {-0.6, 0.2, -0.5}));
}

TEST(Surface, BlendedSurfacesStopTheirPartOfTheRaysAndTheSameRayAlways) {
  Scene scene = textured({1, 1, 1});
  scene.materials[0].alpha_mode = AlphaMode::blend;
  scene.materials[0].alpha = 0.3;
  const Geometry geometry(scene);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-0.9, 0.9);
  constexpr int rays = 100000;
  int stopped = 0;
  for (int i = 0; i < rays; ++i) {
    const Ray ray{{uniform(random), uniform(random), 1.0}, {0, 0, -1}};
    const bool hit = geometry.intersect(ray).has_value();
    EXPECT_EQ(geometry.occluded(ray), hit);
    stopped += hit ? 1 : 0;
  }
  EXPECT_NEAR(stopped, 0.3 * rays, 5.0 * std::sqrt(0.21 * rays));  // false alarms: 6e-7
}

TEST(Surface, NormalMapsLeanRightAndUp) {
  // Codes of the unit vector (0.6, 0, 0.8), then of (0, 0.6, 0.8): +X is right, +Y up in the picture.
  for (const bool sideways : {true, false}) {
    Scene scene = textured({sideways ? 0.8F : 0.5F, sideways ? 0.5F : 0.8F, 0.9F});
    scene.materials[0].normal_map = {0, 0};
    const Ray down{{0.2, 0.3, 1}, {0, 0, -1}}, up{{0.2, 0.3, -1}, {0, 0, 1}};
    const auto expect = [&](const Ray& ray, const Vector& normal) {
      const Vector found = Geometry(scene).intersect(ray)->shading_normal;
      EXPECT_NEAR(length(found - normal), 0.0, 1e-6) << found.x << ' ' << found.y << ' ' << found.z;
    };
    const Vector right = sideways ? Vector{0.6, 0, 0.8} : Vector{0, 0.6, 0.8};
    expect(down, right);
    expect(up, -right);  // the back shows the same relief from behind
    scene.materials[0].normal_scale = 0.0;
    expect(down, {0, 0, 1});
    scene.materials[0].normal_scale = 1.0;
    // A mirrored picture: right is left.
    scene.meshes[0].uvs = {{{1, 1}, {0, 1}, {0, 0}, {1, 0}}};
    expect(down, sideways ? Vector{-0.6, 0, 0.8} : Vector{0, 0.6, 0.8});
    // Tangents of the mesh win: a quarter turn, and the other hand.
    scene.meshes[0].tangents.assign(4, {0, 1, 0, 1});
    expect(down, sideways ? Vector{0, 0.6, 0.8} : Vector{-0.6, 0, 0.8});
    scene.meshes[0].tangents.assign(4, {0, 1, 0, -1});
    expect(down, sideways ? Vector{0, 0.6, 0.8} : Vector{0.6, 0, 0.8});
    scene.meshes[0].tangents.clear();
    scene.meshes[0].uvs.clear();
    expect(down, {0, 0, 1});
  }
}

TEST(Surface, NormalMapsNeverLookAwayFromTheRay) {
  Scene scene = textured({1.0F, 0.5F, 0.6F});
  scene.materials[0].normal_map = {0, 0};
  const Geometry geometry(scene);
  for (int i = 1; i < 100; ++i) {
    const Ray ray{{-5.0, 0.1, 0.05 * i}, normalized({5.0, 0.0, -0.05 * i})};
    const auto hit = geometry.intersect(ray);
    ASSERT_TRUE(hit);
    EXPECT_LT(dot(hit->shading_normal, ray.direction), 0.0);
    EXPECT_NEAR(length(hit->shading_normal), 1.0, 1e-12);
  }
}

}  // namespace
}  // namespace tyndall
