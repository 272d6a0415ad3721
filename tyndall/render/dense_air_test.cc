// Paths in dense air take other ways to sunlight than in thin air (dense_air.h): the slab, which has none of them, says
// the same.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tyndall/medium/grid_cases_test.h"
#include "tyndall/render/path.h"
#include "tyndall/render/path_prepared.h"
#include "tyndall/render/slab.h"
#include "tyndall/render/test_scenes.h"

namespace tyndall {
namespace {

constexpr double mu0 = 0.6, half_width = 2e3;

SlabRequest deep_slab() {
  SlabRequest slab;
  slab.medium = tests::medium_of({11.88, 15.9, 23.9}, {0.12, 0.1, 0.1}, HenyeyGreenstein<double>{0.85});
  slab.mu0 = mu0;
  slab.mu = {0.5, 0.9};
  slab.paths = 100000;
  return slab;
}

/// The slab as a box so wide that no walk gets to its sides, under a sun and over nothing, with these profiles besides.
Scene wide_box(std::vector<Profile> profiles) {
  Scene scene;
  scene.medium = deep_slab().medium;
  profiles.push_back(BoxProfile{{-half_width, 0, -half_width}, {half_width, 1, half_width}});
  scene.medium.species[0].profiles = std::move(profiles);
  scene.suns.push_back({{std::sqrt(1.0 - mu0 * mu0), -mu0, 0.0}, Spectrum::grey(std::numbers::pi / mu0), 0.0});
  return scene;
}

/// The mean over azimuths of the radiance that leaves the top (mu > 0) or the bottom at a cosine, which is the slab's
/// reflection or transmission; and its standard error.
Estimate leaving(const Scene& scene, double mu) {
  constexpr int azimuths = 24;
  const Geometry geometry(scene);
  const PathContext path(scene, geometry, 0, 1.0);
  Estimate out;
  for (int i = 0; i < azimuths; ++i) {
    const double phi = 2.0 * std::numbers::pi * (i + 0.5) / azimuths, r = std::sqrt(1.0 - mu * mu);
    const Ray ray{{0.1 * i, mu > 0.0 ? 1.5 : -0.5, 0.3}, {r * std::cos(phi), -mu, r * std::sin(phi)}};
    const ProbeEstimate e = path_probe(path, ray, infinity, 4000, static_cast<std::uint64_t>(i + 1));
    for (std::size_t c = 0; c < channel_count; ++c) {
      out.mean[c] += e.radiance[c] / azimuths;
      out.standard_error[c] += std::pow(e.standard_error[c] / azimuths, 2);
    }
  }
  out.standard_error = map(out.standard_error, [](double x) { return std::sqrt(x); });
  return out;
}

void expect_slab(const Scene& scene) {
  const SlabResult slab = solve_slab(deep_slab());
  for (const bool top : {true, false}) {
    for (std::size_t k = 0; k < 2; ++k) {
      const Estimate& wanted = top ? slab.reflection[k] : slab.transmission[k];
      const Estimate found = leaving(scene, top ? deep_slab().mu[k] : -deep_slab().mu[k]);
      for (std::size_t c = 0; c < channel_count; ++c) {
        const double error = std::hypot(wanted.standard_error[c], found.standard_error[c]);
        EXPECT_NEAR(found.mean[c], wanted.mean[c], 4.5 * error) << top << ' ' << k << ' ' << c;
        EXPECT_LT(error, 0.03 * wanted.mean[c]);
      }
    }
  }
}

TEST(DenseAir, ABoxUnderTheSunIsASlab) { expect_slab(wide_box({})); }

TEST(DenseAir, AGridUnderTheSunIsASlab) {
  constexpr double voxel = 400.0;
  expect_slab(wide_box({tests::grid_of({-8, -3, -8}, {8, 12, 8}, {}, {voxel, 0, 0}, {0, 0.2, 0}, {0, 0, voxel},
                                       [](int, int, int) { return 1.0; })}));
}

TEST(DenseAir, LiesAheadWhereThereIsRoomForIt) {
  const Scene scene = wide_box({});
  const DenseAir air(lower(scene.medium));
  const Vector up{0, 1, 0}, along{1, 0, 0};
  const Spectrum extinction{12, 16, 24};
  EXPECT_TRUE(air.lies_ahead({{0, 0.1, 0}, up}, extinction, infinity));
  EXPECT_FALSE(air.lies_ahead({{0, 0.1, 0}, up}, extinction, 0.3));
  EXPECT_FALSE(air.lies_ahead({{0, 0.7, 0}, up}, extinction, infinity));
  EXPECT_TRUE(air.lies_ahead({{0, 0.7, 0}, along}, extinction, infinity));
  EXPECT_FALSE(air.lies_ahead({{0, 0.1, 0}, up}, {12, 3, 24}, infinity));
  Medium thinning = tests::medium_of(Spectrum::grey(1.0), {}, Isotropic<double>{}, {ExponentialProfile{2.0, 0.0}});
  const DenseAir sky(lower(thinning));
  EXPECT_FALSE(sky.lies_ahead({{0, 0, 0}, up}, Spectrum::grey(1.0), infinity));
  EXPECT_TRUE(sky.lies_ahead({{0, 0, 0}, up}, Spectrum::grey(4.0), infinity));
  EXPECT_TRUE(sky.lies_ahead({{0, 0, 0}, along}, Spectrum::grey(1.0), infinity));
  EXPECT_FALSE(DenseAir(LoweredMedium{}).lies_ahead({{0, 0, 0}, up}, {}, infinity));
}

}  // namespace
}  // namespace tyndall
