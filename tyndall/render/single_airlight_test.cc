// Airlight of `single` against published truth, closed forms and quadratures of another make.
#include "tyndall/render/single.h"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/shared_folder.h"
#include "tyndall/render/single_truth.h"
#include "tyndall/render/test_scenes.h"

namespace tyndall {
namespace {

using nlohmann::json;
using tests::add_material;
using tests::add_quad;
using tests::brute_force;
using tests::integral;
using tests::medium_of;
using tests::pi_number;
using tests::probe;

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

/// Light that leaves along the ray and comes straight back: int sigma p(-1) e^-(2 depth) / t^2 dt over what there is.
TEST(Single, ALampInAGapOfTheMediumOnTheRayIsSeenByWhatStandsAwayFromIt) {
  const double sigma = 0.4;
  const Law<double> law = HenyeyGreenstein<double>{0.6};
  const double back = density(law, Deflection<double>::from_mu(-1.0)),
               ahead = density(law, Deflection<double>::from_mu(1.0));
  for (const bool decaying : {false, true}) {
    std::vector<Profile> near = {BoxProfile{{2, -1, -1}, {5, 1, 1}}}, far = {SphereProfile{{9, 0, 0}, 1.5}};
    if (decaying) near.push_back(ExponentialProfile{3.0, 0.0});
    Scene scene;
    scene.medium = medium_of(Spectrum::grey(sigma), {}, law, near);
    scene.medium.species.push_back(medium_of(Spectrum::grey(sigma), {}, law, far).species[0]);
    const Ray ray{{0, 0, 0}, {1, 0, 0}};
    const auto column = [](double t) {  // of medium up to t
      return std::clamp(t - 2.0, 0.0, 3.0) + std::clamp(t - 7.5, 0.0, 3.0);
    };
    const auto light = [&](double lamp, double low, double high) {
      return integral(
          [&](double t) {
            const double way = column(t) + std::fabs(column(t) - column(lamp));
            return 8.0 * sigma * (t > lamp ? back : ahead) * std::exp(-sigma * way) / ((t - lamp) * (t - lamp));
          },
          low, high, 1e-13);
    };
    // At the eye, in the gap between box and ball, and beyond both.
    for (const double lamp : {0.0, 6.0, 12.0}) {
      scene.points = {{{lamp, 0, 0}, Spectrum::grey(8.0)}};
      const double truth = light(lamp, 2.0, 5.0) + light(lamp, 7.5, 10.5);
      EXPECT_NEAR(probe(scene, ray).single[0] / truth, 1.0, 1e-8) << lamp << decaying;
      // As good as there.
      scene.points[0].position.z = 1e-9;
      EXPECT_NEAR(probe(scene, ray).single[0] / truth, 1.0, 1e-7) << lamp << decaying;
    }
    scene.points.clear();
    scene.spots = {{{0, 0, 0}, {1, 0, 0}, Spectrum::grey(8.0), 10.0, 20.0}};
    EXPECT_NEAR(probe(scene, ray).single[0] / (light(0.0, 2.0, 5.0) + light(0.0, 7.5, 10.5)), 1.0, 1e-8);
    scene.spots[0].direction = {-1, 0, 0};
    EXPECT_EQ(probe(scene, ray).single[0], 0.0);
    // Where the medium begins at the lamp there is no end to it.
    scene.spots.clear();
    for (const double lamp : {2.0, 3.0, 5.0}) {
      scene.points = {{{lamp, 0, 0}, Spectrum::grey(8.0)}};
      EXPECT_TRUE(std::isinf(probe(scene, ray).single[0])) << lamp;
    }
  }
}

}  // namespace
}  // namespace tyndall
