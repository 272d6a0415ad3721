// Profiles: what they are at a point, and what a ray meets of them, against an independent adaptive quadrature.
#include <gtest/gtest.h>

#include <numbers>

#include "tyndall/medium/free_flight.h"
#include "tyndall/medium/grid_cases_test.h"
#include "tyndall/sampling/random_stream.h"

namespace tyndall {
namespace {

Species species_of(std::vector<Profile> profiles, double extinction = 1.0) {
  Species s;
  s.scattering = Spectrum::grey(extinction);
  s.profiles = std::move(profiles);
  return s;
}

/// int f over [a, b]: a panel is halved until that changes it by less than `allowed`, knowing nothing of where the
/// profiles begin. `depth` bounds the halvings at jumps.
template <class F>
double halved(const F& f, double a, double b, double whole, double allowed, int depth) {
  const double m = 0.5 * (a + b), left = gauss_legendre_16(a, m, f), right = gauss_legendre_16(m, b, f);
  if (depth <= 0 || std::fabs(left + right - whole) <= allowed) return left + right;
  return halved(f, a, m, left, 0.7 * allowed, depth - 1) + halved(f, m, b, right, 0.7 * allowed, depth - 1);
}

/// int of a species' factor along a ray. Where it begins and ends is found by bisection (all shapes here are convex),
/// so that no sliver beside a jump is missed; NaN when it is too short for the scan that looks for it.
double integral(const Species& species, const Ray& ray, double begin, double end, int panels = 400) {
  const auto f = [&](double t) { return factor(species, ray.at(t)); };
  constexpr int looks = 4000;
  const auto look = [&](int i) { return begin + (end - begin) * i / looks; };
  int first = 0, last = looks;
  while (first <= looks && !(f(look(first)) > 0.0)) ++first;
  while (last >= first && !(f(look(last)) > 0.0)) --last;
  if (first > last) return std::nan("");
  const auto border = [&](double out, double in) {
    for (int i = 0; i < 60; ++i) {
      const double m = 0.5 * (out + in);
      (f(m) > 0.0 ? in : out) = m;
    }
    return in;
  };
  const double from = first > 0 ? border(look(first - 1), look(first)) : begin;
  const double to = last < looks ? border(look(last + 1), look(last)) : end;
  double rough = 0.0, sum = 0.0;
  std::vector<double> parts;
  const auto edge = [&](int i) { return i == panels ? to : from + (to - from) * i / panels; };
  for (int i = 0; i < panels; ++i) parts.push_back(gauss_legendre_16(edge(i), edge(i + 1), f)), rough += parts.back();
  const double allowed = std::max(1e-12 * rough, 1e-80);
  for (int i = 0; i < panels; ++i)
    sum += halved(f, edge(i), edge(i + 1), parts[static_cast<std::size_t>(i)], allowed, 40);
  return sum;
}

/// So thin that nothing is opaque, where pieces would be coarser.
constexpr double thin = 1e-60;

/// The found depth is that of the truth; where the truth saw nothing, it is next to nothing.
void expect_depth(double found, double wanted, double whole, const char* name, int ray) {
  if (std::isnan(wanted)) {
    EXPECT_LT(found, 0.06e-60) << name << ", ray " << ray;
  } else {
    EXPECT_NEAR(found, wanted, 1e-9 * whole + 1e-73) << name << ", ray " << ray;
  }
}

struct Case {
  const char* name;
  std::vector<Profile> profiles;
};

std::vector<Case> cases() {
  const ExponentialProfile exponential{1.5, 0.3};
  const LayerProfile layer{-0.7, 0.9};
  const TentProfile tent{0.2, 1.3};
  const BoxProfile box{{-1.0, -1.1, -0.8}, {1.2, 0.9, 1.0}}, soft{{-1.0, -1.1, -0.8}, {1.2, 0.9, 1.0}, 0.6},
      softest{{-1, -1, -1}, {1, 1, 1}, 1.0};
  const SphereProfile ball{{0.1, 0.2, -0.1}, 1.2}, soft_ball{{0.1, 0.2, -0.1}, 1.2, 0.5},
      softest_ball{{0, 0, 0}, 1.3, 1.3};
  const NoiseProfile noise{0.9, 3, 0.9, 5, {}}, plain{1.4, 1, 1.0, 2, {}};
  return {{"layer", {layer}},
          {"tent", {tent}},
          {"box", {box}},
          {"soft box", {soft}},
          {"softest box", {softest}},
          {"ball", {ball}},
          {"soft ball", {soft_ball}},
          {"softest ball", {softest_ball}},
          {"plain noise in a box", {plain, box}},
          {"noise in a ball", {noise, ball}},
          {"exponential layer", {exponential, layer}},
          {"exponential tent", {exponential, tent}},
          {"exponential soft box", {exponential, soft}},
          {"steep soft box", {ExponentialProfile{0.01, 0.0}, soft}},
          {"soft ball in a layer", {soft_ball, layer}},
          {"soft ball in a soft box", {soft_ball, soft}},
          {"noise in a soft box", {noise, soft}},
          {"noise in a tent", {noise, tent}},
          {"exponential noise in a soft box", {exponential, noise, soft}},
          {"exponential noise in a soft ball", {exponential, noise, soft_ball}},
          {"noise in noise in a tent", {noise, plain, tent}},
          {"five noises in a soft box",  // degree 54: more points than a rule has
           {noise, plain, NoiseProfile{1.1, 2, 1.0, 3, {}}, NoiseProfile{0.8, 2, 0.7, 8, {}},
            NoiseProfile{2, 1, 1, 9, {}}, soft}},
          {"eight noises, exponential",
           {ExponentialProfile{0.4, 0.0}, noise, plain, noise, plain, noise, plain, soft_ball}},
          {"grid", {tests::ragged_grid(false)}},
          {"grid askew", {tests::ragged_grid(true)}},
          {"exponential grid in a soft ball", {exponential, tests::ragged_grid(true), soft_ball}},
          {"grid with noise in a layer", {tests::ragged_grid(false), noise, layer}},
          {"two boxes", {box, BoxProfile{{-2, -0.5, -2}, {0.5, 2, 2}, 0.3}}}};
}

Vector direction(RandomStream& random) {
  const double z = 2.0 * random.next() - 1.0, phi = 2.0 * std::numbers::pi * random.next();
  const double r = std::sqrt(1.0 - z * z);
  return {r * std::cos(phi), z, r * std::sin(phi)};
}

/// Rays from everywhere in every direction, and those that make trouble: along axes, within faces, from edges and
/// centres.
Ray some_ray(RandomStream& random, int i) {
  const auto at = [&] { return 4.0 * random.next() - 2.0; };
  const Vector axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, 0}, {-1, 0, 0}};
  switch (i % 6) {
    case 0:
      return {{at(), at(), at()}, axes[i / 6 % 5]};
    case 1:
      return {{-1.0, at(), at()}, direction(random)};  // on a face
    case 2:
      return {{1.2, 0.9, at()}, direction(random)};  // on an edge
    case 3:
      return {{at(), 0.2, at()}, normalized({at(), 0.0, at()})};  // level
    case 4:
      return {{0.1, 0.2, -0.1}, direction(random)};  // from a centre
    default:
      return {{at(), at(), at()}, direction(random)};
  }
}

