// Both integrators and the slab in media of every profile.
#include <gtest/gtest.h>

#include "tyndall/medium/grid_cases_test.h"
#include "tyndall/render/path.h"
#include "tyndall/render/single.h"
#include "tyndall/render/slab.h"
#include "tyndall/render/test_scenes.h"

namespace tyndall {
namespace {

using tests::medium_of;

struct Case {
  const char* name;
  std::vector<Profile> profiles;
};

std::vector<Case> cases() {
  const NoiseProfile noise{1.5, 2, 1.0, 3, {}};
  const BoxProfile box{{-1, -1, -4}, {1.5, 1, -1}}, soft{{-1, -1, -4}, {1.5, 1, -1}, 0.8};
  return {
      {"layer", {LayerProfile{-0.5, 0.4}}},
      {"tent", {TentProfile{0.1, 0.8}}},
      {"soft box", {soft}},
      {"soft ball", {SphereProfile{{0.2, 0.1, -2.5}, 1.3, 0.7}}},
      {"noise in a box", {noise, box}},
      {"exponential layer in a soft box", {ExponentialProfile{0.7, 0.0}, LayerProfile{-0.5, 0.6}, soft}},
      {"grid", {[] {
         GridProfile grid = tests::ragged_grid(true);
         grid.position = {0.1, 0.0, -2.0};
         return grid;
       }()}},
      {"layer in a ball", {LayerProfile{-0.5, 0.6}, SphereProfile{{0.2, 0.1, -2.5}, 1.3}}},
      {"noise in a tent in a soft ball", {noise, TentProfile{0.1, 0.8}, SphereProfile{{0.2, 0.1, -2.5}, 1.3, 0.7}}}};
}

Scene scene_of(const Case& c, int light) {
  Scene scene;
  scene.medium = medium_of({{0.5, 0.7, 0.9}}, {{0.1, 0.0, 0.2}}, HenyeyGreenstein<double>{0.4}, c.profiles);
  // A second species everywhere scatters light that the first one shades.
  const Medium haze = medium_of(Spectrum::grey(0.02), {}, Isotropic<double>{}, {BoxProfile{{-5, -5, -9}, {5, 5, 3}}});
  scene.medium.species.push_back(haze.species[0]);
  if (light == 0) scene.points.push_back({{0.3, 1.4, -2.2}, Spectrum::grey(3.0)});
  if (light == 1) scene.points.push_back({{0.3, 0.2, -2.2}, Spectrum::grey(3.0)});
  if (light == 2) scene.spots.push_back({{-1.5, 1.2, -2}, {1.5, -1.2, -0.5}, Spectrum::grey(8.0), 10, 25});
  if (light == 3) scene.suns.push_back({{0.3, -1, -0.5}, Spectrum::grey(2.0), 0.0});
  return scene;
}

TEST(ProfileRender, PathAndSingleAgree) {
  for (const Case& c : cases()) {
    for (int light = 0; light < 4; ++light) {
      const Scene scene = scene_of(c, light);
      const Geometry geometry(scene);
      SingleSettings settings;
      settings.tolerance = 1e-6;
      const SingleContext single(scene, geometry, settings);
      const PathContext path(scene, geometry, 1);
      const Ray ray{{-0.2, 0.15, 2.0}, normalized({0.08, -0.03, -1.0})};
      const PixelLayers exact = single_radiance(single, ray);
      const ProbeEstimate estimate = path_probe(path, ray, infinity, 20000, 7, 2);
      for (std::size_t i = 0; i < channel_count; ++i) {
        EXPECT_EQ(exact.transmittance[i], estimate.transmittance[i]) << c.name;
        // 4.5 standard errors: 96 figures, false alarms 7e-4.
        EXPECT_NEAR(exact.single[i], estimate.radiance[i], 4.5 * estimate.standard_error[i])
            << c.name << ", light " << light;
        EXPECT_LT(estimate.standard_error[i], 0.02 * exact.single[i]) << c.name << ", light " << light;
      }
    }
  }
}

TEST(ProfileRender, SingleDoesNotDependOnItsTolerance) {
  for (const Case& c : cases()) {
    if (std::holds_alternative<NoiseProfile>(c.profiles[0])) continue;
    const Scene scene = scene_of(c, 1), sunny = scene_of(c, 3);
    for (const Scene* s : {&scene, &sunny}) {
      const Geometry geometry(*s);
      SingleSettings fine, coarse;
      fine.tolerance = 1e-11;
      coarse.tolerance = 1e-7;
      const Ray ray{{-0.2, 0.15, 2.0}, normalized({0.08, -0.03, -1.0})};
      const Spectrum a = single_radiance(SingleContext(*s, geometry, fine), ray).single;
      const Spectrum b = single_radiance(SingleContext(*s, geometry, coarse), ray).single;
      for (std::size_t i = 0; i < channel_count; ++i) EXPECT_NEAR(a[i], b[i], 1e-6 * a[i]) << c.name;
    }
  }
}

TEST(ProfileRender, AFeatherOfNothingAndNoiseOfNothingChangeNoBit) {
  const Ray ray{{-0.2, 0.15, 2.0}, normalized({0.08, -0.03, -1.0})};
  const auto radiance = [&](std::vector<Profile> profiles) {
    const Scene scene = scene_of({"", std::move(profiles)}, 0);
    const Geometry geometry(scene);
    return single_radiance(SingleContext(scene, geometry), ray).single;
  };
  const BoxProfile box{{-1, -1, -4}, {1.5, 1, -1}};
  EXPECT_EQ(radiance({box}), radiance({box, NoiseProfile{1.0, 4, 0.0, 3, {}}, ConstantProfile{}}));
  EXPECT_EQ(radiance({box}), radiance({LayerProfile{-1, 1}, BoxProfile{{-1, -9, -4}, {1.5, 9, -1}}}));
}

/// A homogeneous slab and the layered ones of its optical depth are one slab.
TEST(ProfileRender, LayeredSlabsAreHomogeneousOnesOfTheirDepth) {
  struct Layered {
    const char* name;
    std::vector<Profile> profiles;
    double column;
  };
  const double e = std::exp(-1.0);
  const Layered layered[] = {{"layer", {LayerProfile{0.25, 0.5}}, 0.25},
                             {"tent", {TentProfile{0.5, 0.5}}, 0.5},
                             {"cut tent", {TentProfile{0.0, 1.0}}, 0.5},
                             // int_0^1 e^-y (1 - |2 y - 1|) dy with its two ramps by hand.
                             {"exponential tent",
                              {ExponentialProfile{1.0, 0.0}, TentProfile{0.5, 0.5}},
                              2.0 * (1.0 - 2.0 * std::sqrt(e) + e)}};
  SlabRequest even;
  even.medium = medium_of({{1.0, 0.5, 2.0}}, {{0.1, 0.3, 0.0}}, HenyeyGreenstein<double>{0.6});
  even.mu0 = 0.6;
  even.ground = 0.3;
  even.paths = 200000;
  const SlabResult a = solve_slab(even);
  for (const Layered& c : layered) {
    SlabRequest request = even;
    request.paths = 60000;
    for (Species& s : request.medium.species) {
      s.scattering *= 1.0 / c.column;
      s.absorption *= 1.0 / c.column;
      s.profiles = c.profiles;
    }
    ASSERT_FALSE(slab_objection(request));
    const SlabResult b = solve_slab(request);
    for (std::size_t i = 0; i < channel_count; ++i) {
      EXPECT_NEAR(a.transmittance_direct[i], b.transmittance_direct[i], 1e-12) << c.name;
      const auto same = [&](const Estimate& x, const Estimate& y) {
        EXPECT_NEAR(x.mean[i], y.mean[i], 4.5 * std::hypot(x.standard_error[i], y.standard_error[i])) << c.name;
      };
      same(a.reflectance, b.reflectance);
      same(a.transmittance_diffuse, b.transmittance_diffuse);
    }
  }
}

TEST(ProfileRender, SlabsSayWhatTheyCannotDo) {
  SlabRequest request;
  request.medium = medium_of(Spectrum::grey(1.0), {}, Isotropic<double>{}, {NoiseProfile{}});
  ASSERT_TRUE(slab_objection(request));
  EXPECT_NE(slab_objection(request)->found.find("noise"), std::string::npos);
  request.medium.species[0].profiles = {LayerProfile{0.0, 0.5}};
  EXPECT_FALSE(slab_objection(request));
  request.thickness = infinity;
  ASSERT_TRUE(slab_objection(request));
  EXPECT_EQ(slab_objection(request)->field, "thickness");
}

TEST(ProfileRender, TheTimeOfASceneMovesItsNoise) {
  const Ray ray{{-0.2, 0.15, 2.0}, normalized({0.08, -0.03, -1.0})};
  const auto seen = [&](const Vector& wind, double time) {
    Scene scene = scene_of({"", {NoiseProfile{1.0, 2, 1.0, 3, wind}, BoxProfile{{-1, -1, -4}, {1.5, 1, -1}}}}, 0);
    scene.time = time;
    const Geometry geometry(scene);
    return path_probe(PathContext(scene, geometry), ray, infinity, 1, 1).transmittance;
  };
  EXPECT_EQ(seen({0, 0, 0}, 5.0), seen({1, 0, 0}, 0.0));
  EXPECT_NE(seen({1, 0, 0}, 5.0), seen({1, 0, 0}, 0.0));
  EXPECT_EQ(seen({1, 0, 0}, 4.0), seen({2, 0, 0}, 2.0));
}

}  // namespace
}  // namespace tyndall
