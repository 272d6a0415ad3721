// Shadows in `single`: edges that are known, and random scenes against marching.
#include "tyndall/render/single.h"

#include <gtest/gtest.h>

#include "tyndall/medium/scatter.h"
#include "tyndall/render/single_truth.h"
#include "tyndall/render/test_scenes.h"
#include "tyndall/sampling/random_stream.h"

namespace tyndall {
namespace {

using tests::add_quad;
using tests::medium_of;
using tests::pi_number;
using tests::probe;

/// A probe behind an occluder of known edges equals the sum of its lit intervals.
TEST(Single, ShadowEdgesAreExact) {
  for (const Law<double>& law : {Law<double>{MieHazy<double>{}}, Law<double>{HenyeyGreenstein<double>{0.7}}}) {
    Scene open;
    open.medium = medium_of(Spectrum::grey(0.2), Spectrum::grey(0.05), law);
    open.points.push_back({{6, 4, 0}, Spectrum::grey(1.0)});
    Scene scene = open;
    // At half the lamp's height, x from 4.5 to 5.25: shadow from 3 to 4.5 on the ray. A sliver 1/128 wide: 1/64.
    add_quad(scene, {4.5, 2, 3}, {0.75, 0, 0}, {0, 0, -6});
    add_quad(scene, {7, 2, 3}, {0.0078125, 0, 0}, {0, 0, -6});
    const Ray ray{{0, 0, 0}, {1, 0, 0}};
    const Geometry no_surfaces(open);
    const SingleContext clear(open, no_surfaces);
    const auto lit = [&](double a, double b) {
      return single_radiance(clear, ray, b).single[0] - single_radiance(clear, ray, a).single[0];
    };
    const double truth = lit(0.0, 3.0) + lit(4.5, 8.0) + lit(8.015625, 10.0);
    EXPECT_NEAR(probe(scene, ray, 10.0).single[0] / truth, 1.0, 1e-9);
    // From all sides alike, and for a ray that has no end.
    EXPECT_LT(probe(scene, ray).single[0], probe(open, ray).single[0]);
    const double between = probe(scene, ray, 4.5).single[0];
    EXPECT_NEAR(between / probe(scene, ray, 3.0).single[0], 1.0, 1e-12) << "nothing is added in the shadow";
  }
}

/// 1000 scenes of random species, shapes, occluders and lights against marching with shadow rays. Marching is as good
/// as the difference between 2000 and 8000 steps; four times that is allowed, and 2e-4.
TEST(Single, RandomScenesAgreeWithMarching) {
  int lit_count = 0;
  for (std::uint32_t number = 0; number < 1000; ++number) {
    RandomStream random(4, number, 0);
    const auto between = [&](double low, double high) { return low + (high - low) * random.next(); };
    const auto vector = [&](double size) {
      const double x = between(-size, size), y = between(-size, size);
      return Vector{x, y, between(-size, size)};
    };
    Scene scene;
    const int species_count = 1 + static_cast<int>(random.next() * 4);
    for (int i = 0; i < species_count; ++i) {
      const Law<double> laws[] = {Isotropic<double>{}, Rayleigh<double>{}, MieHazy<double>{}, MieMurky<double>{},
                                  HenyeyGreenstein<double>{between(-0.9, 0.95)}};
      std::vector<Profile> profiles;
      if (random.next() < 0.5) profiles.push_back(ExponentialProfile{std::exp(between(0.0, 3.5)), between(-3.0, 3.0)});
      if (random.next() < 0.5) {
        const Vector a = vector(4), b = vector(4);
        profiles.push_back(BoxProfile{{std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)},
                                      {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}});
      }
      if (random.next() < 0.5) profiles.push_back(SphereProfile{vector(4), between(0.3, 3.0)});
      const double dense = std::exp(between(-7.0, 1.0));
      const auto law = static_cast<std::size_t>(random.next() * 5);
      scene.medium.species.push_back(
          medium_of(Spectrum::grey(dense), Spectrum::grey(dense * random.next()), laws[law], profiles).species[0]);
    }
    const int quads = static_cast<int>(random.next() * 30);
    for (int i = 0; i < quads; ++i) {
      const Vector corner = vector(5), u = vector(2);
      add_quad(scene, corner, u, vector(2));
    }
    const int kind = static_cast<int>(random.next() * 3);
    SpotLight spot{vector(5), vector(1), Spectrum::grey(1.0), 0.0, between(3.0, 89.0)};
    spot.inner_angle = random.next() < 0.4 ? spot.outer_angle : spot.outer_angle * random.next();
    if (kind == 0) scene.points.push_back({spot.position, spot.intensity});
    if (kind == 1) scene.spots.push_back(spot);
    if (kind == 2) scene.suns.push_back({spot.direction, Spectrum::grey(1.0), 0.0});
    const Geometry geometry(scene);
    const SingleContext context(scene, geometry);
    const LoweredMedium medium = lower(scene.medium);
    const Vector origin = vector(5);
    const Ray ray{origin, normalized(vector(1))};
    const double distance = between(1.0, 12.0);
    const auto hit = geometry.intersect(ray, distance);
    const double end = hit ? hit->t : distance;
    std::vector<Stretch> along, shadow;
    stretches_along(medium, ray, end, along);
    ScatterPoint scatter;
    const auto march = [&](int steps) {
      double sum = 0.0;
      for (int i = 0; i < steps; ++i) {
        const double t = end * (i + 0.5) / steps;
        const Vector point = ray.at(t), way = spot.position - point;
        const double far = kind == 2 ? infinity : length(way);
        const Vector toward = kind == 2 ? -normalized(spot.direction) : way / far;
        double light = kind == 2 ? 1.0 : 1.0 / (far * far);
        if (kind == 1) light *= spot_falloff(spot, dot(-toward, normalized(spot.direction)));
        scatter.set(medium, along, t);
        if (light == 0.0 || is_zero(scatter.scattering()) || geometry.occluded(Ray{point, toward}, far)) continue;
        sum += light * scatter.scattered(deflection_between(-toward, -ray.direction))[1] * transmittance(along, t)[1] *
               transmittance(medium, {point, toward}, far, shadow)[1];
      }
      return sum * end / steps;
    };
    const double value = single_radiance(context, ray, distance).single[1], rough = march(2000), fine = march(8000);
    EXPECT_NEAR(value, fine, 4.0 * std::fabs(fine - rough) + 2e-4 * fine + 1e-12) << "scene " << number;
    if (value > 0.0) ++lit_count;
  }
  EXPECT_GT(lit_count, 200);
}

TEST(Single, AClosedMeshThrowsAClosedShadow) {
  // A sphere of 2 x 40 x 40 triangles: the shadow is that of the circle its cut is, without light through seams.
  Scene scene;
  scene.medium = medium_of(Spectrum::grey(0.1), {}, Isotropic<double>{});
  scene.points.push_back({{0, 4, 0.013}, Spectrum::grey(1.0)});
  const Scene open = scene;
  Mesh ball;
  constexpr int n = 40;
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j < 2 * n; ++j) {
      const double polar = pi_number * i / n, azimuth = pi_number * j / n;
      ball.positions.push_back({static_cast<float>(0.5 * std::sin(polar) * std::cos(azimuth)),
                                static_cast<float>(2.0 + 0.5 * std::cos(polar)),
                                static_cast<float>(0.5 * std::sin(polar) * std::sin(azimuth))});
    }
  }
  for (unsigned i = 0; i < n; ++i) {
    for (unsigned j = 0; j < 2 * n; ++j) {
      const unsigned a = i * 2 * n + j, b = i * 2 * n + (j + 1) % (2 * n), c = a + 2 * n, d = b + 2 * n;
      ball.triangles.push_back({a, b, c});
      ball.triangles.push_back({b, d, c});
    }
  }
  scene.meshes.push_back(ball);
  const Ray ray{{-5, 0, 0}, {1, 0, 0}};
  const double blocked = probe(open, ray, 10.0).single[0] - probe(scene, ray, 10.0).single[0];
  // Tangents from the lamp to a circle of radius 0.5 at distance 2: half the shadow is 4 tan(asin(1/4)).
  const double half = 4.0 * std::tan(std::asin(0.25));
  const double truth = probe(open, ray, 5.0 + half).single[0] - probe(open, ray, 5.0 - half).single[0];
  EXPECT_NEAR(blocked / truth, 1.0, 0.01);
  // Dark all the way through: no seam lets light pass.
  const double inside = probe(scene, ray, 5.0 + 0.9 * half).single[0],
               before = probe(scene, ray, 5.0 - 0.9 * half).single[0];
  EXPECT_NEAR(inside / before, 1.0, 1e-12);
}

}  // namespace
}  // namespace tyndall
