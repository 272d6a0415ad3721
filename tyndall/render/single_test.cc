// The integrator `single` against published truth, hand-made integrals and quadratures of another make.
#include "tyndall/render/single.h"

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <numbers>

#include "tests/shared_folder.h"
#include "tyndall/medium/scatter.h"
#include "tyndall/render/bsdf.h"
#include "tyndall/render/camera.h"
#include "tyndall/render/test_scenes.h"
#include "tyndall/sampling/philox.h"

namespace tyndall {
namespace {

using nlohmann::json;
using tests::add_material;
using tests::add_quad;
using tests::medium_of;

constexpr double pi_number = std::numbers::pi;

PixelLayers probe(const Scene& scene, const Ray& ray, double distance = infinity) {
  const Geometry geometry(scene);
  return single_radiance(SingleContext(scene, geometry), ray, distance);
}

TEST(SingleTruth, AirlightOfPointAndSpotLightsToTenDigits) {
  TYNDALL_NEEDS_SHARED_FILE(truth, "acceptance/public.json");
  std::ifstream in(truth);
  const json all = json::parse(in);
  const std::vector<std::pair<std::string, Law<double>>> laws = {{"isotropic", Isotropic<double>{}},
                                                                 {"rayleigh", Rayleigh<double>{}},
                                                                 {"hg0.7", HenyeyGreenstein<double>{0.7}},
                                                                 {"hazy", MieHazy<double>{}},
                                                                 {"murky", MieMurky<double>{}}};
  int count = 0;
  for (const char* kind : {"airlight_point", "airlight_spot"}) {
    for (const json& item : all.at(kind).at("items")) {
      for (const auto& [name, law] : laws) {
        if (!item.contains(name)) continue;
        const double sigma = item["sigma_t"], albedo = item["albedo"];
        Scene scene;
        scene.medium = medium_of(Spectrum::grey(sigma * albedo), Spectrum::grey(sigma * (1.0 - albedo)), law);
        if (item.contains("spot_pos")) {
          const auto vector = [&](const char* key) { return Vector{item[key][0], item[key][1], item[key][2]}; };
          const double angle = item["half_angle_deg"];
          scene.spots.push_back({vector("spot_pos"), vector("spot_dir_unnormalised"),
                                 Spectrum::grey(item["intensity_W_per_sr"]), angle, angle});
        } else {
          scene.points.push_back({{item["a"], item["h"], 0}, Spectrum::grey(item["intensity"])});
        }
        const double value = probe(scene, {{0, 0, 0}, {1, 0, 0}}, item["d"]).single[0];
        EXPECT_NEAR(value / std::stod(item[name].get<std::string>()), 1.0, 1e-10) << kind << item["id"] << name;
        ++count;
      }
    }
  }
  EXPECT_GE(count, 10);
}

/// Adaptive Simpson with Richardson's correction: unlike anything that is tested.
double simpson(const std::function<double(double)>& f, double a, double b, double fa, double fm, double fb,
               double tolerance, int depth) {
  const double m = 0.5 * (a + b), f1 = f(0.5 * (a + m)), f2 = f(0.5 * (m + b));
  const double whole = (b - a) / 6.0 * (fa + 4.0 * fm + fb);
  const double halves = (b - a) / 12.0 * (fa + 4.0 * f1 + 2.0 * fm + 4.0 * f2 + fb);
  if (depth == 0 || std::fabs(halves - whole) <= 15.0 * tolerance) return halves + (halves - whole) / 15.0;
  return simpson(f, a, m, fa, f1, fm, 0.5 * tolerance, depth - 1) +
         simpson(f, m, b, fm, f2, fb, 0.5 * tolerance, depth - 1);
}
double integral(const std::function<double(double)>& f, double a, double b, double tolerance, int pieces = 64) {
  double sum = 0.0;
  for (int i = 0; i < pieces; ++i) {
    const double low = a + (b - a) * i / pieces, high = a + (b - a) * (i + 1) / pieces;
    sum += simpson(f, low, high, f(low), f(0.5 * (low + high)), f(high), tolerance / pieces, 40);
  }
  return sum;
}

/// Optical depth of one species' way from a to b: straight from its density at points, jumps found by bisection.
double depth_of(const Species& species, const Vector& a, const Vector& b) {
  const Vector way = b - a;
  const auto density = [&](double s) { return factor(species, a + way * s); };
  std::vector<double> edges = {0.0};
  constexpr int steps = 2000;
  for (int i = 0; i < steps; ++i) {
    double low = static_cast<double>(i) / steps, high = static_cast<double>(i + 1) / steps;
    if ((density(low) > 0.0) == (density(high) > 0.0)) continue;
    for (int k = 0; k < 60; ++k) {
      const double middle = 0.5 * (low + high);
      ((density(middle) > 0.0) == (density(low) > 0.0) ? low : high) = middle;
    }
    edges.push_back(0.5 * (low + high));
  }
  edges.push_back(1.0);
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    // A hair inside the edges: they themselves may be on either side.
    const double inset = 1e-14;
    if (density(0.5 * (edges[i] + edges[i + 1])) == 0.0) continue;
    const double low = edges[i] + (i > 0 ? inset : 0.0);
    const double high = edges[i + 1] - (i + 2 < edges.size() ? inset : 0.0);
    sum += integral(density, low, high, 1e-13, 2);
  }
  return sum * length(way) * species.extinction()[1];
}

/// int sum_i sigma_s,i p_i I e^-(tau) / r^2 dt in the green channel over [0, end], or the same for a sun.
double brute_force(const Medium& medium, const Ray& ray, double end, const std::function<Vector(const Vector&)>& source,
                   const std::function<double(const Vector&)>& irradiance, double tolerance) {
  const auto integrand = [&](double t) {
    const Vector p = ray.at(t), from = source(p);
    const Vector travel = normalized(p - from);
    double depth = 0.0, scattered = 0.0;
    for (const Species& s : medium.species) {
      depth += depth_of(s, ray.origin, p) + depth_of(s, p, from);
      const double mu = dot(travel, -ray.direction);
      scattered += s.scattering[1] * factor(s, p) * density(s.phase, Deflection<double>::from_mu(mu));
    }
    return scattered * irradiance(p) * std::exp(-depth);
  };
  return integral(integrand, 0.0, end, tolerance);
}

TEST(Single, ExponentialAirAgreesWithBruteForce) {
  Scene scene;
  scene.medium = medium_of({{0.02, 0.05, 0.1}}, {{0.01, 0.0, 0.02}}, MieHazy<double>{}, {ExponentialProfile{3.0, 1.0}});
  const Medium thin = medium_of({{0.0, 0.01, 0.3}}, {}, HenyeyGreenstein<double>{0.6}, {ExponentialProfile{10.0, 0.0}});
  scene.medium.species.push_back(thin.species[0]);
  const Vector lamp{4, 3, 1};
  scene.points.push_back({lamp, Spectrum::grey(2.0)});
  for (const Vector& direction : {Vector{1, 0.2, 0.1}, Vector{1, 0, 0}, Vector{1, -0.3, 0.2}, Vector{-1, 2, 0}}) {
    const Ray ray{{0, 2, 0}, normalized(direction)};
    const double end = 12.0, value = probe(scene, ray, end).single[1];
    const double truth = brute_force(
        scene.medium, ray, end, [&](const Vector&) { return lamp; },
        [&](const Vector& p) { return 2.0 / length_squared(p - lamp); }, 1e-10 * value);
    EXPECT_NEAR(value / truth, 1.0, 1e-8) << direction.x << " " << direction.y;
  }
}

TEST(Single, OverlappingBoxesAndSpheresAgreeWithBruteForce) {
  Scene scene;
  scene.medium = medium_of(Spectrum::grey(0.05), {}, Rayleigh<double>{});
  const auto add = [&](const Medium& m) { scene.medium.species.push_back(m.species[0]); };
  add(medium_of(Spectrum::grey(0.3), Spectrum::grey(0.1), MieMurky<double>{}, {BoxProfile{{1, -1, -1}, {5, 2.5, 2}}}));
  add(medium_of(Spectrum::grey(0.5), {}, HenyeyGreenstein<double>{0.7}, {SphereProfile{{3, 1.5, 0}, 1.3}}));
  add(medium_of(Spectrum::grey(0.4), {}, Isotropic<double>{},
                {ExponentialProfile{1.0, 0.0}, BoxProfile{{6, -1, -1}, {8, 3, 1}}}));
  const Vector lamps[] = {{3, 1.7, 0.2}, {4, 4, 1}, {7, 6, -0.5}};
  for (const Vector& lamp : lamps) {
    scene.points = {{lamp, Spectrum::grey(1.0)}};
    for (const Vector& direction : {Vector{1, 0.02, 0.03}, Vector{1, 0.2, 0.05}}) {
      const Ray ray{{0, 0.1, 0}, normalized(direction)};
      const double end = 10.0, value = probe(scene, ray, end).single[1];
      const double truth = brute_force(
          scene.medium, ray, end, [&](const Vector&) { return lamp; },
          [&](const Vector& p) { return 1.0 / length_squared(p - lamp); }, 1e-8 * value);
      EXPECT_NEAR(value / truth, 1.0, 1e-7) << lamp.x << " " << direction.y;
    }
  }
}

TEST(Single, SunInVaryingAirAgreesWithBruteForce) {
  Scene scene;
  scene.medium = medium_of(Spectrum::grey(0.1), Spectrum::grey(0.02), HenyeyGreenstein<double>{0.7},
                           {ExponentialProfile{2.0, 0.0}});
  const Vector toward = normalized({0.6, 0.5, 0.2});
  scene.suns.push_back({-toward, Spectrum::grey(3.0), 0.0});
  const auto compare = [&](double tolerance, const char* what) {
    for (const Vector& direction : {Vector{1, 0.1, 0}, Vector{1, 0, 0}, Vector{1, -0.2, 0.3}}) {
      const Ray ray{{0, 2.5, 0}, normalized(direction)};
      const double end = 9.0, value = probe(scene, ray, end).single[1];
      // 60 m of way toward the sun is 18 scale heights.
      const double truth = brute_force(
          scene.medium, ray, end, [&](const Vector& p) { return p + toward * 60.0; },
          [&](const Vector&) { return 3.0; }, 1e-10 * value);
      EXPECT_NEAR(value / truth, 1.0, tolerance) << what << " " << direction.y;
    }
  };
  compare(1e-8, "one exponential: closed form");
  scene.medium.species.push_back(
      medium_of(Spectrum::grey(0.2), {}, Isotropic<double>{}, {SphereProfile{{5, 4, 1}, 1.5}}).species[0]);
  compare(1e-7, "and a sphere: panels");
}

/// Ground fog of 30 m scale height from kilometres up, where it is thinner by e^300: all of its light comes from the
/// last thousandth of the ray. With w = e^(-y / H), sun and eye see int sigma H p E e^-(sigma H (w + (w - w0) / c))
/// dw/c.
TEST(Single, FogIsFoundFarBelow) {
  const double height = 30.0, sigma = 0.004, up = 9000.0;
  Scene scene;
  scene.medium = medium_of(Spectrum::grey(sigma), {}, Isotropic<double>{}, {ExponentialProfile{height, 0.0}});
  scene.suns.push_back({{0, -1, 0}, Spectrum::grey(1.0), 0.0});
  const Ray ray{{0, up, 0}, normalized({0.3, -1, 0})};
  const double c = 1.0 / std::sqrt(1.09), column = sigma * height;
  const double sunlit = 1.0 / (4.0 * pi_number * c) / (1.0 + 1.0 / c);
  EXPECT_NEAR(probe(scene, ray).single[0] / sunlit, 1.0, 1e-11);
  // A lamp in it, by quadrature over the last 40 scale heights and what is below.
  const Vector lamp{up * 0.3 + 20.0, 10.0, 5.0};
  scene.suns.clear();
  scene.points.push_back({lamp, Spectrum::grey(1.0)});
  const double truth = integral(
      [&](double t) {
        const Vector p = ray.at(t);
        const double w = std::exp(-p.y / height), at_lamp = std::exp(-lamp.y / height), r = length(p - lamp);
        const double rise = p.y - lamp.y;
        const double mean = std::fabs(rise) < 1e-9 ? w : (at_lamp - w) * height / rise;  // density on the lamp's way
        return sigma * w / (4.0 * pi_number * r * r) * std::exp(-column * w / c - sigma * mean * r);
      },
      (up - 40.0 * height) / c, (up + 8.0 * height) / c, 1e-16, 400);
  EXPECT_NEAR(probe(scene, ray).single[0] / truth, 1.0, 1e-8);
}

/// A box of fog lit by the sun from straight above, looked through horizontally: int_0^L s p E e^-(t + depth) e^(-s t).
TEST(Single, SunShaftsInABoxAreClosedExponentials) {
  const double sigma = 0.7, top = 2.0, height = 0.5, begin = 1.0, end = 4.0;
  Scene scene;
  scene.medium = medium_of(Spectrum::grey(sigma), {}, Isotropic<double>{}, {BoxProfile{{begin, 0, -1}, {end, top, 1}}});
  scene.suns.push_back({{0, -1, 0}, Spectrum::grey(5.0), 0.0});
  const auto shaft = [&](double a, double b) {  // of the box's own length
    return 5.0 / (4.0 * pi_number) * std::exp(-sigma * (top - height)) * (std::exp(-sigma * a) - std::exp(-sigma * b));
  };
  const Ray ray{{0, height, 0}, {1, 0, 0}};
  EXPECT_NEAR(probe(scene, ray).single[0] / shaft(0.0, end - begin), 1.0, 1e-13);
  // A roof with two slots lets two shafts through.
  add_quad(scene, {-10, 3, 5}, {11.5, 0, 0}, {0, 0, -10});
  add_quad(scene, {1.75, 3, 5}, {1.25, 0, 0}, {0, 0, -10});
  add_quad(scene, {3.5, 3, 5}, {10, 0, 0}, {0, 0, -10});
  EXPECT_NEAR(probe(scene, ray).single[0] / (shaft(0.5, 0.75) + shaft(2.0, 2.5)), 1.0, 1e-9);
}

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

TEST(Single, SurfacesEndTheRayAndShowTheirOwnLight) {
  const double sigma = 0.3;
  Scene scene;
  scene.medium = medium_of(Spectrum::grey(0.0), Spectrum::grey(sigma), Isotropic<double>{});
  add_quad(scene, {-9, -9, -4}, {18, 0, 0}, {0, 18, 0}, add_material(scene, Spectrum::grey(0.0), {{1.0, 2.0, 3.0}}));
  scene.environment = EnvironmentLight{};
  scene.environment->radiance = Spectrum::grey(7.0);
  const PixelLayers seen = probe(scene, {{0, 0, 0}, {0, 0, -1}});
  EXPECT_NEAR(seen.surface[1] / (2.0 * std::exp(-4.0 * sigma)), 1.0, 0.05) << "its 4 % gloss reflects an absorbed sky";
  EXPECT_NEAR(seen.transmittance[0], std::exp(-4.0 * sigma), 1e-12);
  EXPECT_NEAR(seen.depth, 4.0, 1e-12);
  const PixelLayers shorter = probe(scene, {{0, 0, 0}, {0, 0, -1}}, 3.0);
  EXPECT_EQ(shorter.surface[1], 0.0) << "nothing at or beyond the distance is added";
  EXPECT_EQ(shorter.depth, infinity);
  EXPECT_NEAR(shorter.transmittance[0], std::exp(-3.0 * sigma), 1e-12);
  scene.medium.species.clear();
  EXPECT_EQ(probe(scene, {{0, 0, 0}, {0, 0, 1}}).surface[0], 7.0) << "the sky";
}

/// A floor under a point lamp, and under a glowing square: against the sum over its pieces.
TEST(Single, SurfacesAreLitByLampsAndGlowingSquares) {
  Scene scene;
  add_quad(scene, {-50, 0, 50}, {100, 0, 0}, {0, 0, -100}, add_material(scene, Spectrum::grey(1.0)));
  const Ray down{{3, 1, 0}, {0, -1, 0}};
  const SurfacePoint floor = [&] {
    const Geometry geometry(scene);
    return surface_point(geometry, *geometry.intersect(down));
  }();
  const auto reflected = [&](const Vector& from, const Vector& normal) {  // per W/(m^2 sr) and m^2
    const Vector way = from - floor.position;
    const Vector in = normalized(way);
    return evaluate(floor, {0, 1, 0}, in)[0] * std::max(0.0, -dot(normal, in)) / length_squared(way);
  };
  scene.points.push_back({{2, 2, 1}, Spectrum::grey(8.0)});
  const Vector aimed = normalized(floor.position - scene.points[0].position);
  EXPECT_NEAR(probe(scene, down).surface[0] / (8.0 * reflected({2, 2, 1}, aimed)), 1.0, 1e-7);
  Scene hidden = scene;
  add_quad(hidden, {2, 1.5, 2}, {1, 0, 0}, {0, 0, -2});
  EXPECT_EQ(probe(hidden, down).surface[0], 0.0);
  scene.points.clear();
  add_quad(scene, {-1, 2, -1}, {2, 0, 0}, {0, 0, 2}, add_material(scene, Spectrum::grey(0.0), Spectrum::grey(1.0)));
  double truth = 0.0;
  for (int i = 0; i < 200; ++i) {
    for (int j = 0; j < 200; ++j)
      truth += reflected({-1 + (i + 0.5) / 100, 2, -1 + (j + 0.5) / 100}, {0, -1, 0}) * 1e-4;
  }
  EXPECT_NEAR(probe(scene, down).surface[0] / truth, 1.0, 5e-3);
}

TEST(Single, GlowingSurfacesScatterLikeManyLamps) {
  // A glowing square against 100 x 100 cosine lamps, added up by hand along the ray.
  Scene scene;
  const double sigma = 0.2;
  scene.medium = medium_of(Spectrum::grey(sigma), {}, Isotropic<double>{});
  add_quad(scene, {4, 2, -1}, {2, 0, 0}, {0, 0, 2}, add_material(scene, Spectrum::grey(0.0), Spectrum::grey(1.0)));
  const Ray ray{{0, 0, 0}, {1, 0, 0}};
  double truth = 0.0;
  for (int i = 0; i < 40; ++i) {
    for (int j = 0; j < 40; ++j) {
      const Vector lamp{4 + (i + 0.5) / 20, 2, -1 + (j + 0.5) / 20};
      truth += integral(
          [&](double t) {
            const double squared = length_squared(ray.at(t) - lamp), r = std::sqrt(squared);
            return sigma / (4.0 * pi_number) * std::exp(-sigma * (t + r)) * (2.0 / r) / squared / 400.0;
          },
          0.0, 10.0, 1e-10, 8);
    }
  }
  EXPECT_NEAR(probe(scene, ray, 10.0).single[0] / truth, 1.0, 0.002);
  // Behind it: nothing, it glows on one side only.
  EXPECT_EQ(probe(scene, {{0, 4, 0}, {1, 0, 0}}, 10.0).single[0], 0.0);
}

TEST(Single, AnEvenSkyScattersAsMuchAsItTakesFromAThinBall) {
  // A thin ball in an even sky: what it scatters toward the eye is what extinction took, albedo 1, up to tau^2.
  for (const Law<double>& law : {Law<double>{Isotropic<double>{}}, Law<double>{HenyeyGreenstein<double>{0.9}}}) {
    Scene scene;
    scene.medium = medium_of(Spectrum::grey(1e-4), {}, law, {SphereProfile{{0, 0, -5}, 1.0}});
    scene.environment = EnvironmentLight{};
    scene.environment->radiance = Spectrum::grey(2.0);
    EXPECT_NEAR(probe(scene, {{0, 0, 0}, {0, 0, -1}}).single[0] / (2.0 * 2e-4), 1.0, 1e-3);
  }
}

TEST(Single, APanoramaWithASunScattersAsThatSun) {
  // One bright pixel of 360 x 180: a sun, whatever the fixed directions miss.
  auto panorama = std::make_shared<Panorama>();
  panorama->width = 360;
  panorama->height = 180;
  panorama->radiance.assign(360 * 180, {0.0f, 0.0f, 0.0f});
  const int row = 60, column = 200;
  panorama->radiance[row * 360 + column] = {1e4f, 2e4f, 3e4f};
  Scene scene;
  scene.medium = medium_of(Spectrum::grey(0.1), {}, HenyeyGreenstein<double>{0.5}, {SphereProfile{{0, 0, -5}, 2.0}});
  scene.environment = EnvironmentLight{};
  scene.environment->panorama = panorama;
  const Ray ray{{0, 0, 0}, {0, 0, -1}};
  const double sky = probe(scene, ray).single[0];
  const double polar = pi_number * (row + 0.5) / 180, azimuth = 2.0 * pi_number * ((column + 0.5) / 360 - 0.5);
  Scene sunny = scene;
  sunny.environment.reset();
  const Vector toward{std::sin(polar) * std::sin(azimuth), std::cos(polar), -std::sin(polar) * std::cos(azimuth)};
  const double solid_angle = std::pow(pi_number / 180, 2) * std::sin(polar);
  sunny.suns.push_back({-toward, Spectrum::grey(1e4 * solid_angle), 0.0});
  EXPECT_NEAR(sky / probe(sunny, ray).single[0], 1.0, 0.02);
}

TEST(Single, ASunDiscIsSeenWithItsIrradianceAndScattersLikeAPoint) {
  Scene scene;
  scene.suns.push_back({{0, 0, 1}, Spectrum::grey(3.0), 1.0});
  const double half = 0.5 * pi_number / 180.0, solid_angle = 2.0 * pi_number * (1.0 - std::cos(half));
  EXPECT_NEAR(probe(scene, {{0, 0, 0}, {0, 0, -1}}).surface[0] / (3.0 / solid_angle), 1.0, 1e-9);
  EXPECT_EQ(probe(scene, {{0, 0, 0}, normalized({0.01, 0, -1})}).surface[0], 0.0);
  scene.medium = medium_of(Spectrum::grey(0.1), {}, HenyeyGreenstein<double>{0.5}, {SphereProfile{{0, 0, -5}, 2.0}});
  Scene parallel = scene;
  parallel.suns[0].angular_diameter = 0.0;
  const Ray ray{{0, 0, 0}, normalized({0.2, 0.1, -1})};
  EXPECT_NEAR(probe(scene, ray).single[0] / probe(parallel, ray).single[0], 1.0, 1e-3);
}

/// int over directions of what arrives at most once scattered, for an isotropic point source of 1 W: with the two
/// distances as coordinates, phi_1 = sigma_s / (8 pi r) int_r^inf e^(-sigma s) (2 / s) ln((s + r) / (s - r)) ds.
TEST(Single, FluenceOfAPointSourceAgreesWithItsIntegral) {
  for (const double r : {0.1, 1.0, 3.0}) {
    const double sigma = 1.0, albedo = 0.8;
    Scene scene;
    scene.medium =
        medium_of(Spectrum::grey(sigma * albedo), Spectrum::grey(sigma * (1.0 - albedo)), Isotropic<double>{});
    scene.points.push_back({{0, 0, 0}, Spectrum::grey(1.0 / (4.0 * pi_number))});
    const double once = integral(
        [&](double x) {  // s = r + x^2, which takes the logarithm's edge off
          const double s = r + x * x;
          return x == 0.0 ? 0.0 : std::exp(-sigma * s) * (2.0 / s) * std::log((s + r) / (x * x)) * 2.0 * x;
        },
        0.0, 7.0, 1e-10);
    const double truth =
        std::exp(-sigma * r) / (4.0 * pi_number * r * r) + sigma * albedo / (8.0 * pi_number * r) * once;
    const Geometry geometry(scene);
    const SingleContext context(scene, geometry);
    EXPECT_NEAR(single_fluence(context, {0, 0, r})[0] / truth, 1.0, 1e-3) << r;
    EXPECT_TRUE(std::isinf(single_fluence(context, {0, 0, 0})[0]));
  }
}

TEST(Single, APixelThatSeesALampIsTheAverageOverItsFootprint) {
  Scene scene;
  scene.medium = medium_of(Spectrum::grey(0.05), {}, HenyeyGreenstein<double>{0.7});
  scene.camera = {{0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 40.0};
  scene.film = {16, 12};
  scene.points.push_back({{0.31, 0.17, -6}, Spectrum::grey(1.0)});
  const Geometry geometry(scene);
  const SingleContext context(scene, geometry);
  const CameraRays camera(scene.camera, scene.film);
  double brightest = 0.0;
  for (int y = 4; y < 8; ++y) {
    for (int x = 6; x < 11; ++x) {
      constexpr int n = 150;
      double truth = 0.0;
      for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
          truth += single_radiance(context, camera.through(x + (i + 0.5) / n, y + (j + 0.5) / n)).single[0] / (n * n);
        }
      }
      const double value = single_pixel(context, x, y, 1).single[0];
      EXPECT_NEAR(value / truth, 1.0, 0.02) << x << " " << y;  // the grid's own error beside the pole, too
      brightest = std::max(brightest, value);
    }
  }
  EXPECT_TRUE(std::isfinite(brightest));
}

