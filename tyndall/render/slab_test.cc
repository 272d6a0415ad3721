// What slabs promise without reference data: honest errors, the same bits for any threads, agreement of the two
// implementations.
#include "tyndall/render/slab.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tyndall/render/test_slabs.h"

namespace tyndall {
namespace {

void expect_same(const Estimate& a, const Estimate& b, const char* what) {
  for (std::size_t c = 0; c < channel_count; ++c) {
    const double error = std::hypot(a.standard_error[c], b.standard_error[c]);
    EXPECT_LT(std::fabs(a.mean[c] - b.mean[c]), 4.5 * error + 1e-12) << what << " channel " << c;
  }
}

/// Also where few paths make small replicates, and the last of them is short: of 1, 8 and 64 paths here.
TEST(SlabTruth, StandardErrorsAreHonestForAnyNumberOfPaths) {
  for (const std::uint32_t paths : {100u, 1500u, 10000u}) {
    SlabRequest request;
    request.medium = chromatic_mixture();
    request.paths = paths;
    request.diffuse = true;
    Spread reflected[channel_count], transmitted[channel_count];
    for (request.seed = 1; request.seed <= 256; ++request.seed) {
      const SlabResult result = solve_slab(request);
      for (std::size_t c = 0; c < channel_count; ++c) {
        reflected[c].add(result.reflectance, c);
        transmitted[c].add(result.transmittance_diffuse, c);
      }
    }
    for (std::size_t c = 0; c < channel_count; ++c) {
      const std::string what = std::to_string(paths) + " paths, channel " + std::to_string(c);
      reflected[c].expect_as_said(what + " R");
      transmitted[c].expect_as_said(what + " T");
    }
  }
}

TEST(SlabTruth, ErrorsAreHonestWhereDensityVariesWithHeight) {
  SlabRequest request;
  request.medium = chromatic_mixture();
  for (Species& s : request.medium.species) s.profiles.push_back(ExponentialProfile{0.5, 0.0});
  request.ground = 0.5;
  request.mu = {0.4};
  request.paths = 3000;
  Spread reflected, transmitted, radiance;
  for (request.seed = 1; request.seed <= 256; ++request.seed) {
    const SlabResult result = solve_slab(request);
    reflected.add(result.reflectance, 1);
    transmitted.add(result.transmittance_diffuse, 1);
    radiance.add(result.reflection[0], 1);
  }
  reflected.expect_as_said("R");
  transmitted.expect_as_said("T");
  radiance.expect_as_said("R(mu)");
}

/// No slab is too thick, too narrow in scattering or too black for the promised error.
TEST(SlabTruth, ThickNarrowAndBlackSlabsKeepTheErrorOfAMillionPaths) {
  struct Case {
    double g, albedo, tau;
  };
  for (const Case& c : {Case{0.9, 1.0, 100.0}, Case{0.95, 0.999, 64.0}, Case{0.99, 0.5, 10.0}, Case{-0.9, 1.0, 64.0}}) {
    SlabRequest request = slab_of(HenyeyGreenstein<double>{c.g}, c.albedo, c.tau);
    const SlabResult result = solve_slab(request);
    EXPECT_LE(result.reflectance.standard_error[0], 5e-4) << c.g << " " << c.tau;
    EXPECT_LE(result.transmittance_diffuse.standard_error[0], 5e-4) << c.g << " " << c.tau;
    const double left = result.reflectance.mean[0] + result.transmittance_diffuse.mean[0];
    if (c.albedo == 1.0) {
      EXPECT_NEAR(left, 1.0, 1e-9) << c.g;
    } else {
      EXPECT_GT(left, 0.0) << c.g;
      EXPECT_LT(left, c.g > 0.98 ? 0.02 : 0.9) << c.g;
    }
  }
}

TEST(Slab, OnePathKnowsNoError) {
  SlabRequest request = slab_of(Isotropic<double>{}, 0.9, 1.0);
  request.paths = 1;
  EXPECT_TRUE(std::isinf(solve_slab(request).reflectance.standard_error[0]));
}

/// Every channel is a walk of its own, so colour costs no channel its accuracy.
TEST(Slab, AChannelIsTheGreySlabOfItsCoefficientsBitByBit) {
  SlabRequest request;
  request.medium = chromatic_mixture();
  request.mu = {0.7};
  request.ground = 0.2;
  request.paths = 20000;
  const SlabResult all = solve_slab(request);
  for (std::size_t c = 0; c < channel_count; ++c) {
    SlabRequest grey = request;
    for (Species& s : grey.medium.species) {
      s.scattering = Spectrum::grey(s.scattering[c]);
      s.absorption = Spectrum::grey(s.absorption[c]);
    }
    const SlabResult one = solve_slab(grey);
    for (std::size_t other = 0; other < channel_count; ++other) {
      EXPECT_EQ(one.reflectance.mean[other], all.reflectance.mean[c]);
      EXPECT_EQ(one.transmittance_diffuse.standard_error[other], all.transmittance_diffuse.standard_error[c]);
      EXPECT_EQ(one.reflection[0].mean[other], all.reflection[0].mean[c]);
    }
  }
}

/// The flux is R = 2 int R(mu) mu dmu. One of the exit angles is the beam's own, where the integral along a flight has
/// a removable singularity.
TEST(SlabTruth, RadianceAddsUpToFlux) {
  // Gauss-Legendre nodes and weights on [0, 1] for 8 points (Abramowitz and Stegun 25.4.30).
  constexpr double node[] = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267, 0.9602898564975363};
  constexpr double weight[] = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745, 0.1012285362903763};
  for (const double g : {0.0, 0.5, -0.6}) {
    SlabRequest request = slab_of(HenyeyGreenstein<double>{g}, 0.99, 12.0);
    request.mu0 = 0.5 * (1.0 + node[1]);
    for (int i = 0; i < 4; ++i) {
      request.mu.push_back(0.5 * (1.0 - node[i]));
      request.mu.push_back(0.5 * (1.0 + node[i]));
    }
    const SlabResult result = solve_slab(request);
    double up = 0.0, down = 0.0;
    for (std::size_t m = 0; m < 8; ++m) {
      up += weight[m / 2] * request.mu[m] * result.reflection[m].mean[0];
      down += weight[m / 2] * request.mu[m] * result.transmission[m].mean[0];
    }
    EXPECT_NEAR(up, result.reflectance.mean[0], 5.0 * result.reflectance.standard_error[0] + 1e-4) << g;
    EXPECT_NEAR(down, result.transmittance_diffuse.mean[0], 5.0 * result.transmittance_diffuse.standard_error[0] + 1e-4)
        << g;
  }
}

