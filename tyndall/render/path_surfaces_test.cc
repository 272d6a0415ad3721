// Maps and alpha as paths see them, against integrals done otherwise.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tyndall/render/bsdf.h"
#include "tyndall/render/path.h"
#include "tyndall/render/test_scenes.h"

namespace tyndall {
namespace {

using tests::add_material;
using tests::add_quad;
using tests::medium_of;

ProbeEstimate seen(const Scene& scene, const Ray& ray, std::uint32_t spp = 40000) {
  const Geometry geometry(scene);
  return path_probe(PathContext(scene, geometry, 0, 1.0), ray, infinity, spp, 3);
}

/// 4.5 standard errors and a rounding: false alarms 7e-6 for each comparison.
void expect(const ProbeEstimate& e, const Spectrum& truth, double most_error) {
  for (std::size_t c = 0; c < channel_count; ++c) {
    EXPECT_NEAR(e.radiance[c], truth[c], 4.5 * e.standard_error[c] + 1e-7 * truth[c]);
    EXPECT_LE(e.standard_error[c], most_error * truth[c]) << "a test that proves little";
  }
}

/// A panel 2 m square, 1.5 m above a matte floor, that shows a red and a green half to it, four texels wide.
Scene picture_panel() {
  Scene scene;
  const int floor = add_material(scene, Spectrum::grey(0.5));
  const int panel = add_material(scene, Spectrum::grey(0.0), Spectrum::grey(5.0));
  add_quad(scene, {-50, 0, 50}, {100, 0, 0}, {0, 0, -100}, floor);
  add_quad(scene, {-1, 1.5, -1}, {2, 0, 0}, {0, 0, 2}, panel);
  scene.textures.push_back(
      {4, 1, {{1, 0.1F, 0}, {1, 0.1F, 0}, {0, 0.1F, 1}, {0, 0.1F, 1}}, Wrap::clamp, Wrap::clamp, {}});
  scene.materials[1].emission_map = {0, 0};
  scene.meshes[1].uvs = {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  return scene;
}

/// What the floor reflects of that panel where a ray meets it, by midpoints.
Spectrum reflected_panel(const Scene& scene, const Ray& ray) {
  constexpr int n = 400;
  const Geometry geometry(scene);
  const SurfacePoint floor = surface_point(geometry, *geometry.intersect(ray));
  const Vector at = floor.position;
  Spectrum total;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const double x = (i + 0.5) / n, z = (j + 0.5) / n;
      const Vector way = Vector{2 * x - 1, 1.5, 2 * z - 1} - at;
      const double squared = length_squared(way), cosine = way.y / std::sqrt(squared);
      const Spectrum reflected = evaluate(floor, -ray.direction, normalized(way));
      // In the triangle of corners 0, 1, 2, or that of 0, 2, 3.
      const SurfacePlace place = z <= x ? SurfacePlace{1, 0, x - z, z} : SurfacePlace{1, 1, x, z - x};
      total += emission_at(scene, scene.materials[1], place) * reflected * (cosine / squared * 4.0 / (n * n));
    }
  }
  return total;
}

TEST(PathSurfaces, EmissionMapsLightAFloorAsTheirPictureSays) {
  const Scene scene = picture_panel();
  for (const double x : {-0.9, 0.2}) {
    const Vector eye{3.0, 0.2, 0.3};
    const Ray ray{eye, normalized(Vector{x, 0, 0.3} - eye)};
    expect(seen(scene, ray), reflected_panel(scene, ray), 0.02);
  }
}

TEST(PathSurfaces, EmissionMapsLightTheAir) {
  // A thin medium, one scattering: the brightness of a ray past the panel, against a sum over the panel and the ray.
  Scene scene = picture_panel();
  scene.materials[0].base_color = Spectrum{};
  scene.materials[0].ior = 1.0;
  constexpr double scattering = 1e-4;
  scene.medium = medium_of(Spectrum::grey(scattering), {}, Isotropic<double>{}, {BoxProfile{{-4, 0, -4}, {4, 1, 4}}});
  const Geometry geometry(scene);
  const ProbeEstimate e = path_probe(PathContext(scene, geometry, 1, 1.0), {{-2, 0.5, 0.3}, {1, 0, 0}}, 4.0, 200000, 5);
  constexpr int places = 200, n = 100;
  Spectrum truth;
  for (int k = 0; k < places; ++k) {
    const Vector at{-2 + 4 * (k + 0.5) / places, 0.5, 0.3};
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        const double x = (i + 0.5) / n, z = (j + 0.5) / n;
        const Vector way = Vector{2 * x - 1, 1.5, 2 * z - 1} - at;
        const double squared = length_squared(way);
        const SurfacePlace place = z <= x ? SurfacePlace{1, 0, x - z, z} : SurfacePlace{1, 1, x, z - x};
        truth += emission_at(scene, scene.materials[1], place) * (way.y / std::sqrt(squared) / squared * 4.0 / (n * n) *
                                                                  4.0 / places * scattering / (4.0 * std::numbers::pi));
      }
    }
  }
  for (std::size_t c = 0; c < channel_count; ++c) {
    // 1e-3: what the thin medium takes away and the sums leave out.
    EXPECT_NEAR(e.radiance[c], truth[c], 4.5 * e.standard_error[c] + 1e-3 * truth[c]);
    EXPECT_LT(e.standard_error[c], 0.02 * truth[c]);
  }
}

