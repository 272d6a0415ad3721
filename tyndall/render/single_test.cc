// The integrator `single`: what it promises of layers, skies, suns, fluence and pixels.
#include "tyndall/render/single.h"

#include <gtest/gtest.h>

#include <cstring>

#include "tyndall/render/camera.h"
#include "tyndall/render/single_truth.h"
#include "tyndall/render/test_scenes.h"

namespace tyndall {
namespace {

using tests::add_material;
using tests::add_quad;
using tests::integral;
using tests::medium_of;
using tests::pi_number;
using tests::probe;

TEST(Single, SurfacesEndTheRayAndShowTheirOwnLight) {
  const double sigma = 0.3;
  Scene scene;
  scene.medium = medium_of(Spectrum::grey(0.0), Spectrum::grey(sigma), Isotropic<double>{});
  add_quad(scene, {-9, -9, -4}, {18, 0, 0}, {0, 18, 0}, add_material(scene, Spectrum::grey(0.0), {{1.0, 2.0, 3.0}}));
  scene.environment = EnvironmentLight{};
  scene.environment->radiance = Spectrum::grey(7.0);
  const PixelLayers seen = probe(scene, {{0, 0, 0}, {0, 0, -1}});
  EXPECT_NEAR(seen.surface[1] / (2.0 * std::exp(-4.0 * sigma)), 1.0, 0.05) << "its 4 % gloss reflects an absorbed sky";
  EXPECT_NEAR(seen.transmittance[0], std::exp(-4.0 * sigma), 1e-12);
  EXPECT_NEAR(seen.depth, 4.0, 1e-12);
  const PixelLayers shorter = probe(scene, {{0, 0, 0}, {0, 0, -1}}, 3.0);
  EXPECT_EQ(shorter.surface[1], 0.0) << "nothing at or beyond the distance is added";
  EXPECT_EQ(shorter.depth, infinity);
  EXPECT_NEAR(shorter.transmittance[0], std::exp(-3.0 * sigma), 1e-12);
  scene.medium.species.clear();
  EXPECT_EQ(probe(scene, {{0, 0, 0}, {0, 0, 1}}).surface[0], 7.0) << "the sky";
}

TEST(Single, AnEvenSkyScattersAsMuchAsItTakesFromAThinBall) {
  // A thin ball in an even sky: what it scatters toward the eye is what extinction took, albedo 1, up to tau^2.
  for (const Law<double>& law : {Law<double>{Isotropic<double>{}}, Law<double>{HenyeyGreenstein<double>{0.9}}}) {
    Scene scene;
    scene.medium = medium_of(Spectrum::grey(1e-4), {}, law, {SphereProfile{{0, 0, -5}, 1.0}});
    scene.environment = EnvironmentLight{};
    scene.environment->radiance = Spectrum::grey(2.0);
    EXPECT_NEAR(probe(scene, {{0, 0, 0}, {0, 0, -1}}).single[0] / (2.0 * 2e-4), 1.0, 1e-3);
  }
}

TEST(Single, APanoramaWithASunScattersAsThatSun) {
  // One bright pixel of 360 x 180: a sun, whatever the fixed directions miss.
  auto panorama = std::make_shared<Panorama>();
  panorama->width = 360;
  panorama->height = 180;
  panorama->radiance.assign(360 * 180, {0.0f, 0.0f, 0.0f});
  const int row = 60, column = 200;
  panorama->radiance[row * 360 + column] = {1e4f, 2e4f, 3e4f};
  Scene scene;
  scene.medium = medium_of(Spectrum::grey(0.1), {}, HenyeyGreenstein<double>{0.5}, {SphereProfile{{0, 0, -5}, 2.0}});
  scene.environment = EnvironmentLight{};
  scene.environment->panorama = panorama;
  const Ray ray{{0, 0, 0}, {0, 0, -1}};
  const double sky = probe(scene, ray).single[0];
  const double polar = pi_number * (row + 0.5) / 180, azimuth = 2.0 * pi_number * ((column + 0.5) / 360 - 0.5);
  Scene sunny = scene;
  sunny.environment.reset();
  const Vector toward{std::sin(polar) * std::sin(azimuth), std::cos(polar), -std::sin(polar) * std::cos(azimuth)};
  const double solid_angle = std::pow(pi_number / 180, 2) * std::sin(polar);
  sunny.suns.push_back({-toward, Spectrum::grey(1e4 * solid_angle), 0.0});
  EXPECT_NEAR(sky / probe(sunny, ray).single[0], 1.0, 0.02);
}

TEST(Single, ASunDiscIsSeenWithItsIrradianceAndScattersLikeAPoint) {
  Scene scene;
  scene.suns.push_back({{0, 0, 1}, Spectrum::grey(3.0), 1.0});
  const double half = 0.5 * pi_number / 180.0, solid_angle = 2.0 * pi_number * (1.0 - std::cos(half));
  EXPECT_NEAR(probe(scene, {{0, 0, 0}, {0, 0, -1}}).surface[0] / (3.0 / solid_angle), 1.0, 1e-9);
  EXPECT_EQ(probe(scene, {{0, 0, 0}, normalized({0.01, 0, -1})}).surface[0], 0.0);
  scene.medium = medium_of(Spectrum::grey(0.1), {}, HenyeyGreenstein<double>{0.5}, {SphereProfile{{0, 0, -5}, 2.0}});
  Scene parallel = scene;
  parallel.suns[0].angular_diameter = 0.0;
  const Ray ray{{0, 0, 0}, normalized({0.2, 0.1, -1})};
  EXPECT_NEAR(probe(scene, ray).single[0] / probe(parallel, ray).single[0], 1.0, 1e-3);
}

/// int over directions of what arrives at most once scattered, for an isotropic point source of 1 W: with the two
/// distances as coordinates, phi_1 = sigma_s / (8 pi r) int_r^inf e^(-sigma s) (2 / s) ln((s + r) / (s - r)) ds.
TEST(Single, FluenceOfAPointSourceAgreesWithItsIntegral) {
  for (const double r : {0.1, 1.0, 3.0}) {
    const double sigma = 1.0, albedo = 0.8;
    Scene scene;
    scene.medium =
        medium_of(Spectrum::grey(sigma * albedo), Spectrum::grey(sigma * (1.0 - albedo)), Isotropic<double>{});
    scene.points.push_back({{0, 0, 0}, Spectrum::grey(1.0 / (4.0 * pi_number))});
    const double once = integral(
        [&](double x) {  // s = r + x^2, which takes the logarithm's edge off
          const double s = r + x * x;
          return x == 0.0 ? 0.0 : std::exp(-sigma * s) * (2.0 / s) * std::log((s + r) / (x * x)) * 2.0 * x;
        },
        0.0, 7.0, 1e-10);
    const double truth =
        std::exp(-sigma * r) / (4.0 * pi_number * r * r) + sigma * albedo / (8.0 * pi_number * r) * once;
    const Geometry geometry(scene);
    const SingleContext context(scene, geometry);
    EXPECT_NEAR(single_fluence(context, {0, 0, r})[0] / truth, 1.0, 1e-3) << r;
    EXPECT_TRUE(std::isinf(single_fluence(context, {0, 0, 0})[0]));
  }
}

TEST(Single, APixelThatSeesALampIsTheAverageOverItsFootprint) {
  Scene scene;
  scene.medium = medium_of(Spectrum::grey(0.05), {}, HenyeyGreenstein<double>{0.7});
  scene.camera = {{0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 40.0};
  scene.film = {16, 12};
  scene.points.push_back({{0.31, 0.17, -6}, Spectrum::grey(1.0)});
  const Geometry geometry(scene);
  const SingleContext context(scene, geometry);
  const CameraRays camera(scene.camera, scene.film);
  double brightest = 0.0;
  for (int y = 4; y < 8; ++y) {
    for (int x = 6; x < 11; ++x) {
      constexpr int n = 150;
      double truth = 0.0;
      for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
          truth += single_radiance(context, camera.through(x + (i + 0.5) / n, y + (j + 0.5) / n)).single[0] / (n * n);
        }
      }
      const double value = single_pixel(context, x, y, 1).single[0];
      EXPECT_NEAR(value / truth, 1.0, 0.02) << x << " " << y;  // the grid's own error beside the pole, too
      brightest = std::max(brightest, value);
    }
  }
  EXPECT_TRUE(std::isfinite(brightest));
}

TEST(Single, IsFiniteAndNotNegativeWhateverTheScene) {
  std::vector<Medium> media = {
      {},
      medium_of(Spectrum::grey(1e6), {}, Isotropic<double>{}),
      medium_of(Spectrum::grey(1e-30), {}, HenyeyGreenstein<double>{0.9999}),
      medium_of(Spectrum::grey(0.0), Spectrum::grey(1.0), Isotropic<double>{}),
      medium_of({{0.0, 1e-3, 1e3}}, {}, MieMurky<double>{}, {ExponentialProfile{10.0, 0.0}}),
      medium_of(Spectrum::grey(5.0), {}, MieHazy<double>{}, {ExponentialProfile{1e-3, 0.0}}),
      medium_of(Spectrum::grey(1.0), {}, Isotropic<double>{}, {BoxProfile{{-1, -1, -1}, {1, 1, 1}}}),
      medium_of(Spectrum::grey(1e4), {}, Isotropic<double>{},
                {SphereProfile{{0, 0, 0}, 1.0}, ExponentialProfile{1.0, 0.0}})};
  for (const Medium& medium : media) {
    Scene scene;
    scene.medium = medium;
    scene.points = {
        {{3, 0, 1e-12}, Spectrum::grey(1.0)}, {{1, 1e6, 0}, Spectrum::grey(1.0)}, {{-2, 1, 0}, {{1, 0, 2}}}};
    scene.spots = {{{2, 3, 1}, {0, -1, 0}, Spectrum::grey(1.0), 0.0, 90.0},
                   {{2, -3, 1}, {0, 1, 0.1}, Spectrum::grey(1.0), 5.0, 5.0}};
    scene.suns = {{{0, -1, 0}, Spectrum::grey(1.0), 0.0},
                  {{1, 0, 0}, Spectrum::grey(1.0), 0.5},
                  {{0, 1, 0}, Spectrum::grey(1.0), 0.0}};
    scene.environment = EnvironmentLight{};
    scene.environment->radiance = Spectrum::grey(1.0);
    add_quad(scene, {-5, -2, 5}, {10, 0, 0}, {0, 0, -10}, add_material(scene, Spectrum::grey(0.5)));
    add_quad(scene, {1, 1, 0}, {1, 0, 0}, {0, 0, 1}, add_material(scene, Spectrum::grey(0.5), Spectrum::grey(1.0)));
    const Geometry geometry(scene);
    SingleSettings settings;
    settings.sky_directions = settings.surface_directions = settings.emissive_points = 16;
    const SingleContext context(scene, geometry, settings);
    for (const Vector& origin : {Vector{0, 0, 0}, Vector{3, 0, 0}, Vector{0, -2, 0}, Vector{0, 500, 0}}) {
      for (const Vector& to : {Vector{1, 0, 0}, Vector{0, 1, 0}, Vector{0, -1, 0}, Vector{-1, 0, 0}, Vector{1, 1, 1}}) {
        for (const double distance : {1e-12, 1.0, 1e6, infinity}) {
          const PixelLayers p = single_radiance(context, {origin, normalized(to)}, distance);
          for (const Spectrum& s : {p.surface, p.single, p.transmittance}) {
            for (std::size_t c = 0; c < channel_count; ++c) {
              EXPECT_TRUE(std::isfinite(s[c]) && s[c] >= 0.0)
                  << "medium " << (&medium - media.data()) << " from " << origin.x << " " << origin.y << " toward "
                  << to.x << " " << to.y << " for " << distance << ": " << s[c];
            }
          }
        }
      }
    }
  }
}

TEST(Single, TheSameInputGivesTheSameBits) {
  const Scene scene = tests::busy_scene();
  const Geometry geometry(scene), again(scene);
  const SingleContext first(scene, geometry), second(scene, again);
  for (int i = 0; i < 20; ++i) {
    const PixelLayers a = single_pixel(first, 7 * i % 48, 5 * i % 32, 1),
                      b = single_pixel(second, 7 * i % 48, 5 * i % 32, 1);
    EXPECT_EQ(0, std::memcmp(&a, &b, sizeof a));
  }
}

TEST(Single, SaysWhatItsQuadraturesWere) {
  const Scene scene;
  const Geometry geometry(scene);
  SingleSettings settings;
  settings.sky_directions = 77;
  const std::string text = single_description(settings);
  EXPECT_NE(text.find("77 directions"), std::string::npos) << text;
}

}  // namespace
}  // namespace tyndall