TEST(Profile, OpticalDepthIsTheIntegralOfTheFactor) {
  RandomStream random(11, 0, 0);
  std::vector<Stretch> stretches;
  for (const Case& c : cases()) {
    const Species species = species_of(c.profiles, thin);
    const LoweredMedium lowered = lower(Medium{{species}});
    for (int i = 0; i < 60; ++i) {
      const Ray ray = some_ray(random, i);
      stretches_along(lowered, ray, 7.0, stretches);
      const double found = optical_depth(stretches, 7.0)[0];
      expect_depth(found, thin * integral(species, ray, 0.0, 7.0), found, c.name, i);
      const double t = 7.0 * random.next();  // on the way
      expect_depth(optical_depth(stretches, t)[0], thin * integral(species, ray, 0.0, t), found, c.name, i);
    }
  }
}

TEST(Profile, EndlessRaysMeetAllOfAFiniteMedium) {
  RandomStream random(12, 0, 0);
  std::vector<Stretch> stretches;
  for (const Case& c : cases()) {
    const Species species = species_of(c.profiles, thin);
    const LoweredMedium lowered = lower(Medium{{species}});
    for (int i = 0; i < 36; ++i) {
      const Ray ray = some_ray(random, i);
      stretches_along(lowered, ray, infinity, stretches);
      const double depth = optical_depth(stretches, infinity)[0];
      ASSERT_FALSE(std::isnan(depth)) << c.name;
      // A level ray in a layer never leaves it; one that is nearly level does so beyond the truth's reach.
      if (ray.direction.y == 0.0 && std::isinf(depth)) continue;
      ASSERT_LT(depth, infinity) << c.name;
      if (std::fabs(ray.direction.y) < 0.2) continue;
      expect_depth(depth, thin * integral(species, ray, 0.0, 25.0), depth, c.name, i);
    }
  }
}

TEST(Profile, StretchesSayTheFactorOfEveryPoint) {
  RandomStream random(13, 0, 0);
  std::vector<Stretch> stretches;
  for (const Case& c : cases()) {
    const Species species = species_of(c.profiles);
    const LoweredMedium lowered = lower(Medium{{species}});
    for (int i = 0; i < 600; ++i) {
      const Ray ray = some_ray(random, i);
      stretches_along(lowered, ray, 7.0, stretches);
      const double t = 7.0 * random.next(), wanted = factor(species, ray.at(t));
      // Level and upright rays may run within a face, where rounding says on which side of it they are.
      if (i % 6 < 4 && i % 6 != 1) continue;
      ASSERT_NEAR(extinction_at(stretches, t)[0], wanted, 1e-11 * (1.0 + wanted)) << c.name << ", ray " << i;
    }
  }
}