TEST(Single, IsFiniteAndNotNegativeWhateverTheScene) {
  std::vector<Medium> media = {
      {},
      medium_of(Spectrum::grey(1e6), {}, Isotropic<double>{}),
      medium_of(Spectrum::grey(1e-30), {}, HenyeyGreenstein<double>{0.9999}),
      medium_of(Spectrum::grey(0.0), Spectrum::grey(1.0), Isotropic<double>{}),
      medium_of({{0.0, 1e-3, 1e3}}, {}, MieMurky<double>{}, {ExponentialProfile{10.0, 0.0}}),
      medium_of(Spectrum::grey(5.0), {}, MieHazy<double>{}, {ExponentialProfile{1e-3, 0.0}}),
      medium_of(Spectrum::grey(1.0), {}, Isotropic<double>{}, {BoxProfile{{-1, -1, -1}, {1, 1, 1}}}),
      medium_of(Spectrum::grey(1e4), {}, Isotropic<double>{},
                {SphereProfile{{0, 0, 0}, 1.0}, ExponentialProfile{1.0, 0.0}})};
  for (const Medium& medium : media) {
    Scene scene;
    scene.medium = medium;
    scene.points = {
        {{3, 0, 1e-12}, Spectrum::grey(1.0)}, {{1, 1e6, 0}, Spectrum::grey(1.0)}, {{-2, 1, 0}, {{1, 0, 2}}}};
    scene.spots = {{{2, 3, 1}, {0, -1, 0}, Spectrum::grey(1.0), 0.0, 90.0},
                   {{2, -3, 1}, {0, 1, 0.1}, Spectrum::grey(1.0), 5.0, 5.0}};
    scene.suns = {{{0, -1, 0}, Spectrum::grey(1.0), 0.0},
                  {{1, 0, 0}, Spectrum::grey(1.0), 0.5},
                  {{0, 1, 0}, Spectrum::grey(1.0), 0.0}};
    scene.environment = EnvironmentLight{};
    scene.environment->radiance = Spectrum::grey(1.0);
    add_quad(scene, {-5, -2, 5}, {10, 0, 0}, {0, 0, -10}, add_material(scene, Spectrum::grey(0.5)));
    add_quad(scene, {1, 1, 0}, {1, 0, 0}, {0, 0, 1}, add_material(scene, Spectrum::grey(0.5), Spectrum::grey(1.0)));
    const Geometry geometry(scene);
    SingleSettings settings;
    settings.sky_directions = settings.surface_directions = settings.emissive_points = 16;
    const SingleContext context(scene, geometry, settings);
    for (const Vector& origin : {Vector{0, 0, 0}, Vector{3, 0, 0}, Vector{0, -2, 0}, Vector{0, 500, 0}}) {
      for (const Vector& to : {Vector{1, 0, 0}, Vector{0, 1, 0}, Vector{0, -1, 0}, Vector{-1, 0, 0}, Vector{1, 1, 1}}) {
        for (const double distance : {1e-12, 1.0, 1e6, infinity}) {
          const PixelLayers p = single_radiance(context, {origin, normalized(to)}, distance);
          for (const Spectrum& s : {p.surface, p.single, p.transmittance}) {
            for (std::size_t c = 0; c < channel_count; ++c) {
              EXPECT_TRUE(std::isfinite(s[c]) && s[c] >= 0.0)
                  << "medium " << (&medium - media.data()) << " from " << origin.x << " " << origin.y << " toward "
                  << to.x << " " << to.y << " for " << distance << ": " << s[c];
            }
          }
        }
      }
    }
  }
}