/// The SIMD kernel and the path-by-path tracer share no transport code: a chromatic mixture in equal layers must agree.
/// And density that varies with depth only changes nothing at equal total depth.
TEST(Slab, DensityThatVariesWithHeightActsByItsTotalDepth) {
  SlabRequest even, layered;
  even.medium = layered.medium = chromatic_mixture();
  const double height = 0.4, column = height * (1.0 - std::exp(-1.0 / height));
  for (Species& s : layered.medium.species) {
    s.scattering *= 1.0 / column;
    s.absorption *= 1.0 / column;
    s.profiles.push_back(ExponentialProfile{height, 0.0});
  }
  even.mu = layered.mu = {0.2, 0.9};
  even.ground = layered.ground = 0.3;
  even.mu0 = layered.mu0 = 0.6;
  even.paths = layered.paths = 150000;
  const SlabResult a = solve_slab(even), b = solve_slab(layered);
  expect_same(a.reflectance, b.reflectance, "R");
  expect_same(a.transmittance_diffuse, b.transmittance_diffuse, "T");
  for (std::size_t m = 0; m < 2; ++m) {
    expect_same(a.reflection[m], b.reflection[m], "R(mu)");
    expect_same(a.transmission[m], b.transmission[m], "T(mu)");
  }
  for (std::size_t c = 0; c < channel_count; ++c)
    EXPECT_NEAR(a.transmittance_direct[c], b.transmittance_direct[c], 1e-12);
}

TEST(Slab, EveryInstructionSetGivesTheSameStatistics) {
  SlabRequest request;
  request.medium = chromatic_mixture();
  request.mu = {0.3};
  request.paths = 65536;
  request.diffuse = true;
  request.ground = 0.2;
  request.instruction_set = InstructionSet::baseline;
  const SlabResult baseline = solve_slab(request);
  for (const InstructionSet set : {InstructionSet::avx2, InstructionSet::avx512}) {
    if (set > best_instruction_set()) continue;
    request.instruction_set = set;
    const SlabResult result = solve_slab(request);
    // The same random numbers: only rounding tells them apart, and now and then a path that it sends elsewhere.
    EXPECT_NEAR(result.reflectance.mean[0], baseline.reflectance.mean[0], 0.1 * baseline.reflectance.standard_error[0]);
    expect_same(result.reflection[0], baseline.reflection[0], "R(mu)");
  }
}

TEST(Slab, BitsDoNotDependOnThreads) {
  SlabRequest request;
  request.medium = chromatic_mixture();
  request.paths = 50000;
  request.threads = 1;
  const SlabResult one = solve_slab(request);
  for (const int threads : {2, 3, 7}) {
    request.threads = threads;
    const SlabResult many = solve_slab(request);
    EXPECT_EQ(one.reflectance.mean, many.reflectance.mean);
    EXPECT_EQ(one.transmittance_diffuse.standard_error, many.transmittance_diffuse.standard_error);
  }
}

TEST(Slab, UnitsDoNotMatterOnlyDepthDoes) {
  SlabRequest request = slab_of(MieHazy<double>{}, 0.9, 2.0);
  request.paths = 20000;
  const SlabResult one = solve_slab(request);
  for (Species& s : request.medium.species) s.scattering *= 1e-6, s.absorption *= 1e-6;
  request.thickness = 1e6;
  const SlabResult thin = solve_slab(request);
  EXPECT_NEAR(one.reflectance.mean[0], thin.reflectance.mean[0], 1e-5);
}

TEST(Slab, AnEmptySlabPassesEverything) {
  SlabRequest request;
  request.paths = 1000;
  const SlabResult result = solve_slab(request);
  EXPECT_EQ(result.reflectance.mean[0], 0.0);
  EXPECT_EQ(result.transmittance_direct[0], 1.0);
}

TEST(Slab, ObjectsToWhatHasNoAnswer) {
  SlabRequest request = slab_of(Isotropic<double>{}, 1.0, 1.0);
  EXPECT_FALSE(slab_objection(request));
  request.thickness = infinity;
  ASSERT_TRUE(slab_objection(request));
  EXPECT_EQ(slab_objection(request)->field, "thickness");
  request = slab_of(Isotropic<double>{}, 0.5, 1.0);
  request.medium.species[0].profiles.push_back(SphereProfile{});
  ASSERT_TRUE(slab_objection(request));
  EXPECT_EQ(slab_objection(request)->field, "medium");
}

}  // namespace
}  // namespace tyndall