TEST(Profile, DistancesInvertTheDepth) {
  RandomStream random(14, 0, 0);
  std::vector<Stretch> stretches;
  for (const Case& c : cases()) {
    Medium medium{{species_of(c.profiles, 0.7), species_of(c.profiles, 0.4)}};
    if (random.next() < 0.5) medium.species.push_back(species_of({ExponentialProfile{2.0, 0.0}}, 0.1));
    const LoweredMedium lowered = lower(medium);
    for (int i = 0; i < 100; ++i) {
      const Ray ray = some_ray(random, i);
      stretches_along(lowered, ray, 7.0, stretches);
      const double all = optical_depth(stretches, 7.0)[0];
      if (!(all > 1e-9)) continue;
      const double depth = all * random.next(), t = distance_at_depth(stretches, 0, depth, 7.0);
      ASSERT_LT(t, 7.0) << c.name;
      ASSERT_NEAR(optical_depth(stretches, t)[0], depth, 1e-13 * all + 1e-14) << c.name << ", ray " << i;
      EXPECT_EQ(distance_at_depth(stretches, 0, all * 1.001, 7.0), infinity) << c.name;
    }
  }
}

TEST(Profile, SpeciesOfOnePlaceShareTheirStretches) {
  const std::vector<Profile> profiles{NoiseProfile{0.9, 3, 0.9, 5, {}}, SphereProfile{{0, 0, 0}, 2.0, 0.5}};
  const LoweredMedium both = lower(Medium{{species_of(profiles, 0.3), species_of(profiles, 0.5)}}),
                      one = lower(Medium{{species_of(profiles, 0.8)}});
  std::vector<Stretch> stretches, single;
  const Ray ray{{-3, 0.1, 0.2}, {1, 0, 0}};
  stretches_along(both, ray, 7.0, stretches);
  stretches_along(one, ray, 7.0, single);
  ASSERT_EQ(stretches.size(), 2 * single.size());
  for (std::size_t i = 0; i < single.size(); ++i) EXPECT_TRUE(stretches[2 * i].like(stretches[2 * i + 1]));
  EXPECT_NEAR(optical_depth(stretches, 7.0)[1], optical_depth(single, 7.0)[1], 1e-15);
  EXPECT_NEAR(distance_at_depth(stretches, 1, 0.5, 7.0), distance_at_depth(single, 1, 0.5, 7.0), 1e-13);
}

TEST(Profile, ATentIsAnOzoneLayer) {
  // 300 DU between 10 and 40 km: the vertical column is half_width times the peak.
  const LoweredMedium medium = lower(Medium{{species_of({TentProfile{25000.0, 15000.0}}, 1.88e-6)}});
  std::vector<Stretch> stretches;
  EXPECT_NEAR(-std::log(transmittance(medium, {{0, 0, 0}, {0, 1, 0}}, infinity, stretches)[0]), 1.88e-6 * 15000.0,
              1e-14);
  EXPECT_EQ(factor(TentProfile{25000.0, 15000.0}, {0, 25000, 0}), 1.0);
  EXPECT_EQ(factor(TentProfile{25000.0, 15000.0}, {0, 5000, 0}), 0.0);
  EXPECT_NEAR(factor(TentProfile{25000.0, 15000.0}, {0, 32500, 0}), 0.5, 1e-15);
}

TEST(Profile, ShapesThatDoNotMeetLeaveNothing) {
  const BoxProfile left{{-2, -1, -1}, {-1, 1, 1}}, right{{1, -1, -1}, {2, 1, 1}};
  EXPECT_TRUE(lower(Medium{{species_of({left, right})}}).species.empty());
  EXPECT_TRUE(lower(Medium{{species_of({LayerProfile{0, 1}, LayerProfile{2, 3}})}}).species.empty());
  EXPECT_TRUE(lower(Medium{{species_of({left, LayerProfile{2, 3}})}}).species.empty());
}

TEST(Profile, FeathersNeedRoom) {
  EXPECT_FALSE(objection_to(BoxProfile{{0, 0, 0}, {1, 2, 3}, 0.5}));
  EXPECT_TRUE(objection_to(BoxProfile{{0, 0, 0}, {1, 2, 3}, 0.51}));
  EXPECT_FALSE(objection_to(SphereProfile{{0, 0, 0}, 1.0, 1.0}));
  EXPECT_TRUE(objection_to(SphereProfile{{0, 0, 0}, 1.0, 1.01}));
  EXPECT_TRUE(objection_to(LayerProfile{1.0, 1.0}));
}

}  // namespace
}  // namespace tyndall
