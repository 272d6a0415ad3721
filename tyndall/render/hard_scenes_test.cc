// Scenes at the ends of what may be asked for: whatever they are, pictures hold numbers, none of them negative.
#include <gtest/gtest.h>

#include <cmath>

#include "tyndall/artist/dials.h"
#include "tyndall/render/render.h"
#include "tyndall/render/test_scenes.h"

namespace tyndall {
namespace {

using tests::add_material;
using tests::add_quad;
using tests::medium_of;

/// The scene in units of `factor` metres: the same picture, if numbers were exact.
Scene enlarged(Scene scene, double factor) {
  for (Mesh& mesh : scene.meshes) {
    for (auto& p : mesh.positions) {
      for (float& x : p) x = static_cast<float>(x * factor);
    }
  }
  for (PointLight& light : scene.points) light = in_metres(light, factor);
  for (SpotLight& light : scene.spots) light = in_metres(light, factor);
  for (Species& s : scene.medium.species) {
    s.scattering *= 1.0 / factor;
    s.absorption *= 1.0 / factor;
    for (Profile& profile : s.profiles) {
      std::visit([&](auto& p) { p = in_metres(p, factor); }, profile);
    }
  }
  scene.camera = in_metres(scene.camera, factor);
  return scene;
}

void expect_numbers(Scene scene, const std::string& what,
                    std::initializer_list<const char*> integrators = {"path", "single"}) {
  for (const char* integrator : integrators) {
    scene.film = std::string(integrator) == "path" ? Film{12, 8} : Film{3, 2};
    RenderSettings settings;
    settings.integrator = integrator;
    settings.spp = 4;
    const Geometry geometry(scene);
    const Image image = render(scene, geometry, settings);
    for (const Plane& plane : image.planes) {
      if (plane.name == "depth.Z") continue;
      for (std::size_t i = 0; i < plane.values.size(); ++i) {
        ASSERT_TRUE(std::isfinite(plane.values[i]) && plane.values[i] >= 0.0f)
            << what << ", " << integrator << ": " << plane.name << " of pixel " << i << " is " << plane.values[i];
      }
    }
  }
}

/// A floor, a panel, a lamp, a spot, a sun and a sky, without air.
Scene lit_floor() {
  Scene scene;
  add_quad(scene, {-5, 0, 5}, {10, 0, 0}, {0, 0, -10}, add_material(scene, {{0.6, 0.5, 0.4}}, {}, 0.2));
  add_quad(scene, {-1, 3, -2}, {1, 0, 0}, {0, 0, 1}, add_material(scene, {}, {{4.0, 3.0, 2.0}}));
  scene.points.push_back({{2, 2, -1}, {{3.0, 2.0, 1.0}}});
  scene.spots.push_back({{-3, 4, 0}, normalized({0.5, -1, -0.2}), Spectrum::grey(8.0), 10, 25});
  scene.suns.push_back({normalized({0.3, -1, -0.5}), Spectrum::grey(0.5), 0.5});
  scene.environment.emplace().radiance = {{0.1, 0.15, 0.25}};
  scene.camera = {{0, 1.5, 6}, {0, 1.2, 0}, {0, 1, 0}, 45.0};
  return scene;
}

TEST(HardScenes, MediaFromNextToNothingToSolid) {
  for (const double sigma : {1e-12, 1e-6, 1e-2, 1.0, 1e3, 1e6}) {
    for (const double albedo : {0.0, 0.5, 1.0}) {
      for (const double g : {-0.9999, 0.0, 0.9999}) {
        Scene scene = lit_floor();
        scene.medium =
            medium_of(Spectrum{{sigma * albedo, sigma * albedo, 0.0}}, Spectrum::grey(sigma * (1.0 - albedo)),
                      HenyeyGreenstein<double>{g}, {BoxProfile{{-4, 0, -4}, {4, 3, 7}}});
        expect_numbers(scene, "sigma " + std::to_string(sigma) + ", albedo " + std::to_string(albedo) + ", g " +
                                  std::to_string(g));
      }
    }
  }
}

TEST(HardScenes, LawsAtTheirEnds) {
  const std::vector<Law<double>> laws = {
      Draine<double>{0.9999, 0.0},
      Draine<double>{-0.9, 1e6},
      FournierForand<double>{1.0001, 3.0001},
      Droplet<double>{50.0},
      Schlick<double>{0.9999},
      CornetteShanks<double>{-0.9999},
      Mixture<double>{{{1.0, HenyeyGreenstein<double>{0.9999}}, {1e-9, HenyeyGreenstein<double>{-0.9999}}}}};
  for (const Law<double>& law : laws) {
    Scene scene = lit_floor();
    scene.medium = medium_of(Spectrum::grey(0.3), {}, law, {BoxProfile{{-4, -1, -4}, {4, 3, 7}}});
    expect_numbers(scene, "law " + std::to_string(law.index()));
  }
}

TEST(HardScenes, LampsInsideSurfacesAtCornersAndInTheCamera) {
  for (const Vector& place : {Vector{0, 0, 0}, {2, 0, 1}, {-5, 0, 5}, {0, -1, 0}, {0, 1.5, 6}, {0, 1.35, 3}}) {
    Scene scene = lit_floor();
    scene.points[0].position = place;
    scene.spots[0].position = place;
    scene.medium = medium_of(Spectrum::grey(0.2), Spectrum::grey(0.01), HenyeyGreenstein<double>{0.8},
                             {SphereProfile{place, 1.0}});
    expect_numbers(scene, "lamps at " + std::to_string(place.x) + ' ' + std::to_string(place.y));
  }
}

TEST(HardScenes, MediaOfNoSize) {
  const std::vector<Profile> places = {
      BoxProfile{{0, 1, 0}, {0, 1, 0}}, BoxProfile{{-1, 1, -1}, {1, 1, 1}}, BoxProfile{{0, 1, 0}, {1e-300, 1.1, 1}},
      SphereProfile{{0, 1, 0}, 1e-300}, SphereProfile{{0, 1.5, 6}, 1e-9},   LayerProfile{1.0, std::nextafter(1.0, 2.0)},
      ExponentialProfile{1e-9, 0.0},    ExponentialProfile{1e12, 0.0},      TentProfile{1.0, 1e-12}};
  for (const Profile& place : places) {
    Scene scene = lit_floor();
    scene.medium = medium_of(Spectrum::grey(0.5), Spectrum::grey(0.1), MieMurky<double>{},
                             {place, BoxProfile{{-4, -1, -4}, {4, 3, 7}}});
    expect_numbers(scene, "profile " + std::to_string(place.index()));
  }
}

TEST(HardScenes, NoiseFinerThanCanBeFollowed) {
  Scene scene = lit_floor();
  scene.medium = medium_of(Spectrum::grey(0.5), Spectrum::grey(0.1), MieMurky<double>{},
                           {NoiseProfile{1e-6, 2, 1.0, 3, {1e9, 0, 0}}, BoxProfile{{-4, -1, -4}, {4, 3, 7}}});
  expect_numbers(scene, "noise", {"path"});  // thousands of pieces on each of thousands of rays of `single`
}

TEST(HardScenes, FromANanometreToAMillionKilometres) {
  for (const double factor : {1e-9, 1e-3, 1e4, 1e9}) {
    expect_numbers(enlarged(tests::busy_scene(), factor), "units of " + std::to_string(factor) + " m");
  }
}

TEST(HardScenes, TheCameraInsideEverything) {
  Scene scene = lit_floor();
  for (int i = 0; i < 20; ++i) {
    const double size = 0.01 * (1 << i);
    const Vector half{size, size, size};
    const Medium more =
        medium_of({{0.01, 0.02, 0.05}}, Spectrum::grey(0.01), Rayleigh<double>{},
                  {i % 2 == 0 ? Profile{SphereProfile{scene.camera.position, size, 0.3 * size}}
                              : Profile{BoxProfile{scene.camera.position - half, scene.camera.position + half}}});
    scene.medium.species.push_back(more.species[0]);
  }
  expect_numbers(scene, "twenty media");
}

TEST(HardScenes, SurfacesWithoutArea) {
  Scene scene = lit_floor();
  const int panel = 1;
  add_quad(scene, {1, 1, 0}, {0, 0, 0}, {0, 0, 0}, panel);
  add_quad(scene, {1, 1, 0}, {1, 0, 0}, {1, 0, 0}, panel);
  add_quad(scene, {1, 2, 0}, {1e-20, 0, 0}, {0, 1e-20, 0}, panel);
  scene.medium = medium_of(Spectrum::grey(0.1), {}, HenyeyGreenstein<double>{0.7}, {ExponentialProfile{3.0, 0.0}});
  expect_numbers(scene, "panels of no area");
}

TEST(HardScenes, LightsFromFaintToBlinding) {
  for (const double factor : {1e-30, 1e-12, 1e12, 1e25}) {
    Scene scene = tests::busy_scene();
    for (PointLight& light : scene.points) light.intensity *= factor;
    for (SpotLight& light : scene.spots) light.intensity *= factor;
    for (SunLight& sun : scene.suns) sun.irradiance *= factor;
    for (Material& material : scene.materials) material.emission *= factor;
    scene.environment->radiance *= factor;
    expect_numbers(scene, "light times " + std::to_string(factor));
  }
}

}  // namespace
}  // namespace tyndall
