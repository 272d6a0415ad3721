#include <gtest/gtest.h>

#include <random>

#include "tyndall/geometry/shape.h"

namespace tyndall {
namespace {

/// Seeded numbers in [0, 1), without the sampling folder, which stands on this one.
struct Numbers {
  std::mt19937_64 engine;
  explicit Numbers(unsigned seed) : engine(seed) {}
  double next() { return static_cast<double>(engine() >> 11) * 0x1p-53; }
  Vector direction() {
    for (;;) {
      const Vector v{2.0 * next() - 1.0, 2.0 * next() - 1.0, 2.0 * next() - 1.0};
      if (const double l = length(v); l > 0.01 && l < 1.0) return v / l;
    }
  }
};

TEST(Frame, IsOrthonormalAndRightHandedForEveryNormal) {
  Numbers random(1);
  for (int i = 0; i < 10000; ++i) {
    Vector n = random.direction();
    if (i == 0) n = {0.0, 0.0, 1.0};
    if (i == 1) n = {0.0, 0.0, -1.0};
    const Frame f = Frame::around(n);
    EXPECT_NEAR(length(f.tangent), 1.0, 1e-14);
    EXPECT_NEAR(dot(f.tangent, f.normal), 0.0, 1e-14);
    EXPECT_NEAR(length(cross(f.tangent, f.bitangent) - f.normal), 0.0, 1e-14);
    const Vector v = random.direction();
    EXPECT_NEAR(length(f.to_world(f.to_local(v)) - v), 0.0, 1e-14);
  }
}

/// Every point of the ray is inside exactly within the interval, apart from a hair at its ends.
template <class Shape>
void check_inside(const Shape& shape, const Ray& ray) {
  const Interval t = inside(shape, ray);
  for (int i = 0; i <= 400; ++i) {
    const double s = i * 0.02;
    if (std::fabs(s - t.begin) < 1e-9 || std::fabs(s - t.end) < 1e-9) continue;
    EXPECT_EQ(contains(shape, ray.at(s)), s > t.begin && s < t.end) << s << " in " << t.begin << " " << t.end;
  }
}

TEST(Shape, IntervalsHoldExactlyThePointsInside) {
  Numbers random(2);
  for (int i = 0; i < 500; ++i) {
    const auto at = [&] { return 4.0 * random.next() - 2.0; };
    const Ray ray{{at(), at(), at()}, random.direction()};
    const Vector low{at(), at(), at()};
    check_inside(Box{low, low + Vector{2.0 * random.next(), 2.0 * random.next(), 2.0 * random.next()}}, ray);
    check_inside(Sphere{{at(), at(), at()}, 2.0 * random.next()}, ray);
  }
}

TEST(Shape, RaysParallelToABoxAreInsideBetweenItsPlanes) {
  const Box box{{-1, -1, -1}, {1, 1, 1}};
  const Interval through = inside(box, {{-5, 0.5, 0.5}, {1, 0, 0}});
  EXPECT_DOUBLE_EQ(through.begin, 4.0);
  EXPECT_DOUBLE_EQ(through.end, 6.0);
  EXPECT_TRUE(inside(box, {{-5, 1.5, 0.0}, {1, 0, 0}}).empty());
  EXPECT_TRUE(inside(box, {{5, 0, 0}, {1, 0, 0}}).empty()) << "behind the ray";
}

TEST(Shape, AFarSphereKeepsItsDigits) {
  const Interval t = inside(Sphere{{1e8, 0.5, 0}, 1.0}, {{0, 0, 0}, {1, 0, 0}});
  EXPECT_NEAR(t.end - t.begin, std::sqrt(3.0), 1e-7);
}

}  // namespace
}  // namespace tyndall
