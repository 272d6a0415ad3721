#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <vector>

#include "tyndall/sampling/direction.h"
#include "tyndall/sampling/random_stream.h"
#include "tyndall/sampling/square_tree.h"

namespace tyndall {
namespace {

TEST(Philox, GivesThePublishedAnswers) {
  // Known answers of philox4x32-10, Salmon et al. 2011 (Random123, kat_vectors).
  using Words = std::array<std::uint32_t, 4>;
  EXPECT_EQ(philox({0, 0, 0, 0}, {0, 0}), (Words{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  EXPECT_EQ(philox({~0u, ~0u, ~0u, ~0u}, {~0u, ~0u}), (Words{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(philox({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
            (Words{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(RandomStream, NumbersStayInsideTheOpenUnitInterval) {
  EXPECT_GT(unit_real(0), 0.0);
  EXPECT_LT(unit_real(~0u), 1.0);
  EXPECT_GT(1.0 - unit_real(~0u), 0.0);
}

TEST(RandomStream, PixelsSamplesAndSeedsHaveTheirOwnNumbers) {
  const double first = RandomStream(1, 2, 3).next();
  EXPECT_EQ(first, RandomStream(1, 2, 3).next());
  EXPECT_NE(first, RandomStream(2, 2, 3).next());
  EXPECT_NE(first, RandomStream(1, 3, 3).next());
  EXPECT_NE(first, RandomStream(1, 2, 4).next());
  EXPECT_NE(first, RandomStream(1, 2 + (std::uint64_t{1} << 32), 3).next());
}

TEST(RandomStream, EvenSamplesFillCellsOfEqualArea) {
  for (std::uint64_t pixel : {0u, 1u, 77u}) {
    for (int branch : {0, 1}) {
      for (int k = 0; k <= 8; ++k) {
        const int n = 1 << k;
        std::vector<std::vector<double>> samples;
        for (int i = 0; i < n; ++i) {
          RandomStream random(5, pixel, static_cast<std::uint32_t>(i), RandomStream::Samples::even);
          if (branch != 0) random.begin_branch(1);
          samples.emplace_back();
          for (std::uint32_t d = 0; d < RandomStream::even_dimensions; ++d) samples.back().push_back(random.next());
        }
        for (std::size_t d = 0; d < RandomStream::even_dimensions; d += 2) {
          for (int across = 0; across <= k; ++across) {  // cells of 2^across by 2^(k - across)
            std::vector<int> count(static_cast<std::size_t>(n));
            for (const auto& s : samples) {
              const int x = static_cast<int>(s[d] * (1 << across)),
                        y = static_cast<int>(s[d + 1] * (1 << (k - across)));
              ++count[static_cast<std::size_t>(x) + (static_cast<std::size_t>(y) << across)];
            }
            ASSERT_EQ(std::count(count.begin(), count.end(), 1), n) << "dimension " << d << ", 2^" << k << " samples";
          }
        }
      }
    }
  }
}

/// Over pixels, each even sample is as random as an independent one, and pairs of dimensions know nothing of each
/// other.
TEST(RandomStream, EvenSamplesAreUniformAndUncorrelated) {
  constexpr int pixels = 20000, dimensions = 8, cells = 16;
  for (std::uint32_t sample : {0u, 1u, 5u}) {
    std::vector<std::array<double, dimensions>> values(pixels);
    for (int p = 0; p < pixels; ++p) {
      RandomStream random(9, static_cast<std::uint64_t>(p), sample, RandomStream::Samples::even);
      for (double& x : values[static_cast<std::size_t>(p)]) x = random.next();
    }
    for (std::size_t a = 0; a < dimensions; ++a) {
      std::array<int, cells> count{};
      for (const auto& v : values) ++count[static_cast<std::size_t>(v[a] * cells)];
      double chi_square = 0.0;
      constexpr double expected = static_cast<double>(pixels) / cells;
      for (int c : count) chi_square += std::pow(c - expected, 2) / expected;
      EXPECT_LT(chi_square, 50.0);  // 15 degrees of freedom: 1e-5
      for (std::size_t b = 0; b < a; ++b) {
        double product = 0.0;
        for (const auto& v : values) product += (v[a] - 0.5) * (v[b] - 0.5);
        EXPECT_LT(std::fabs(product / pixels * 12.0), 5.0 / std::sqrt(pixels)) << a << ' ' << b;
      }
    }
  }
}

TEST(RandomStream, AlignedDimensionsDoNotDependOnWhatWasUsedBefore) {
  for (auto samples : {RandomStream::Samples::independent, RandomStream::Samples::even}) {
    RandomStream straight(1, 2, 3, samples), jumping(1, 2, 3, samples);
    std::vector<double> all;
    for (int i = 0; i < 200; ++i) all.push_back(straight.next());
    EXPECT_EQ(jumping.next(), all[0]);
    jumping.align(4);
    EXPECT_EQ(jumping.next(), all[4]);
    EXPECT_EQ(jumping.next(), all[5]);
    jumping.align(32);
    jumping.align(32);  // there already
    EXPECT_EQ(jumping.next(), all[32]);
    jumping.align(160);
    EXPECT_EQ(jumping.next(), all[160]);
    jumping.begin_branch(1);
    const double first = jumping.next();
    EXPECT_EQ(std::count(all.begin(), all.end(), first), 0);
    jumping.begin_branch(1);  // goes on where it is: no number twice
    EXPECT_NE(jumping.next(), first);
  }
}

/// Mean of f over directions that have density p: the integral of f p. 5 sigma: false alarms below 1e-6 a check.
template <class Sample, class F>
void expect_mean(Sample sample, F f, double expected) {
  RandomStream random(7, 0, 0);
  double sum = 0.0, squares = 0.0;
  constexpr int n = 200000;
  for (int i = 0; i < n; ++i) {
    const double x = f(sample(random));
    sum += x;
    squares += x * x;
  }
  const double mean = sum / n, error = std::sqrt((squares / n - mean * mean) / n);
  EXPECT_NEAR(mean, expected, 5.0 * error);
}

TEST(Direction, SamplersHaveTheirMoments) {
  const Frame frame = Frame::around(normalized({1.0, 2.0, -0.5}));
  const auto cosine = [&](const Vector& d) { return dot(d, frame.normal); };
  const auto side = [&](const Vector& d) { return dot(d, frame.tangent) * dot(d, frame.tangent); };
  const auto sphere = [](RandomStream& r) {
    const double a = r.next();
    return sample_sphere(a, r.next());
  };
  expect_mean(sphere, cosine, 0.0);
  expect_mean(sphere, side, 1.0 / 3.0);
  const auto hemisphere = [&](RandomStream& r) {
    const double a = r.next();
    return sample_cosine(frame, a, r.next());
  };
  expect_mean(hemisphere, cosine, 2.0 / 3.0);
  expect_mean(hemisphere, side, 0.25);
  const auto cone = [&](RandomStream& r) {
    const double a = r.next();
    return sample_cone(frame, 0.1, a, r.next());
  };
  expect_mean(cone, cosine, 0.95);
}

/// What it samples has the density that it states, over the whole square, and more of it where points were.
TEST(SquareTree, SamplesByItsDensityWhichFollowsThePoints) {
  RandomStream random(11, 0, 0);
  std::vector<SquareTree::Point> points;
  for (int i = 0; i < 3000; ++i) {
    const double u = 0.3 + 0.02 * random.next();
    points.push_back({static_cast<float>(u), static_cast<float>(random.next()), 1.0F});
  }
  const SquareTree even, tree(points);
  EXPECT_EQ(even.density(0.2, 0.7), 1.0);
  EXPECT_EQ(tree.density(1.2, 0.7), 0.0);
  EXPECT_GT(tree.density(0.31, 0.5), 20.0);
  EXPECT_NEAR(tree.density(0.9, 0.9), SquareTree::even_share, 1e-12);
  // The mean of f / density is the integral of f, for f that tell every quarter apart.
  double area = 0.0, moment = 0.0, squares = 0.0;
  constexpr int n = 200000;
  for (int i = 0; i < n; ++i) {
    const double xi = random.next();
    const SquareTree::Sample at = tree.sample(xi, random.next());
    ASSERT_TRUE(at.u >= 0.0 && at.u <= 1.0 && at.v >= 0.0 && at.v <= 1.0);
    ASSERT_EQ(at.density, tree.density(at.u, at.v));
    area += 1.0 / at.density / n;
    const double f = (1.0 + at.u * at.u * at.v) / at.density;
    moment += f / n, squares += f * f / n;
  }
  const double error = std::sqrt((squares - moment * moment) / n);
  EXPECT_NEAR(moment, 1.0 + 1.0 / 6.0, 5.0 * error);
  EXPECT_NEAR(area, 1.0, 5.0 * error);
  EXPECT_LT(error, 0.02);
}

}  // namespace
}  // namespace tyndall
