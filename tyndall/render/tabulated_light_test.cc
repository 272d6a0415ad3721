// Light in media whose law is a table: kinks cost no accuracy, and a law that differs by channel gives each
// channel what its own law alone would give it.
#include <gtest/gtest.h>

#include <cmath>

#include "tyndall/render/path.h"
#include "tyndall/render/single_truth.h"
#include "tyndall/render/slab.h"
#include "tyndall/render/test_scenes.h"

namespace tyndall {
namespace {

using tests::medium_of;
using tests::probe;

/// Three peaks of different width at 300 angles, as droplets have in three colours.
Tabulated<double> three_peaks() {
  Tabulated<double> out;
  for (int i = 0; i < 300; ++i) {
    const double angle = i == 0 ? 0.0 : i == 299 ? 180.0 : 0.05 * std::pow(3600.0, (i - 1.0) / 298.0);
    const auto d = Deflection<double>::from_angle(angle * std::acos(-1.0) / 180.0);
    Spectrum& value = out.values.emplace_back();
    for (std::size_t c = 0; c < channel_count; ++c)
      value[c] = density(Law<double>(HenyeyGreenstein<double>{0.5 + 0.2 * static_cast<double>(c)}), d);
    out.angles.push_back(angle);
  }
  return out;
}

constexpr double thin = 0.03;

Scene lamp_beside(const Law<double>& law) {
  Scene scene;
  scene.medium = medium_of({{thin, 2 * thin, 3 * thin}}, Spectrum::grey(0.2 * thin), law);
  scene.points.push_back({{1.0, 0.5, -4.0}, {{3.0, 2.0, 1.0}}});
  return scene;
}
const Ray straight_on{{0, 0, 0}, {0, 0, -1}};

TEST(TabulatedLight, EachChannelScattersByItsOwnLawInSingle) {
  const PixelLayers all = probe(lamp_beside(three_peaks()), straight_on, 9.0);
  for (std::size_t c = 0; c < channel_count; ++c) {
    const PixelLayers one = probe(lamp_beside(three_peaks().in_channel(c)), straight_on, 9.0);
    EXPECT_NEAR(all.single[c], one.single[c], 1e-6 * one.single[c]);
    EXPECT_NEAR(all.transmittance[c], one.transmittance[c], 1e-14);
  }
}

// Against Simpson's rule halved until it knows of the kinks.
TEST(TabulatedLight, KinksCostNothingInSingle) {
  const Law<double> law = three_peaks().in_channel(1);
  const LobeSum<double> lobes = lower(law);
  const double scattering = 2 * thin, extinction = 2.2 * thin;
  const auto scattered = [&](double t) {
    const Vector from{0.0 - 1.0, -0.5, -t + 4.0};  // from the lamp
    const double r = length(from);
    const double mu = dot(from / r, {0, 0, 1});
    return std::exp(-extinction * (t + r)) * scattering * density(lobes, Deflection<double>::from_mu(mu)) * 2.0 /
           (r * r);
  };
  const double exact = tests::integral(scattered, 0.0, 9.0, 1e-12);
  EXPECT_NEAR(probe(lamp_beside(law), straight_on, 9.0).single[1], exact, 1e-9 * exact);
}

// Four standard errors of a million paths: a false alarm in 16000 per number, if the seed changed.
TEST(TabulatedLight, PathAgreesWithSingleInEachChannel) {
  const Scene scene = lamp_beside(three_peaks());
  const Geometry geometry(scene);
  const PathContext context(scene, geometry, 1);
  const ProbeEstimate e = path_probe(context, straight_on, 9.0, 200000, 5);
  const PixelLayers exact = probe(scene, straight_on, 9.0);
  for (std::size_t c = 0; c < channel_count; ++c) {
    EXPECT_NEAR(e.radiance[c], exact.single[c], 4.0 * e.standard_error[c] + 1e-6 * exact.single[c]) << c;
    EXPECT_LT(e.standard_error[c], 0.02 * e.radiance[c]) << c;
  }
}

TEST(TabulatedLight, EachChannelOfASlabIsThatOfItsOwnLaw) {
  const auto solved = [](const Law<double>& law, bool by_height) {
    SlabRequest request;
    request.medium = medium_of({{1.0, 2.0, 4.0}}, Spectrum::grey(0.1), law);
    if (by_height) request.medium.species[0].profiles.push_back(ExponentialProfile{0.5, 0.0});
    request.mu0 = 0.7;
    request.paths = 100000;
    return solve_slab(request);
  };
  for (const bool by_height : {false, true}) {
    const SlabResult all = solved(three_peaks(), by_height);
    for (std::size_t c = 0; c < channel_count; ++c) {
      const SlabResult one = solved(three_peaks().in_channel(c), by_height);
      for (const auto part : {&SlabResult::reflectance, &SlabResult::transmittance_diffuse}) {
        const Estimate &a = all.*part, &b = one.*part;
        EXPECT_NEAR(a.mean[c], b.mean[c], 4.0 * std::hypot(a.standard_error[c], b.standard_error[c]) + 1e-12) << c;
      }
      EXPECT_NEAR(all.transmittance_direct[c], one.transmittance_direct[c], 1e-14);
    }
  }
}

}  // namespace
}  // namespace tyndall