TEST(PathSurfaces, BlendedSheetsLetTheirPartThrough) {
  Scene scene;
  const int sheet = add_material(scene, Spectrum::grey(0.0));
  add_quad(scene, {-1e4, 2, -1e4}, {2e4, 0, 0}, {0, 0, 2e4}, sheet);
  add_material(scene, Spectrum::grey(0.6));
  add_quad(scene, {-50, 0, 50}, {100, 0, 0}, {0, 0, -100}, 1);
  scene.materials[0].ior = scene.materials[1].ior = 1.0;
  scene.materials[0].alpha_mode = AlphaMode::blend;
  scene.materials[0].alpha = 0.3;
  scene.suns.push_back({{0.2, -1.0, 0.1}, {{2, 3, 4}}, 0.5});
  scene.environment = EnvironmentLight{};
  scene.environment->radiance = {{0.5, 0.6, 0.7}};
  const Geometry geometry(scene);
  const PathContext context(scene, geometry, 0, 1.0);
  // The mean of rays from slightly different places: each by itself meets the sheet or does not.
  const auto mean_of = [&](const Vector& direction) {
    constexpr int rays = 4000;
    Spectrum total, squares;
    for (int i = 0; i < rays; ++i) {
      const Ray ray{{1e-3 * i, 1, 0}, normalized(direction)};
      const Spectrum found = path_probe(context, ray, infinity, 8, static_cast<std::uint64_t>(i), 1).radiance;
      total += found / rays;
      squares += found * found / rays;
    }
    return std::pair{total, map(squares - total * total, [&](double x) { return std::sqrt(x / rays); })};
  };
  const Vector up{0.1, 0.5, 0.1}, down{0.3, -1, 0.2};
  // Up through the sheet: the sky, dimmed; down on the floor: sun and sky, both dimmed.
  const auto [sky, sky_error] = mean_of(up);
  const auto [floor_below, floor_error] = mean_of(down);
  scene.materials[0].alpha = 0.0;
  const auto [bare, bare_error] = mean_of(down);
  expect(seen(scene, {{0, 1, 0}, normalized(up)}), scene.environment->radiance, 1e-9);
  for (std::size_t c = 0; c < channel_count; ++c) {
    // 1e-3: what the sheet, black but for its gloss, reflects of the floor.
    EXPECT_NEAR(sky[c], 0.7 * scene.environment->radiance[c], 4.5 * sky_error[c] + 1e-3);
    EXPECT_LT(sky_error[c], 0.02 * sky[c]);
    EXPECT_NEAR(floor_below[c], 0.7 * bare[c], 4.5 * (floor_error[c] + bare_error[c]) + 1e-3);
    EXPECT_LT(floor_error[c], 0.02 * bare[c]);
  }
}

TEST(PathSurfaces, NormalMapsTurnTheLightAsTheSlopesTheyStandFor) {
  // A map of one slope everywhere: the sun's reflection is the cosine to the leaning normal.
  Scene scene;
  const int floor = add_material(scene, Spectrum::grey(0.6));
  add_quad(scene, {-5, 0, 5}, {10, 0, 0}, {0, 0, -10}, floor);
  scene.textures.push_back({1, 1, {{0.8F, 0.5F, 0.9F}}, Wrap::clamp, Wrap::clamp, {}});
  scene.materials[0].normal_map = {0, 0};
  scene.meshes[0].uvs = {{{0, 1}, {1, 1}, {1, 0}, {0, 0}}};
  scene.suns.push_back({{-1.0, -1.0, 0.0}, {{2, 3, 4}}, 0.0});
  const Ray ray{{0, 1, 0}, normalized({0.1, -1, 0.2})};
  const auto e = seen(scene, ray, 100);
  const Vector leaning{0.6, 0.8, 0.0};
  const SurfacePoint there{{}, leaning, Frame::around(leaning), Spectrum::grey(0.6), 0.0, 1.0, 0.04};
  expect(e, evaluate(there, -ray.direction, normalized({1, 1, 0})) * scene.suns[0].irradiance, 1e-6);
}

}  // namespace
}  // namespace tyndall
