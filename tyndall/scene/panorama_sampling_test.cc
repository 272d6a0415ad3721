#include "tyndall/scene/panorama_sampling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "tests/shared_folder.h"
#include "tyndall/image/panorama.h"

namespace tyndall {
namespace {

constexpr double pi_number = std::numbers::pi;

EnvironmentLight light_of(Panorama panorama) {
  EnvironmentLight light;
  light.panorama = std::make_shared<const Panorama>(std::move(panorama));
  return light;
}

/// Dark but for single bright pixels (column, row, channel).
EnvironmentLight spots(int width, int height, const std::vector<std::array<int, 3>>& bright) {
  Panorama p{width, height, {}};
  p.radiance.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (const auto& [x, y, channel] : bright) {
    p.radiance[static_cast<std::size_t>(y * width + x)][static_cast<std::size_t>(channel)] = 1.0F;
  }
  return light_of(std::move(p));
}

EnvironmentLight noise(int width, int height) {
  std::mt19937 random(7);
  std::exponential_distribution<float> value;
  Panorama p{width, height, {}};
  p.radiance.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (auto& c : p.radiance) {
    for (float& x : c) x = random() % 3 == 0 ? 0.0F : value(random) * value(random);
  }
  return light_of(std::move(p));
}

TEST(PanoramaLookup, CentreLooksAlongMinusZAndColumnsGrowTowardPlusX) {
  // Pixel centres of an 8 x 4 picture: columns every 45 degrees, rows every 45 degrees from 22.5 off the pole.
  const double up = std::sin(pi_number / 8), out = std::cos(pi_number / 8);
  const auto direction = [&](int column, double y, double horizontal) {
    const double azimuth = (column + 0.5 - 4) * pi_number / 4;
    return Vector{horizontal * std::sin(azimuth), y, -horizontal * std::cos(azimuth)};
  };
  for (int column = 0; column < 8; ++column) {
    const EnvironmentLight upper = spots(8, 4, {{column, 1, 0}}), lower = spots(8, 4, {{column, 2, 1}});
    EXPECT_NEAR(radiance(upper, direction(column, up, out))[0], 1.0, 1e-12);
    EXPECT_NEAR(radiance(lower, direction(column, -up, out))[1], 1.0, 1e-12);
    EXPECT_NEAR(radiance(upper, direction(column + 1, up, out))[0], 0.0, 1e-12);
  }
  // Said in words: what is right of the middle is seen toward +X, left and right edges meet toward +Z.
  EXPECT_GT(radiance(spots(8, 4, {{4, 1, 0}}), normalized({0.3, 0.3, -1}))[0], 0.5);
  EXPECT_GT(radiance(spots(8, 4, {{5, 1, 0}}), normalized({1, 0.3, -0.3}))[0], 0.5);
  EXPECT_NEAR(radiance(spots(8, 4, {{0, 1, 0}}), normalized({0, std::tan(pi_number / 8), 1}))[0], 0.5, 1e-12);
  EXPECT_NEAR(radiance(spots(8, 4, {{7, 1, 0}}), normalized({0, std::tan(pi_number / 8), 1}))[0], 0.5, 1e-12);
  EXPECT_EQ(
      radiance(spots(8, 4, {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}, {5, 0, 0}, {6, 0, 0}, {7, 0, 0}}),
               {0, 1, 0})[0],
      1.0);
}

TEST(PanoramaLookup, RotationIsCounterClockwiseSeenFromAbove) {
  EnvironmentLight light = spots(8, 4, {{3, 1, 0}, {4, 1, 0}, {3, 2, 0}, {4, 2, 0}});  // around -Z
  EXPECT_EQ(radiance(light, {0, 0, -1})[0], 1.0);
  light.rotation = 90.0;
  // Seen from above with -Z at the top of the sheet, a quarter turn counter-clockwise ends at the left: -X.
  EXPECT_NEAR(radiance(light, {-1, 0, 0})[0], 1.0, 1e-12);
  EXPECT_NEAR(radiance(light, {1, 0, 0})[0], 0.0, 1e-12);
  light.rotation = 90.0 - 3600.0;
  EXPECT_NEAR(radiance(light, {-1, 0, 0})[0], 1.0, 1e-9);
}

TEST(PanoramaLookup, ScaleMultipliesPanoramasAndConstants) {
  EnvironmentLight light = noise(8, 4);
  const Vector d = normalized({0.2, 0.5, -0.4});
  const Spectrum before = radiance(light, d);
  light.scale = {{2, 3, 4}};
  EXPECT_EQ(radiance(light, d), (before * Spectrum{{2, 3, 4}}));
  light.panorama = nullptr;
  light.radiance = {{1, 2, 3}};
  EXPECT_EQ(radiance(light, d), (Spectrum{{2, 6, 12}}));
}

/// Integral of f over the sphere by midpoints in azimuth and the cosine, `n` x 2 `n` of them.
template <class F>
double over_sphere(int n, F f) {
  double total = 0.0;
  for (int i = 0; i < n; ++i) {
    const double y = 1.0 - 2.0 * (i + 0.5) / n, r = std::sqrt(1.0 - y * y);
    for (int j = 0; j < 2 * n; ++j) {
      const double azimuth = pi_number * (j + 0.5) / n;
      total += f(Vector{r * std::sin(azimuth), y, r * std::cos(azimuth)});
    }
  }
  return total * 4.0 * pi_number / (2.0 * n * n);
}

TEST(PanoramaSampler, DensityIntegratesToOneOverTheSphere) {
  for (const auto& [width, height] : {std::pair{8, 4}, {7, 5}, {1, 1}, {2, 1}, {64, 32}}) {
    EnvironmentLight light = noise(width, height);
    light.radiance = Spectrum{};
    light.rotation = 33.0;
    if (width == 1) light = spots(1, 1, {{0, 0, 1}});
    const PanoramaSampler sampler(&light);
    if (sampler.empty()) continue;
    // Cells have jumps at their edges: the midpoint rule is good to about cells / n.
    EXPECT_NEAR(over_sphere(1500, [&](const Vector& d) { return sampler.density(d); }), 1.0, 3e-3) << width;
  }
  EnvironmentLight constant;
  constant.radiance = Spectrum::grey(2.0);
  const PanoramaSampler sampler(&constant);
  EXPECT_EQ(sampler.density({0, 1, 0}), 1.0 / (4.0 * pi_number));
}

TEST(PanoramaSampler, SamplesAgreeWithDensityAndLookup) {
  EnvironmentLight light = noise(16, 8);
  light.rotation = -71.0;
  light.scale = {{1, 0.5, 2}};
  const PanoramaSampler sampler(&light);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform;
  int elsewhere = 0;
  for (int i = 0; i < 50000; ++i) {
    const DirectionSample s = sampler.sample(uniform(random), uniform(random));
    EXPECT_NEAR(length(s.direction), 1.0, 1e-12);
    EXPECT_GT(s.density, 0.0);
    EXPECT_EQ(s.radiance, radiance(light, s.direction));
    // A direction on the edge of its cell may be looked up in the next one.
    if (std::fabs(sampler.density(s.direction) / s.density - 1.0) > 1e-9) ++elsewhere;
  }
  EXPECT_LE(elsewhere, 1);
}

TEST(PanoramaSampler, EstimatesOfIrradianceAreUnbiasedAndBounded) {
  EnvironmentLight light = noise(16, 8);
  light.rotation = 12.0;
  const PanoramaSampler sampler(&light);
  const Vector normal = normalized({0.3, 0.8, -0.5});
  const double truth =
      over_sphere(1500, [&](const Vector& d) { return mean(radiance(light, d)) * std::max(0.0, dot(d, normal)); });
  const double whole = over_sphere(1500, [&](const Vector& d) { return mean(radiance(light, d)); });
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform;
  constexpr int samples = 400000;
  double total = 0.0, squares = 0.0;
  for (int i = 0; i < samples; ++i) {
    const DirectionSample s = sampler.sample(uniform(random), uniform(random));
    const double weight = mean(s.radiance) / s.density;
    EXPECT_LE(weight, 4.0 * whole * 1.01);
    const double x = weight * std::max(0.0, dot(s.direction, normal));
    total += x;
    squares += x * x;
  }
  const double average = total / samples;
  const double error = std::sqrt((squares / samples - average * average) / samples);
  EXPECT_NEAR(average, truth, 5.0 * error);  // false alarm: 6e-7
  EXPECT_LT(error / truth, 0.003);
}

TEST(PanoramaSampler, CellsFollowTheirChances) {
  const EnvironmentLight light = noise(6, 3);
  const PanoramaSampler sampler(&light);
  const auto cells = sampler.cells();
  ASSERT_EQ(cells.size(), 24U);
  double sphere = 0.0;
  Spectrum irradiance;
  for (const auto& cell : cells) {
    sphere += cell.solid_angle;
    irradiance += cell.irradiance;
  }
  EXPECT_NEAR(sphere, 4.0 * pi_number, 1e-12);
  for (const auto& cell : cells) {
    EXPECT_NEAR(sampler.density(cell.direction) * cell.solid_angle, mean(cell.irradiance) / mean(irradiance), 1e-12);
  }
}

TEST(PanoramaSampler, NoLightIsNoSample) {
  EXPECT_TRUE(PanoramaSampler(nullptr).empty());
  EXPECT_EQ(PanoramaSampler(nullptr).sample(0.5, 0.5).density, 0.0);
  EXPECT_EQ(PanoramaSampler(nullptr).density({0, 1, 0}), 0.0);
  const EnvironmentLight dark = spots(4, 2, {});
  EXPECT_TRUE(PanoramaSampler(&dark).empty());
  const EnvironmentLight black;
  EXPECT_EQ(PanoramaSampler(&black).density({0, 1, 0}), 0.0);
}

TEST(PanoramaSampler, ASmallSunIsNeverMissed) {
  // One bright pixel of 500 000: its four cells hold all light.
  const EnvironmentLight light = spots(1000, 500, {{700, 100, 0}});
  const PanoramaSampler sampler(&light);
  std::mt19937 random(9);
  std::uniform_real_distribution<double> uniform;
  double total = 0.0;
  for (int i = 0; i < 20000; ++i) {
    const DirectionSample s = sampler.sample(uniform(random), uniform(random));
    total += s.radiance[0] / s.density;
  }
  // Bilinear weights average 1/4 over the four cells.
  const double cell = 2.0 * pi_number / 1000 * pi_number / 500 * std::sin(pi_number * 100.5 / 500);
  EXPECT_NEAR(total / 20000, cell, 0.02 * cell);
}

TEST(PanoramaSampler, RealPanoramasIntegrateToTheirOwnLight) {
  TYNDALL_NEEDS_SHARED_FILE(folder, "assets/environments");
  for (const char* name : {"gltf-transform/royal_esplanade_1k.hdr", "open-shading-language/kitchen_probe.hdr",
                           "openexr-images/KernerEnvLatLong.exr"}) {
    const EnvironmentLight light = light_of(read_panorama(folder / name));
    const PanoramaSampler sampler(&light);
    double truth = 0.0;
    for (const auto& cell : sampler.cells()) truth += mean(cell.irradiance);
    std::mt19937 random(11);
    std::uniform_real_distribution<double> uniform;
    double total = 0.0, squares = 0.0;
    constexpr int samples = 50000;
    for (int i = 0; i < samples; ++i) {
      const DirectionSample s = sampler.sample(uniform(random), uniform(random));
      const double x = mean(s.radiance) / s.density;
      total += x;
      squares += x * x;
    }
    const double average = total / samples, spread = std::sqrt(squares / samples - average * average);
    // Cells' means leave out how solid angle varies inside a cell: 1e-3 beside the noise.
    EXPECT_NEAR(average, truth, 5.0 * spread / std::sqrt(samples) + 1e-3 * truth) << name;
    EXPECT_LT(spread, 0.5 * average) << name;
  }
}

}  // namespace
}  // namespace tyndall
