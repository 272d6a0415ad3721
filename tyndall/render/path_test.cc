// The path tracer against closed forms, published truth and the deterministic integrator. Every comparison states how
// many standard errors it allows; seeds are fixed.
#include "tyndall/render/path.h"

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "tests/shared_folder.h"
#include "tyndall/render/camera.h"
#include "tyndall/render/quick_exp.h"
#include "tyndall/render/render.h"
#include "tyndall/render/single.h"
#include "tyndall/render/test_scenes.h"

namespace tyndall {
namespace {

using nlohmann::json;
using tests::add_material;
using tests::add_quad;
using tests::medium_of;

double number(const json& x) { return x.is_string() ? std::stod(x.get<std::string>()) : x.get<double>(); }

json category(const std::filesystem::path& truth, const char* name) {
  std::ifstream in(truth);
  return json::parse(in).at(name).at("items");
}

void expect_within(double sigmas, const ProbeEstimate& e, const Spectrum& truth, const std::string& what) {
  for (std::size_t c = 0; c < channel_count; ++c) {
    EXPECT_LT(std::fabs(e.radiance[c] - truth[c]), sigmas * e.standard_error[c] + 1e-9 * truth[c])
        << what << " channel " << c << ": " << e.radiance[c] << " +- " << e.standard_error[c] << ", truth " << truth[c];
  }
}

/// Standard errors are to be less than either of what is given.
void expect_fluences(const std::filesystem::path& truth, std::uint32_t paths, double most_relative,
                     double most_absolute) {
  for (const json& item : category(truth, "point_source_fluence")) {
    const double albedo = number(item["albedo"]), r = number(item["r"]);
    Scene scene;
    scene.medium = medium_of(Spectrum::grey(albedo), Spectrum::grey(1.0 - albedo), Isotropic<double>{});
    scene.points.push_back({{0, 0, 0}, Spectrum::grey(1.0 / (4.0 * std::numbers::pi))});
    const Geometry geometry(scene);
    const PathContext context(scene, geometry, 0, 1.0);
    const ProbeEstimate e = path_fluence(context, {r, 0, 0}, paths, 11);
    expect_within(4.0, e, Spectrum::grey(number(item["fluence"])),
                  "albedo " + item["albedo"].dump() + " r " + item["r"].dump());
    EXPECT_LT(e.standard_error[0], most_relative * e.radiance[0]);
    EXPECT_LT(e.standard_error[0], most_absolute);
  }
}

TEST(PathTruth, FluenceOfAPointSourceInInfiniteMedium) {
  TYNDALL_NEEDS_SHARED_FILE(truth, "acceptance/public.json");
  expect_fluences(truth, 100000, 0.05, 3e-3);
}

TEST(PathTruthSoak, FluenceOfAPointSourceInInfiniteMedium) {
  TYNDALL_NEEDS_SHARED_FILE(truth, "acceptance/public.json");
  expect_fluences(truth, 6000000, 0.01, 3e-4);
}

TEST(PathTruth, AirlightOfPointAndSpotLights) {
  TYNDALL_NEEDS_SHARED_FILE(truth, "acceptance/public.json");
  const std::vector<std::pair<std::string, Law<double>>> laws = {{"isotropic", Isotropic<double>{}},
                                                                 {"rayleigh", Rayleigh<double>{}},
                                                                 {"hg0.7", HenyeyGreenstein<double>{0.7}},
                                                                 {"hazy", MieHazy<double>{}},
                                                                 {"murky", MieMurky<double>{}}};
  for (const char* kind : {"airlight_point", "airlight_spot"}) {
    for (const json& item : category(truth, kind)) {
      for (const auto& [name, law] : laws) {
        if (!item.contains(name)) continue;
        Scene scene;
        scene.medium = medium_of(Spectrum::grey(item["sigma_t"]), {}, law);
        if (item.contains("spot_pos")) {
          const auto& p = item["spot_pos"];
          const auto& d = item["spot_dir_unnormalised"];
          scene.spots.push_back({{p[0], p[1], p[2]},
                                 {d[0], d[1], d[2]},
                                 Spectrum::grey(1.0),
                                 item["half_angle_deg"],
                                 item["half_angle_deg"]});
        } else {
          scene.points.push_back({{item["a"], item["h"], 0}, Spectrum::grey(1.0)});
        }
        const Geometry geometry(scene);
        const PathContext context(scene, geometry, 1);
        const ProbeEstimate e = path_probe(context, {{0, 0, 0}, {1, 0, 0}}, item["d"], 40000, 5);
        expect_within(4.0, e, Spectrum::grey(number(item[name])),
                      std::string(kind) + " " + item["id"].dump() + " " + name);
        EXPECT_LT(e.standard_error[0], 0.01 * e.radiance[0]) << kind << " " << name;
      }
    }
  }
}

/// Nothing absorbs, everything shines 1: whatever is seen is 1, in every channel, through any mixture of media.
TEST(Path, AWhiteFurnaceStaysWhite) {
  Scene scene;
  scene.medium = medium_of({{0.3, 0.7, 1.7}}, {}, Rayleigh<double>{}, {SphereProfile{{0, 0, 0}, 2.0}});
  const Medium cloud = medium_of(Spectrum::grey(3.0), {}, HenyeyGreenstein<double>{0.85},
                                 {BoxProfile{{-1, -1, -1}, {1, 1, 1}}, ExponentialProfile{1.0, 0.0}});
  scene.medium.species.push_back(cloud.species[0]);
  scene.environment = EnvironmentLight{};
  scene.environment->radiance = Spectrum::grey(1.0);
  const Geometry geometry(scene);
  const PathContext context(scene, geometry);
  for (const double x : {0.0, 0.7, 1.3}) {
    expect_within(4.0, path_probe(context, {{x, 0.2, -5}, {0, 0, 1}}, infinity, 40000, 3), Spectrum::grey(1.0),
                  "furnace");
  }
}

/// Surfaces in a furnace may lose (one bounce between facets is all a rough metal gets: 1 - ln 2 at roughness 1), but
/// never make energy.
TEST(Path, SurfacesNeverMakeEnergy) {
  for (const double metallic : {0.0, 0.5, 1.0}) {
    for (const double roughness : {0.0, 0.2, 0.5, 1.0}) {
      Scene scene;
      add_quad(scene, {-50, 0, 50}, {100, 0, 0}, {0, 0, -100},
               add_material(scene, Spectrum::grey(1.0), {}, roughness, metallic));
      scene.environment = EnvironmentLight{};
      scene.environment->radiance = Spectrum::grey(1.0);
      const Geometry geometry(scene);
      const PathContext context(scene, geometry);
      for (const double x : {0.0, 3.0, 8.0}) {
        const Vector origin{x, 1.0, 0.0};
        const ProbeEstimate e = path_probe(context, {origin, normalized(-origin)}, infinity, 20000, 3);
        EXPECT_LT(e.radiance[0], 1.0 + 4.0 * e.standard_error[0] + 1e-9) << metallic << " " << roughness << " " << x;
        EXPECT_GT(e.radiance[0], 0.25) << metallic << " " << roughness << " " << x;
      }
    }
  }
}

/// One event at most is what `single` integrates without random numbers: both must agree, light by light, at every kind
/// of edge.
TEST(Path, LimitedToOneEventAgreesWithSingle) {
  const Scene busy = tests::busy_scene();
  for (const char* light : {"point", "spot", "sun", "sky", "panel"}) {
    Scene scene = busy;
    const std::string kind = light;
    if (kind != "point") scene.points.clear();
    if (kind != "spot") scene.spots.clear();
    if (kind != "sun") scene.suns.clear();
    if (kind != "sky") scene.environment.reset();
    if (kind != "panel") scene.materials[2].emission = {};
    const Geometry geometry(scene);
    const PathContext context(scene, geometry, 1);
    const SingleContext single(scene, geometry);
    // Lamps and sun are exact; the quadratures of sky and panel are measured: 2.5 and 1 % is what they are allowed.
    const double allowed = kind == "sky" ? 0.025 : kind == "panel" ? 0.01 : kind == "sun" ? 0.002 : 1e-6;
    for (const Vector& to : {Vector{0, 1.2, 0}, Vector{1.5, 2.0, -1}, Vector{-2, 0, -1}, Vector{0.5, 4.9, -5}}) {
      const Ray ray{scene.camera.position, normalized(to - scene.camera.position)};
      const ProbeEstimate e = path_probe(context, ray, infinity, 100000, 17);
      const PixelLayers exact = single_radiance(single, ray);
      const Spectrum truth = exact.surface + exact.single;
      for (std::size_t c = 0; c < channel_count; ++c) {
        EXPECT_LE(std::fabs(e.radiance[c] - truth[c]), 4.0 * e.standard_error[c] + allowed * truth[c])
            << light << " toward " << to.x << ": " << e.radiance[c] << " +- " << e.standard_error[c] << ", single "
            << truth[c];
        EXPECT_NEAR(e.transmittance[c], exact.transmittance[c], 1e-12);
      }
    }
  }
}

/// Without surfaces a path of n events has been scattered n times: what a limit of n events adds to one of n - 1 is the
/// light of order n.
TEST(Path, OrdersAreWhatLimitsOfEventsAdd) {
  Scene scene = tests::busy_scene();
  scene.meshes.clear();
  const Geometry geometry(scene);
  const Ray ray{scene.camera.position, normalized(Vector{-0.4, 0.9, -1.0} - scene.camera.position)};
  constexpr int samples = 30000;
  const PathContext all(scene, geometry);
  PathTracer tracer(all);
  std::array<Spectrum, 4> mean, square;
  for (std::uint32_t i = 0; i < samples; ++i) {
    RandomStream random(5, 0, i);
    const LightByOrder light = tracer.trace(ray, infinity, random).light;
    EXPECT_EQ(light.once_reflected, Spectrum{});
    const std::array<Spectrum, 4> orders{light.surface, light.once(), light.twice, light.more};
    for (std::size_t k = 0; k < 4; ++k) mean[k] += orders[k] / samples, square[k] += orders[k] * orders[k] / samples;
  }
  std::array<ProbeEstimate, 4> limited;
  for (std::size_t k = 1; k < 4; ++k) {
    const PathContext context(scene, geometry, k < 3 ? static_cast<int>(k) : 0);
    limited[k] = path_probe(context, ray, infinity, samples, 7 + k);
  }
  for (std::size_t c = 0; c < channel_count; ++c) {
    double below = mean[0][c], error_below = 0.0;  // what the eye sees unscattered has no noise here
    for (std::size_t k = 1; k < 4; ++k) {
      const double added = limited[k].radiance[c] - below, error = limited[k].standard_error[c];
      const double own = (square[k][c] - mean[k][c] * mean[k][c]) / samples;
      EXPECT_NEAR(mean[k][c], added, 4.0 * std::sqrt(own + error * error + error_below * error_below)) << k << c;
      EXPECT_GT(mean[k][c], 6.0 * std::sqrt(own)) << k << c;
      below = limited[k].radiance[c];
      error_below = error;
    }
  }
}

/// Spots are followed along their rays through the air, point lights are not: two strategies, one mean.
TEST(Path, TwoHalvesOfASphereAreAPointLight) {
  Scene scene;
  scene.medium = medium_of({{0.1, 0.2, 0.4}}, Spectrum::grey(0.02), HenyeyGreenstein<double>{0.7},
                           {BoxProfile{{-4, 0, -4}, {4, 5, 4}}});
  add_quad(scene, {-4, 0, 4}, {8, 0, 0}, {0, 0, -8}, add_material(scene, Spectrum::grey(0.6), {}, 0.4));
  Scene halves = scene;
  const Vector lamp{0.5, 2.0, 0.3}, axis{0.6, 0.0, 0.8};
  scene.points.push_back({lamp, Spectrum::grey(5.0)});
  for (const double side : {1.0, -1.0}) halves.spots.push_back({lamp, axis * side, Spectrum::grey(5.0), 90.0, 90.0});
  const Geometry geometry(scene), same(halves);
  for (const int max_depth : {0, 2}) {
    const PathContext whole(scene, geometry, max_depth), two(halves, same, max_depth);
    for (const Vector& to : {Vector{0.4, 1.9, 0}, Vector{2.0, 0, 1.0}, Vector{-3.0, 4.0, -2.0}}) {
      const Ray ray{{-3, 1.5, 6}, normalized(to - Vector{-3, 1.5, 6})};
      const ProbeEstimate a = path_probe(whole, ray, infinity, 60000, 6), b = path_probe(two, ray, infinity, 60000, 7);
      for (std::size_t c = 0; c < channel_count; ++c) {
        const double error = std::hypot(a.standard_error[c], b.standard_error[c]);
        EXPECT_LE(std::fabs(a.radiance[c] - b.radiance[c]), 4.0 * error) << to.x << " " << max_depth;
        EXPECT_LT(error, 0.1 * a.radiance[c]);
      }
    }
  }
}

TEST(Path, LearningWhereTheSunComesInBringsTheSameMeanWithLessNoise) {
  Scene scene = tests::dark_room();
  for (const bool air : {true, false}) {
    if (!air) scene.medium = {};
    for (const int max_depth : {0, 2}) {
      const Geometry geometry(scene);
      const PathContext blind(scene, geometry, max_depth);
      PathContext learned(scene, geometry, max_depth);
      const CameraRays camera(scene.camera, scene.film);
      learned.learn(camera, scene.film, 1 << 14, 5);
      double variance = 0.0, blind_variance = 0.0;
      for (const auto& [x, y] : {std::pair{3.0, 4.0}, {20.0, 3.0}, {12.0, 14.0}}) {
        const Ray ray = camera.through(x, y);
        const ProbeEstimate e = path_probe(learned, ray, infinity, 60000, 6),
                            b = path_probe(blind, ray, infinity, 60000, 7);
        for (std::size_t c = 0; c < channel_count; ++c) {
          const double error = std::hypot(e.standard_error[c], b.standard_error[c]);
          EXPECT_LE(std::fabs(e.radiance[c] - b.radiance[c]), 4.0 * error) << x << " " << y << " " << max_depth;
          variance += e.standard_error[c] * e.standard_error[c];
          blind_variance += b.standard_error[c] * b.standard_error[c];
        }
      }
      if (max_depth == 0) {
        EXPECT_LT(variance, 0.7 * blind_variance);
      }
    }
  }
}

std::vector<Plane> planes_with(int threads, std::uint32_t tile_order, const Scene& scene, const char* integrator) {
  const Geometry geometry(scene);
  RenderSettings settings;
  settings.integrator = integrator;
  settings.spp = 4;
  settings.threads = threads;
  settings.tile_order = tile_order;
  return render(scene, geometry, settings).planes;
}

TEST(Render, ThePictureDoesNotDependOnThreadsOrTileOrder) {
  Scene scene = tests::busy_scene();
  for (const char* integrator : {"path", "single"}) {
    if (integrator == std::string("single"))
      scene.film = {6, 4};  // its fixed quadratures of sky and panel take their time
    const std::vector<Plane> one = planes_with(1, 0, scene, integrator);
    ASSERT_EQ(one.size(), 28u);
    for (const auto& [threads, order] : {std::pair{2, 0u}, {3, 0u}, {7, 0u}, {2, 42u}, {7, 7u}}) {
      const std::vector<Plane> other = planes_with(threads, order, scene, integrator);
      for (std::size_t i = 0; i < one.size(); ++i) {
        EXPECT_EQ(0, std::memcmp(one[i].values.data(), other[i].values.data(), one[i].values.size() * sizeof(float)))
            << integrator << " " << one[i].name << " with " << threads << " threads, order " << order;
      }
    }
  }
}

TEST(Render, WhatIsLearnedDoesNotDependOnThreads) {
  const Scene scene = tests::dark_room();
  const std::vector<Plane> one = planes_with(1, 0, scene, "path"), other = planes_with(3, 5, scene, "path");
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(0, std::memcmp(one[i].values.data(), other[i].values.data(), one[i].values.size() * sizeof(float)));
  }
}

TEST(Render, EvenSamplesHaveTheMeanOfIndependentOnes) {
  Scene scene = tests::busy_scene();
  scene.camera.vertical_fov = 1e-4;  // all pixels look along one ray
  scene.film = {16, 16};
  const Geometry geometry(scene);
  RenderSettings settings;
  settings.integrator = "path";
  settings.spp = 64;
  settings.seed = 3;
  const Image image = render(scene, geometry, settings);
  const CameraRays camera(scene.camera, scene.film);
  const ProbeEstimate e = path_probe(PathContext(scene, geometry), camera.through(8.0, 8.0), infinity, 65536, 4);
  for (std::size_t c = 0; c < 3; ++c) {
    double sum = 0.0, squares = 0.0;
    for (double x : image.planes[c].values) sum += x, squares += x * x;
    const double n = 256.0, mean = sum / n, variance = (squares / n - mean * mean) / (n - 1.0);
    const double error = std::sqrt(variance + e.standard_error[c] * e.standard_error[c]);
    EXPECT_LT(std::fabs(mean - e.radiance[c]), 4.0 * error) << image.planes[c].name;
    EXPECT_LT(variance,
              1.3 * e.standard_error[c] * e.standard_error[c] * 4.0);  // of 64 samples; 256 pixels tell it to 9 %
  }
}

TEST(Render, QuickExpIsNearlyExp) {
  for (double x = -699.0; x < 700.0; x += 0.37) EXPECT_NEAR(quick_exp(x) / std::exp(x), 1.0, 6e-5) << x;
  EXPECT_EQ(quick_exp(-infinity), quick_exp(-700.0));
}

TEST(Render, LayersAddUpToTheBeautyAndAreFiniteAndNotNegative) {
  const Scene scene = tests::busy_scene();
  const Geometry geometry(scene);
  RenderSettings settings;
  settings.spp = 8;
  const Image image = render(scene, geometry, settings);
  const auto plane = [&](const char* name) -> const std::vector<float>& { return find_plane(image, name)->values; };
  double scattered = 0.0, all = 0.0;
  for (std::size_t i = 0; i < image.pixel_count(); ++i) {
    const float sum = plane("surface.G")[i] + plane("single.G")[i] + plane("multiple.G")[i];
    EXPECT_NEAR(plane("G")[i], sum, 1e-6f * std::max(1.0f, sum));
    EXPECT_GE(plane("G")[i], 0.0f);
    EXPECT_TRUE(std::isfinite(plane("G")[i]) && std::isfinite(plane("variance.G")[i]));
    EXPECT_GE(plane("transmittance.B")[i], 0.0f);
    EXPECT_LE(plane("transmittance.B")[i], 1.0f);
    EXPECT_GT(plane("depth.Z")[i], 0.0f);
    const float orders = plane("order1.G")[i] + plane("order2.G")[i] + plane("order3.G")[i];
    EXPECT_NEAR(sum, plane("surface.G")[i] + orders, 1e-6f * std::max(1.0f, sum));
    EXPECT_GE(plane("order1.G")[i], plane("single.G")[i] * (1.0f - 1e-6f));
    scattered += plane("single.G")[i] + plane("multiple.G")[i];
    all += plane("G")[i];
  }
  EXPECT_GT(scattered, 0.05 * all);
}

TEST(Render, TellsOfItsEndOnceAndOfAllSamplesTaken) {
  const Scene scene = tests::busy_scene();
  const Geometry geometry(scene);
  RenderSettings settings;
  settings.spp = 5;
  for (const char* integrator : {"path", "single"}) {
    settings.integrator = integrator;
    int ends = 0;
    const Image image =
        render(scene, geometry, settings, [&](const RenderProgress& p) { ends += p.fraction >= 1.0 ? 1 : 0; });
    EXPECT_EQ(ends, 1) << integrator;
    std::map<std::string, std::string> notes(image.notes.begin(), image.notes.end());
    EXPECT_EQ(notes["tyndall.spp"], "5");
    EXPECT_EQ(notes["tyndall.spp_taken"], "5");
    EXPECT_EQ(notes.count("tyndall.stopped"), 0u);
  }
}

TEST(Render, StoppingLeavesWhatIsThere) {
  const Scene scene = tests::busy_scene();
  const Geometry geometry(scene);
  RenderSettings settings;
  settings.spp = 1 << 20;
  settings.threads = 2;
  std::atomic<bool> stop{false};
  int reports = 0;
  const Image image = render(
      scene, geometry, settings,
      [&](const RenderProgress& p) {
        EXPECT_GE(p.fraction, 0.0);
        EXPECT_LT(p.fraction, 1.0) << "it was not finished";
        if (++reports == 2) stop = true;
      },
      &stop);
  EXPECT_EQ(image.notes.back().first, "tyndall.stopped");
  std::map<std::string, std::string> notes(image.notes.begin(), image.notes.end());
  EXPECT_EQ(notes["tyndall.spp"], std::to_string(settings.spp));
  const auto taken = notes["tyndall.spp_taken"];
  EXPECT_GE(std::stoi(taken), 1) << taken;
  EXPECT_LT(std::stoi(taken.substr(taken.find('-') + 1)), settings.spp) << taken;
  double sum = 0.0;
  for (const float x : find_plane(image, "G")->values) sum += x;
  EXPECT_GT(sum, 0.0);
}

}  // namespace
}  // namespace tyndall
