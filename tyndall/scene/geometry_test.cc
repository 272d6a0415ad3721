#include "tyndall/scene/geometry.h"

#include <gtest/gtest.h>
#include <xmmintrin.h>

#include <cmath>
#include <numbers>
#include <random>
#include <thread>

namespace tyndall {
namespace {

using Point = std::array<float, 3>;

Mesh mesh_of(std::vector<Point> positions, std::vector<std::array<std::uint32_t, 3>> triangles) {
  Mesh mesh;
  mesh.positions = std::move(positions);
  mesh.triangles = std::move(triangles);
  return mesh;
}

/// A square of side 2 `half` around a point, front toward +Z, in two triangles.
Mesh square(const Vector& center, double half) {
  const auto at = [&](double x, double y) {
    return Point{static_cast<float>(center.x + x * half), static_cast<float>(center.y + y * half),
                 static_cast<float>(center.z)};
  };
  return mesh_of({at(-1, -1), at(1, -1), at(1, 1), at(-1, 1)}, {{0, 1, 2}, {0, 2, 3}});
}

/// A closed ball of triangles, fronts outward, with smooth normals.
Mesh ball(const Vector& center, double radius, std::uint32_t rings) {
  Mesh mesh;
  for (std::uint32_t i = 0; i <= rings; ++i) {
    for (std::uint32_t j = 0; j < 2 * rings; ++j) {
      const double polar = std::numbers::pi * i / rings, azimuth = std::numbers::pi * j / rings;
      const Vector n{std::sin(polar) * std::sin(azimuth), std::cos(polar), std::sin(polar) * std::cos(azimuth)};
      const Vector p = center + n * radius;
      mesh.positions.push_back({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
      mesh.normals.push_back({static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)});
    }
  }
  for (std::uint32_t i = 0; i < rings; ++i) {
    for (std::uint32_t j = 0; j < 2 * rings; ++j) {
      const std::uint32_t a = i * 2 * rings + j, b = i * 2 * rings + (j + 1) % (2 * rings), down = 2 * rings;
      mesh.triangles.push_back({a, a + down, b});
      mesh.triangles.push_back({b, a + down, b + down});
    }
  }
  return mesh;
}

Vector random_direction(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return normalized({normal(random), normal(random), normal(random)});
}

TEST(Geometry, EmptyScenesMeetNothing) {
  const Scene empty;
  const Geometry geometry(empty);
  EXPECT_FALSE(geometry.intersect({{0, 0, 0}, {0, 0, 1}}));
  EXPECT_FALSE(geometry.occluded(Ray{{0, 0, 0}, {0, 0, 1}}));
  EXPECT_FALSE(geometry.occluded(Vector{0, 0, 0}, Vector{1, 2, 3}));
  Scene hollow;
  hollow.meshes.push_back(Mesh{});
  hollow.meshes.push_back(square({0, 0, 0}, 1));
  EXPECT_EQ(Geometry(hollow).intersect({{0.1, 0, 5}, {0, 0, -1}})->at.mesh, 1U);
}

TEST(Geometry, HitsSayWhereAndWhatAndWhichSide) {
  Scene scene;
  scene.materials.push_back({});
  scene.materials.back().name = "paint";
  scene.meshes.push_back(square({0, 0, 0}, 1));
  scene.meshes.push_back(square({0, 0, -2}, 1));
  scene.meshes.back().material = 0;
  const Geometry geometry(scene);

  const auto front = geometry.intersect({{0.5, -0.25, 3}, {0, 0, -1}});
  ASSERT_TRUE(front);
  EXPECT_EQ(front->t, 3.0);
  EXPECT_EQ(front->point, (Vector{0.5, -0.25, 0}));
  EXPECT_EQ(front->geometric_normal, (Vector{0, 0, 1}));
  EXPECT_EQ(front->shading_normal, (Vector{0, 0, 1}));
  EXPECT_TRUE(front->front);
  EXPECT_EQ(front->at.mesh, 0U);
  EXPECT_EQ(front->at.triangle, 0U);
  EXPECT_EQ(front->material->metallic, 0.0);
  EXPECT_EQ(front->material->roughness, 1.0);
  const auto& t = scene.meshes[0].triangles[0];
  const auto& p = scene.meshes[0].positions;
  EXPECT_EQ((1 - front->at.u - front->at.v) * p[t[0]][0] + front->at.u * p[t[1]][0] + front->at.v * p[t[2]][0], 0.5);

  const auto back = geometry.intersect({{-0.5, 0.25, -7}, {0, 0, 1}});
  ASSERT_TRUE(back);
  EXPECT_EQ(back->t, 5.0);
  EXPECT_EQ(back->geometric_normal, (Vector{0, 0, -1}));
  EXPECT_FALSE(back->front);
  EXPECT_EQ(back->at.mesh, 1U);
  EXPECT_EQ(back->at.triangle, 1U);
  EXPECT_EQ(back->material->name, "paint");
}

TEST(Geometry, EndsAreExclusiveToTheLastDigit) {
  Scene scene;
  scene.meshes.push_back(square({0, 0, 0}, 1));
  const Geometry geometry(scene);
  const Ray ray{{0.1, 0.2, 1}, {0, 0, -1}};
  EXPECT_FALSE(geometry.intersect(ray, 1.0));
  EXPECT_TRUE(geometry.intersect(ray, std::nextafter(1.0, 2.0)));
  EXPECT_FALSE(geometry.occluded(ray, 1.0));
  EXPECT_TRUE(geometry.occluded(ray, std::nextafter(1.0, 2.0)));
  EXPECT_FALSE(geometry.intersect({{0.1, 0.2, 0}, {0, 0, -1}})) << "t = 0 does not count";
  EXPECT_TRUE(geometry.intersect({{0.1, 0.2, 1e-12}, {0, 0, -1}}));
  EXPECT_FALSE(geometry.intersect({{0.1, 0.2, -1e-12}, {0, 0, -1}}));
  EXPECT_FALSE(geometry.occluded(ray, 0.0));
}

TEST(Geometry, SegmentsIgnoreTheSurfacesTheyEndOn) {
  Scene scene;
  scene.meshes.push_back(square({0, 0, 0}, 1));
  scene.meshes.push_back(square({0, 0, 2}, 1));
  scene.meshes.push_back(square({0.5, 0, 1}, 0.5));
  const Geometry geometry(scene);
  EXPECT_FALSE(geometry.occluded(Vector{-0.5, 0.1, 0}, Vector{-0.4, 0, 2}));
  EXPECT_TRUE(geometry.occluded(Vector{0.5, 0.1, 0}, Vector{0.4, 0, 2}));
  EXPECT_TRUE(geometry.occluded(Vector{-0.5, 0.1, -0.001}, Vector{-0.4, 0, 2}));
  EXPECT_TRUE(geometry.occluded(Vector{-0.5, 0.1, 0}, Vector{-0.4, 0, 2.001}));
  EXPECT_FALSE(geometry.occluded(Vector{0.5, 0.1, 0}, Vector{0.5, 0.1, 0}));
  EXPECT_FALSE(geometry.occluded(Vector{-0.5, 0.1, 0}, Vector{0.7, 0.3, 0})) << "along a surface";
}

/// Shadow rays between random points of a curved, closed surface, and rays that leave it: the places where offsets
/// that are too small or too large show. A ball's inside is convex up to its facets.
void expect_no_self_shadow(const Vector& center, double radius) {
  SCOPED_TRACE(testing::Message() << "radius " << radius << " at " << center.x);
  Scene scene;
  scene.meshes.push_back(ball(center, radius, 24));
  const Geometry geometry(scene);
  std::mt19937 random(1);
  int inward_misses = 0, outward_hits = 0, chords_cut = 0;
  std::optional<Hit> before;
  constexpr int rays = 20000;
  for (int i = 0; i < rays; ++i) {
    const auto hit = geometry.intersect({center, random_direction(random)});
    if (!hit) {
      ++inward_misses;
      continue;
    }
    const Vector d = random_direction(random);
    const Vector inward = hit->geometric_normal;  // the ray came from inside
    const Vector out = dot(d, inward) < 0.0 ? d : -d;
    outward_hits += geometry.occluded(Ray{geometry.leave(hit->point, -inward), out});
    inward_misses += !geometry.occluded(Ray{geometry.leave(hit->point, inward), -out});
    if (before) chords_cut += geometry.occluded(before->point, hit->point);
    before = hit;
  }
  EXPECT_EQ(inward_misses, 0) << "light leaks out of a closed ball";
  EXPECT_EQ(outward_hits, 0) << "a convex surface shadows itself";
  EXPECT_EQ(chords_cut, 0) << "a chord of a convex ball is cut";
}

TEST(Geometry, SurfacesNeitherShadowThemselvesNorLeakAtAnyScale) {
  expect_no_self_shadow({0, 0, 0}, 1.0);
  expect_no_self_shadow({0, 0, 0}, 1e-6);
  expect_no_self_shadow({0, 0, 0}, 1e9);
}

TEST(Geometry, LeavingAtAGrazingAngleIsClean) {
  Scene scene;
  scene.meshes.push_back(square({3, -7, 11}, 1000));
  const Geometry geometry(scene);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(-900, 900);
  for (int i = 0; i < 20000; ++i) {
    const Vector from{uniform(random), uniform(random), 11 + std::fabs(uniform(random))};
    const Vector to{uniform(random), uniform(random), 11.0};
    const auto hit = geometry.intersect({from, normalized(to - from)});
    ASSERT_TRUE(hit);
    const double climb = std::exp(-0.03 * std::fabs(uniform(random)));  // down to 1e-12
    const Ray away{geometry.leave(hit->point, hit->geometric_normal), normalized({1, uniform(random) / 900, climb})};
    EXPECT_FALSE(geometry.occluded(away)) << climb;
  }
}

TEST(Geometry, FarCamerasSeeAsSharplyAsNearOnes) {
  Scene scene;
  scene.meshes.push_back(square({0, 0, 0}, 1));
  const Geometry geometry(scene);
  for (const double distance : {1e3, 1e6, 1e9}) {
    const auto hit = geometry.intersect({{0.3, 0.4, distance}, {0, 0, -1}});
    ASSERT_TRUE(hit) << distance;
    EXPECT_NEAR(hit->t, distance, 1e-15 * distance);
    EXPECT_NEAR(hit->point.x, 0.3, 1e-12);
    EXPECT_TRUE(geometry.intersect({{1 - 1e-6, 0, distance}, {0, 0, -1}})) << distance;
    EXPECT_FALSE(geometry.intersect({{1 + 1e-6, 0, distance}, {0, 0, -1}})) << distance;
  }
}

TEST(Geometry, HitsLieOnTheirTriangles) {
  Scene scene;
  scene.meshes.push_back(ball({100, 200, -300}, 2.0, 16));
  const Geometry geometry(scene);
  std::mt19937 random(3);
  for (int i = 0; i < 5000; ++i) {
    const Vector d = random_direction(random);
    const Ray ray{Vector{100, 200, -300} - d * 50.0, d};
    const auto hit = geometry.intersect(ray);
    ASSERT_TRUE(hit);
    EXPECT_TRUE(hit->front);
    EXPECT_LT(length(hit->point - ray.at(hit->t)), 1e-5);
    const auto& corner = scene.meshes[0].triangles[hit->at.triangle];
    const auto& a = scene.meshes[0].positions[corner[0]];
    EXPECT_NEAR(dot(hit->point - Vector{a[0], a[1], a[2]}, hit->geometric_normal), 0.0, 1e-12);
    EXPECT_GE(hit->at.u, 0.0);
    EXPECT_GE(hit->at.v, 0.0);
    EXPECT_LE(hit->at.u + hit->at.v, 1.0 + 1e-15);
    EXPECT_LT(dot(hit->shading_normal, d), 0.0);
    EXPECT_NEAR(length(hit->shading_normal), 1.0, 1e-12);
  }
}

TEST(Geometry, NearestOfManyIsFound) {
  std::mt19937 random(4);
  std::uniform_real_distribution<float> uniform(-1, 1);
  Scene scene;
  for (int m = 0; m < 3; ++m) {
    Mesh mesh;
    for (std::uint32_t i = 0; i < 100; ++i) {
      const Point center{uniform(random), uniform(random), uniform(random)};
      for (int c = 0; c < 3; ++c) {
        mesh.positions.push_back({center[0] + 0.2F * uniform(random), center[1] + 0.2F * uniform(random),
                                  center[2] + 0.2F * uniform(random)});
      }
      mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    scene.meshes.push_back(std::move(mesh));
  }
  const Geometry geometry(scene);
  int hits = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vector from = random_direction(random) * 3.0;
    const Ray ray{from, normalized(Vector{uniform(random), uniform(random), uniform(random)} - from)};
    // By hand: Moeller and Trumbore over all triangles, in double.
    double nearest = infinity;
    for (const Mesh& mesh : scene.meshes) {
      for (const auto& t : mesh.triangles) {
        const auto at = [&](std::size_t k) {
          const auto& p = mesh.positions[t[k]];
          return Vector{p[0], p[1], p[2]};
        };
        const Vector ab = at(1) - at(0), ac = at(2) - at(0), p = cross(ray.direction, ac), s = ray.origin - at(0);
        const double determinant = dot(ab, p), u = dot(s, p) / determinant;
        const Vector q = cross(s, ab);
        const double v = dot(ray.direction, q) / determinant, distance = dot(ac, q) / determinant;
        if (u >= 0 && v >= 0 && u + v <= 1 && distance > 0) nearest = std::min(nearest, distance);
      }
    }
    const auto hit = geometry.intersect(ray);
    ASSERT_EQ(hit.has_value(), nearest < infinity) << i;
    ASSERT_EQ(geometry.occluded(ray), hit.has_value());
    if (!hit) continue;
    ++hits;
    EXPECT_NEAR(hit->t, nearest, 1e-12);
  }
  EXPECT_GT(hits, 300);
}

TEST(Geometry, SmoothNormalsNeverFaceAwayFromTheRay) {
  Scene scene;
  Mesh mesh = square({0, 0, 0}, 1);
  mesh.normals = {{0.8F, 0, 0.6F}, {0.8F, 0, 0.6F}, {0.8F, 0, 0.6F}, {0.8F, 0, 0.6F}};
  scene.meshes.push_back(mesh);
  mesh.normals.assign(4, {0, 0, 0});
  for (auto& p : mesh.positions) p[2] = -1;
  scene.meshes.push_back(mesh);
  const Geometry geometry(scene);
  const auto straight = geometry.intersect({{0.2, 0.1, 1}, {0, 0, -1}});
  EXPECT_NEAR(straight->shading_normal.x, 0.8, 1e-6);
  EXPECT_NEAR(length(straight->shading_normal), 1.0, 1e-12);
  const auto from_behind_it = geometry.intersect({{-1.5, 0.1, 1}, normalized({1.7, 0, -1})});
  EXPECT_EQ(from_behind_it->shading_normal, (Vector{0, 0, 1}));
  const auto below = geometry.intersect({{0.2, 0.1, -0.5}, {0, 0, 1}});
  EXPECT_NEAR(below->shading_normal.x, -0.8, 1e-6);
  EXPECT_EQ(geometry.intersect({{0.2, 0.1, -0.5}, {0, 0, -1}})->shading_normal, (Vector{0, 0, 1})) << "zero normals";
}

TEST(Geometry, LeavesTheProgramsArithmeticAlone) {
  const unsigned int before = _mm_getcsr();
  Scene scene;
  scene.meshes.push_back(ball({0, 0, 0}, 1, 32));
  const Geometry geometry(scene);
  EXPECT_TRUE(geometry.intersect({{0, 0, 5}, {0, 0, -1}}));
  EXPECT_EQ(_mm_getcsr() & 0xffc0U, before & 0xffc0U);  // modes; the low bits are flags of what happened
  volatile double tiny = std::numeric_limits<double>::min();
  tiny = tiny / 4.0;
  EXPECT_GT(tiny, 0.0);
}

TEST(Geometry, AnswersAreTheSameFromManyThreads) {
  Scene scene;
  scene.meshes.push_back(ball({0, 0, 0}, 1, 32));
  const Geometry geometry(scene);
  const auto work = [&] {
    std::mt19937 random(5);
    double total = 0.0;
    for (int i = 0; i < 20000; ++i) {
      const auto hit = geometry.intersect({random_direction(random) * 2.0, random_direction(random)});
      if (hit) total += hit->t;
    }
    return total;
  };
  const double alone = work();
  std::array<double, 4> totals{};
  std::vector<std::thread> threads;
  for (double& total : totals) threads.emplace_back([&total, &work] { total = work(); });
  for (std::thread& thread : threads) thread.join();
  for (const double total : totals) EXPECT_EQ(total, alone);
}

}  // namespace
}  // namespace tyndall