TEST(Single, ALampOnTheRayIsInfiniteUnlessSomethingHidesIt) {
  Scene scene;
  scene.medium = medium_of(Spectrum::grey(0.5), {}, Isotropic<double>{});
  scene.points.push_back({{3, 0, 0}, Spectrum::grey(1.0)});
  const Ray ray{{0, 0, 0}, {1, 0, 0}};
  EXPECT_TRUE(std::isinf(probe(scene, ray).single[0]));
  const double before = probe(scene, ray, 2.0).single[0];
  EXPECT_NEAR(before / (0.5 / (4.0 * pi_number) * std::exp(-1.5) * (1.0 - 1.0 / 3.0)), 1.0, 1e-9);
  add_quad(scene, {2, -1, -1}, {0, 2, 0}, {0, 0, 2}, add_material(scene, Spectrum::grey(0.0)));
  EXPECT_EQ(probe(scene, ray).single[0], 0.0);
}

TEST(Single, TheSameInputGivesTheSameBits) {
  const Scene scene = tests::busy_scene();
  const Geometry geometry(scene), again(scene);
  const SingleContext first(scene, geometry), second(scene, again);
  for (int i = 0; i < 20; ++i) {
    const PixelLayers a = single_pixel(first, 7 * i % 48, 5 * i % 32, 1),
                      b = single_pixel(second, 7 * i % 48, 5 * i % 32, 1);
    EXPECT_EQ(0, std::memcmp(&a, &b, sizeof a));
  }
}

TEST(Single, SaysWhatItsQuadraturesWere) {
  const Scene scene;
  const Geometry geometry(scene);
  SingleSettings settings;
  settings.sky_directions = 77;
  const std::string text = single_description(SingleContext(scene, geometry, settings));
  EXPECT_NE(text.find("77 directions"), std::string::npos) << text;
}

}  // namespace
}  // namespace tyndall
