#include <gtest/gtest.h>

#include <numbers>

#include "tyndall/sampling/direction.h"
#include "tyndall/sampling/philox.h"

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

}  // namespace
}  // namespace tyndall
