#include "tyndall/medium/medium.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tyndall/medium/free_flight.h"
#include "tyndall/medium/scatter.h"
#include "tyndall/sampling/direction.h"
#include "tyndall/sampling/random_stream.h"

namespace tyndall {
namespace {

Species species_of(const Spectrum& scattering, const Spectrum& absorption, std::vector<Profile> profiles,
                   const Law<double>& phase = Isotropic<double>{}) {
  return {"", scattering, absorption, phase, std::move(profiles)};
}

/// A few species of all profiles, overlapping, for a seed.
Medium random_medium(RandomStream& random) {
  const auto coefficient = [&] { return Spectrum{{random.next(), random.next(), random.next()}}; };
  const auto at = [&] { return 4.0 * random.next() - 2.0; };
  Medium medium;
  medium.species.push_back(species_of(coefficient() * 0.1, coefficient() * 0.05, {}));
  medium.species.push_back(species_of(coefficient(), coefficient(), {ExponentialProfile{0.5 + random.next(), at()}}));
  const Vector low{at(), at(), at()};
  medium.species.push_back(species_of(coefficient(), {}, {BoxProfile{low, low + Vector{1.0, 2.0, 1.5}}}));
  medium.species.push_back(
      species_of(coefficient(), coefficient(), {SphereProfile{{at(), at(), at()}, 1.5}, ExponentialProfile{2.0, 0.0}}));
  return medium;
}

TEST(Medium, OpticalDepthIsTheIntegralOfExtinction) {
  RandomStream random(3, 0, 0);
  std::vector<Stretch> stretches;
  for (int i = 0; i < 50; ++i) {
    const Medium medium = random_medium(random);
    const LoweredMedium lowered = lower(medium);
    const Ray ray{{4.0 * random.next() - 2.0, random.next(), 0.0}, sample_sphere(random.next(), random.next())};
    stretches_along(lowered, ray, 6.0, stretches);
    Spectrum brute;
    constexpr int n = 20000;
    for (int k = 0; k < n; ++k) {
      const Vector p = ray.at((k + 0.5) * 6.0 / n);
      brute += (scattering_at(medium, p) + absorption_at(medium, p)) * (6.0 / n);
    }
    const Spectrum depth = optical_depth(stretches, 6.0);
    // The midpoint rule misses each box or sphere border by at most half a step of unit extinction.
    for (std::size_t c = 0; c < channel_count; ++c) EXPECT_NEAR(depth[c], brute[c], 5e-3 * brute[c]);
    const Spectrum here = extinction_at(stretches, 2.5);
    const Spectrum there = scattering_at(medium, ray.at(2.5)) + absorption_at(medium, ray.at(2.5));
    for (std::size_t c = 0; c < channel_count; ++c) EXPECT_NEAR(here[c], there[c], 1e-12 * there[c]);
  }
}

TEST(Medium, ExponentialDepthHasItsClosedForm) {
  // Straight up from the base: sigma H (1 - e^(-d/H)), Bucholtz-style column; nearly level: sigma d without
  // cancellation.
  const LoweredMedium medium = lower(Medium{{species_of(Spectrum::grey(2.0), {}, {ExponentialProfile{3.0, 1.0}})}});
  std::vector<Stretch> stretches;
  stretches_along(medium, {{0, 1, 0}, {0, 1, 0}}, infinity, stretches);
  EXPECT_NEAR(optical_depth(stretches, 5.0)[0], 6.0 * (1.0 - std::exp(-5.0 / 3.0)), 1e-14);
  EXPECT_NEAR(optical_depth(stretches, infinity)[0], 6.0, 1e-14);
  const double rise = 1e-12;
  stretches_along(medium, {{0, 1, 0}, normalized({1, rise, 0})}, infinity, stretches);
  EXPECT_NEAR(optical_depth(stretches, 10.0)[0], 20.0 * (1.0 - 0.5 * rise * 10.0 / 3.0), 1e-13);
}

TEST(Medium, GroundFogIsSeenFromFarAbove) {
  // 2000 scale heights up the factor is 0 in double; the column below is sigma H all the same, and a depth is found in
  // it.
  const LoweredMedium medium = lower(Medium{{species_of(Spectrum::grey(0.5), {}, {ExponentialProfile{10.0, 0.0}})}});
  std::vector<Stretch> stretches;
  stretches_along(medium, {{0, 20000, 0}, {0, -1, 0}}, 20000.0, stretches);
  EXPECT_NEAR(optical_depth(stretches, 20000.0)[0], 5.0, 1e-9);
  EXPECT_NEAR(distance_at_depth(stretches, 0, 1.0, 20000.0), 20000.0 - 10.0 * std::log(5.0), 1e-8);
}

TEST(Medium, TwoExponentialsMultiplyToOne) {
  const LoweredMedium medium = lower(
      Medium{{species_of(Spectrum::grey(1.0), {}, {ExponentialProfile{2.0, 1.0}, ExponentialProfile{3.0, -1.0}})}});
  EXPECT_NEAR(medium.species[0].log_at_height(0.7), 0.3 / 2.0 - 1.7 / 3.0, 1e-15);
}

TEST(FreeFlight, DistanceAtDepthInvertsOpticalDepth) {
  RandomStream random(4, 0, 0);
  std::vector<Stretch> stretches;
  for (int i = 0; i < 2000; ++i) {
    const LoweredMedium medium = lower(random_medium(random));
    const Ray ray{{4.0 * random.next() - 2.0, random.next(), 0.0}, sample_sphere(random.next(), random.next())};
    const double end = i % 3 == 0 ? infinity : 5.0 * random.next();
    stretches_along(medium, ray, end, stretches);
    const auto channel = static_cast<std::size_t>(i % 3);
    const double depth = -std::log(random.next());
    const double t = distance_at_depth(stretches, channel, depth, end);
    if (t == infinity) {
      EXPECT_LE(optical_depth(stretches, end)[channel], depth * (1.0 + 1e-9));
    } else {
      EXPECT_NEAR(optical_depth(stretches, t)[channel], depth, 1e-12 * std::max(1.0, depth));
    }
  }
}

/// Both kinds of flight estimate int sigma_c T_c dt = 1 - T_c and passing T_c, per channel, whatever beta is. 5 sigma.
TEST(FreeFlight, WeightsAreUnbiasedForEveryChannel) {
  RandomStream random(5, 0, 0);
  std::vector<Stretch> stretches;
  for (int scene = 0; scene < 8; ++scene) {
    const LoweredMedium medium = lower(random_medium(random));
    const Ray ray{{-2.0, 0.5, 0.1}, sample_sphere(random.next(), random.next())};
    stretches_along(medium, ray, 4.0, stretches);
    const Spectrum through = transmittance(stretches, 4.0);
    const Spectrum beta{{1.0, 0.2, 0.01}};
    for (const bool forced : {false, true}) {
      Spectrum collided, squares, passed;
      constexpr int n = 40000;
      for (int i = 0; i < n; ++i) {
        const double xi = random.next();
        const Flight flight = sample_flight(stretches, beta, 4.0, forced, xi, random.next());
        if (flight.t == infinity) {
          passed += flight.weight;
          continue;
        }
        EXPECT_LE(sum(beta * flight.weight * extinction_at(stretches, flight.t)), sum(beta) * (1.0 + 1e-9))
            << "beta never grows";
        const Spectrum x = flight.weight * extinction_at(stretches, flight.t);
        collided += x;
        squares += x * x;
      }
      for (std::size_t c = 0; c < channel_count; ++c) {
        const double mean = collided[c] / n, error = std::sqrt((squares[c] / n - mean * mean) / n) + 1e-12;
        EXPECT_NEAR(mean, 1.0 - through[c], 5.0 * error) << "channel " << c << (forced ? " forced" : "");
        EXPECT_NEAR(passed[c] / n, forced ? 0.0 : through[c], 5.0 * error) << "channel " << c;
      }
    }
  }
}

TEST(Medium, AMixtureOfManyEqualPartsCostsOneLobe) {
  Mixture<double> mixture;
  for (int i = 0; i < 150000; ++i) mixture.parts.push_back({1.0, HenyeyGreenstein<double>{i % 3 == 0 ? -0.25 : 0.5}});
  const LoweredMedium medium = lower(Medium{{species_of(Spectrum::grey(1.0), {}, {}, mixture),
                                             species_of(Spectrum::grey(2.0), {}, {}, HenyeyGreenstein<double>{0.5})}});
  ASSERT_EQ(medium.lobes.size(), 3U) << "two of the mixture; species stay apart";
  EXPECT_NEAR(medium.lobes[0].weight, 1.0 / 3.0, 1e-11);
  EXPECT_NEAR(medium.lobes[1].weight, 2.0 / 3.0, 1e-11);
  EXPECT_EQ(medium.species[0].lobe_count, 2U);
  EXPECT_EQ(medium.species[1].first_lobe, 2U);
  EXPECT_EQ(medium.species[1].lobe_count, 1U);
}

TEST(FreeFlight, AChannelWithoutExtinctionPassesAndOthersStayBounded) {
  const LoweredMedium medium = lower(Medium{{species_of({{0.0, 1.0, 5.7}}, {}, {})}});
  std::vector<Stretch> stretches;
  stretches_along(medium, {{0, 0, 0}, {1, 0, 0}}, infinity, stretches);
  RandomStream random(6, 0, 0);
  for (int i = 0; i < 10000; ++i) {
    const double xi = random.next();
    const Flight flight = sample_flight(stretches, Spectrum::grey(1.0), infinity, false, xi, random.next());
    ASSERT_TRUE(is_finite(flight.weight));
    if (flight.t == infinity) {
      EXPECT_DOUBLE_EQ(flight.weight[0], 3.0);
      EXPECT_EQ(flight.weight[1], 0.0);
    }
  }
}

TEST(Scatter, AMixtureIsChromaticAndItsSamplesMatchEveryChannel) {
  // Bluish Rayleigh and reddish forward haze: mean cosines differ per channel, and weighted samples must give each. 5
  // sigma.
  Medium medium;
  medium.species.push_back(species_of({{1.0, 2.34, 5.7}}, {}, {}, Rayleigh<double>{}));
  medium.species.push_back(species_of({{3.0, 1.0, 0.2}}, {}, {}, HenyeyGreenstein<double>{0.9}));
  medium.species.push_back(species_of({{0.0, 0.5, 0.0}}, {}, {}, MieMurky<double>{}));
  const LoweredMedium lowered = lower(medium);
  std::vector<Stretch> stretches;
  stretches_along(lowered, {{0, 0, 0}, {0, 0, 1}}, 10.0, stretches);
  ScatterPoint point;
  point.set(lowered, stretches, 1.0);
  const Spectrum beta{{0.7, 0.1, 1.3}};
  point.aim(beta);
  RandomStream random(8, 0, 0);
  Spectrum sum_w, sum_mu, squares;
  constexpr int n = 400000;
  for (int i = 0; i < n; ++i) {
    const Deflection<double> d = point.sample(random.next());
    const Spectrum w = point.scattered(d) / point.scattering() / point.density(d);
    sum_w += w;
    sum_mu += w * d.mu;
    squares += w * w;
  }
  const Spectrum expected = mean_cosine_at(medium, {0, 0, 0});
  for (std::size_t c = 0; c < channel_count; ++c) {
    const double error = std::sqrt(squares[c] / n / n);
    EXPECT_NEAR(sum_w[c] / n, 1.0, 5.0 * error);
    EXPECT_NEAR(sum_mu[c] / n, expected[c], 5.0 * error);
  }
}

}  // namespace
}  // namespace tyndall
