// Noise: its mean, its bounds, its smoothness, and rays through too much of it.
#include <gtest/gtest.h>

#include <chrono>

#include "tyndall/medium/free_flight.h"
#include "tyndall/sampling/random_stream.h"

namespace tyndall {
namespace {

Species noisy(const NoiseProfile& noise, std::vector<Profile> more = {}, double extinction = 1.0) {
  Species s;
  s.scattering = Spectrum::grey(extinction);
  s.profiles = std::move(more);
  s.profiles.push_back(noise);
  return s;
}

TEST(Noise, HasMeanOneAndKeepsItsBounds) {
  // 1e6 points apart by some cells, so that nearly all are independent: the mean's deviation is 5 standard errors with
  // a chance of 6e-7 per case.
  RandomStream random(1, 0, 0);
  for (const double contrast : {0.25, 1.0}) {
    for (int octaves = 1; octaves <= most_octaves; ++octaves) {
      double sum = 0.0, squares = 0.0, low = 9.0, high = -9.0;
      constexpr int count = 1000000;
      for (int i = 0; i < count; ++i) {
        const Vector p{5e3 * random.next() - 2e3, 5e3 * random.next() - 2e3, 5e3 * random.next() - 2e3};
        const double x = noise_factor({1.5, octaves, contrast, 7 * octaves}, p);
        sum += x, squares += (x - 1.0) * (x - 1.0);
        low = std::min(low, x), high = std::max(high, x);
      }
      EXPECT_NEAR(sum / count, 1.0, 5.0 * std::sqrt(squares) / count) << octaves;
      EXPECT_GT(low, 1.0 - contrast);
      EXPECT_LT(high, 1.0 + contrast);
      EXPECT_GT(std::sqrt(squares / count), 0.2 * contrast) << "contrast is what it says";
    }
  }
}

TEST(Noise, LatticeValuesAreBalancedOverTheHash) {
  // The hash is a bijection: no two of the first 2^20 integers collide, and it is odd about its middle in value.
  std::vector<std::uint32_t> seen;
  for (std::uint32_t i = 0; i < (1u << 20); ++i) seen.push_back(scrambled(i * 4093u));
  std::sort(seen.begin(), seen.end());
  EXPECT_EQ(std::adjacent_find(seen.begin(), seen.end()), seen.end());
  double sum = 0.0;
  for (std::uint32_t i = 0; i < (1u << 20); ++i) sum += lattice_value(i, 12345u);
  EXPECT_NEAR(sum / (1 << 20), 0.0, 5.0 * 0.7 / 1024.0);
}

TEST(Noise, IsTheSameOnEveryMachine) {
  // Of a second implementation, in Python; only integers and + - * / of doubles are behind it.
  EXPECT_EQ(scrambled(1u), 0x688990C0u);
  EXPECT_NEAR(noise_factor({2.0, 3, 0.8, 42}, {1.25, -7.5, 100.125}), 1.3207647222955097, 1e-15);
}

TEST(Noise, WithoutContrastIsExactlyConstant) {
  const Species still = noisy({3.0, 8, 0.0, 3, {1, 2, 3}});
  EXPECT_EQ(factor(still, {1.0, 2.0, 3.0}, 17.0), 1.0);
  const LoweredMedium lowered = lower(Medium{{still}}, 17.0);
  EXPECT_TRUE(lowered.species[0].is_constant());
}

TEST(Noise, IsSmooth) {
  // Value and gradient are continuous across the planes of all octaves: one-sided differences agree.
  RandomStream random(3, 0, 0);
  const NoiseSettings noise{1.0, 4, 1.0, 9};
  for (int i = 0; i < 3000; ++i) {
    const double plane = std::floor(8.0 * random.next()) / 8.0, h = 1e-6;
    const Vector p{plane, 20.0 * random.next(), 20.0 * random.next()}, x{h, 0, 0};
    const double here = noise_factor(noise, p);
    const double after = (noise_factor(noise, p + x) - here) / h, before = (here - noise_factor(noise, p - x)) / h;
    ASSERT_NEAR(after, before, 1e-3);
  }
}

TEST(Noise, WindCarriesIt) {
  RandomStream random(4, 0, 0);
  const NoiseProfile noise{3.0, 4, 0.7, 1, {2.0, -0.5, 0.25}};
  std::vector<Stretch> stretches;
  for (int i = 0; i < 200; ++i) {
    const Vector p{30.0 * random.next(), 30.0 * random.next(), 30.0 * random.next()};
    const double time = 100.0 * random.next();
    EXPECT_EQ(factor(noise, p, time), factor(noise, p - noise.wind * time));
    const LoweredMedium late = lower(Medium{{noisy(noise)}}, time), early = lower(Medium{{noisy(noise)}});
    const Ray ray{p, normalized({1.0, random.next(), random.next()})};
    const double blown = -std::log(transmittance(late, ray, 20.0, stretches)[0]);
    const Ray back{p - noise.wind * time, ray.direction};
    EXPECT_NEAR(blown, -std::log(transmittance(early, back, 20.0, stretches)[0]), 1e-10);
  }
}

TEST(Noise, DependsOnItsSeed) {
  RandomStream random(5, 0, 0);
  double together = 0.0;
  for (int i = 0; i < 20000; ++i) {
    const Vector p{1e3 * random.next(), 1e3 * random.next(), 1e3 * random.next()};
    together += (noise_factor({1.0, 2, 1.0, 1}, p) - 1.0) * (noise_factor({1.0, 2, 1.0, 2}, p) - 1.0);
  }
  EXPECT_NEAR(together / 20000.0, 0.0, 5.0 * 0.1 / std::sqrt(20000.0));
}

TEST(Noise, FarAwayCountsAsItsMeanWithinTheStatedError) {
  // Rays through 10 to 4e4 of the finest cells against a dense midpoint rule. The stated standard deviation is at most
  // 0.017 contrast; 3.5 of them.
  RandomStream random(6, 0, 0);
  std::vector<Stretch> stretches;
  double worst = 0.0;
  for (int i = 0; i < 60; ++i) {
    const NoiseProfile noise{1.0, 1 + i % 4, 1.0, i, {}};
    const Vector d = normalized({random.next() - 0.5, random.next() - 0.5, random.next() - 0.5});
    const Ray ray{{10.0 * random.next(), 3.0, -20.0 * random.next()}, d};
    const double end = std::pow(10.0, 1.0 + 2.5 * random.next());
    const Species species = noisy(noise, {}, 1e-6);
    const LoweredMedium lowered = lower(Medium{{species}});
    stretches_along(lowered, ray, end, stretches);
    const int count = static_cast<int>(end * 60.0);
    double sum = 0.0;
    for (int k = 0; k < count; ++k) sum += factor(species, ray.at(end * (k + 0.5) / count));
    const double wanted = 1e-6 * sum / count * end, found = optical_depth(stretches, end)[0];
    worst = std::max(worst, std::fabs(found / wanted - 1.0));
    ASSERT_NEAR(found, wanted, 0.06 * wanted) << end;
  }
  RecordProperty("worst", std::to_string(worst));
}

TEST(Noise, NoRayTakesMoreThanItsShare) {
  std::vector<Stretch> stretches;
  const auto began = std::chrono::steady_clock::now();
  for (const double scale : {1e-30, 1e-300, 1e-9, 1e-3, 1.0, 1e9, 1e30, 1e300}) {
    for (const Ray& ray : {Ray{{0, 0, 0}, {1, 0, 0}}, Ray{{1e9, -1e9, 3.0}, normalized({1, 2, 3})},
                           Ray{{0.5, 1e9, 0}, normalized({1e-9, -1, 1e-3})}}) {
      for (const double end : {1e-3, 1.0, 1e9, infinity}) {
        for (const std::vector<Profile>& more :
             {std::vector<Profile>{}, std::vector<Profile>{ExponentialProfile{1.0, 0.0}},
              std::vector<Profile>{ExponentialProfile{1e-30, 0.0}},
              std::vector<Profile>{SphereProfile{{0, 0, 0}, 1e-30, 1e-30}},
              std::vector<Profile>{BoxProfile{{-1e9, -1e9, -1e9}, {2e9, 2e9, 2e9}, 1e-30}}}) {
          const LoweredMedium lowered = lower(Medium{{noisy({scale, 8, 1.0, 0, {}}, more, 1e-12)}});
          stretches_along(lowered, ray, end, stretches);
          ASSERT_LE(stretches.size(), 8000u);
          const double depth = optical_depth(stretches, end)[0];
          ASSERT_FALSE(std::isnan(depth)) << scale << ' ' << end;
          ASSERT_GE(depth, 0.0);
          const double t = distance_at_depth(stretches, 0, 1e-7, end);
          ASSERT_FALSE(std::isnan(t));
        }
      }
    }
  }
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began;
  EXPECT_LT(took.count(), 30.0);  // 480 rays: 2 ms each is ten times what was measured
}

}  // namespace
}  // namespace tyndall
