// Emissive surfaces in `single` against closed forms, fine sums, and paths of one bounce.
#include "tyndall/render/single.h"

#include <gtest/gtest.h>

#include "tyndall/render/bsdf.h"
#include "tyndall/render/path.h"
#include "tyndall/render/single_glow.h"
#include "tyndall/render/single_truth.h"
#include "tyndall/render/test_scenes.h"

namespace tyndall {
namespace {

using tests::add_material;
using tests::add_quad;
using tests::integral;
using tests::medium_of;
using tests::pi_number;
using tests::probe;

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
  EXPECT_NEAR(probe(scene, ray, 10.0).single[0] / truth, 1.0, 0.005);
  // Behind it: nothing, it glows on one side only.
  EXPECT_EQ(probe(scene, {{0, 4, 0}, {1, 0, 0}}, 10.0).single[0], 0.0);
}

/// Closer and closer to a glowing square, what a point gets is its solid angle (fluence) and its projected one (what a
/// surface reflects: summed up finely).
TEST(Single, AGlowingSquareIsItsSolidAngleAtAnyDistance) {
  for (const double height : {20.0, 2.0, 0.5, 0.1}) {
    Scene scene;
    add_quad(scene, {-1, height, -1}, {2, 0, 0}, {0, 0, 2},
             add_material(scene, Spectrum::grey(0.0), Spectrum::grey(3.0)));
    {
      const Geometry geometry(scene);
      const SingleContext context(scene, geometry);
      const double truth = 3.0 * 4.0 * std::asin(1.0 / (1.0 + height * height));
      EXPECT_NEAR(single_fluence(context, {0, 0, 0})[0] / truth, 1.0, 1e-4) << height;
      EXPECT_EQ(single_fluence(context, {0, height + 1.0, 0})[0], 0.0) << "it glows on one side";
    }
    for (const double x : {0.0, 0.8, 1.3, 6.0}) {
      for (const double roughness : {1.0, 0.3}) {
        Scene lit = scene;
        add_quad(lit, {-50, 0, 50}, {100, 0, 0}, {0, 0, -100}, add_material(lit, Spectrum::grey(0.5), {}, roughness));
        const Geometry geometry(lit);
        const Ray down{{x, 0.5 * height, 0.1}, normalized({0.4 * height, -0.5 * height, 0.1 * height})};
        const SurfacePoint floor = surface_point(geometry, *geometry.intersect(down));
        double truth = 0.0;
        constexpr int n = 600;
        for (int i = 0; i < n; ++i) {
          for (int j = 0; j < n; ++j) {
            const Vector way = Vector{-1 + (2 * i + 1.0) / n, height, -1 + (2 * j + 1.0) / n} - floor.position;
            const double squared = length_squared(way);
            truth += 3.0 * evaluate(floor, -down.direction, way / std::sqrt(squared))[0] * height /
                     (squared * std::sqrt(squared)) * 4.0 / (n * n);
          }
        }
        EXPECT_NEAR(probe(lit, down).surface[0] / truth, 1.0, 0.02) << height << " " << x << " " << roughness;
      }
    }
  }
}

/// A street: windows on both sides, near and far, of which a tree of posts hides some from a wet ground.
Scene window_street() {
  Scene scene;
  const int window = add_material(scene, Spectrum::grey(0.0), {{3.0, 2.0, 1.0}});
  const int shop = add_material(scene, Spectrum::grey(0.0), {{0.5, 0.7, 1.0}});
  for (int i = 0; i < 30; ++i) {
    const double z = -3.0 * i;
    add_quad(scene, {-4, 1.5, z}, {0, 0, -1}, {0, 1.4, 0}, window);
    if (i % 3 == 0) add_quad(scene, {4, 0.5, z - 2.0}, {0, 0, 2}, {0, 2, 0}, shop);
    if (i % 2 == 0) add_quad(scene, {-2.5, 0, z - 0.2}, {0.3, 0, 0}, {0, 4, 0});
  }
  add_quad(scene, {-4, 0, 10}, {8, 0, 0}, {0, 0, -110}, add_material(scene, Spectrum::grey(0.3), {}, 0.5));
  return scene;
}

TEST(Single, WindowsLightAStreetAsPathsOfOneBounceDo) {
  for (const bool foggy : {false, true}) {
    Scene scene = window_street();
    if (foggy) scene.medium = medium_of(Spectrum::grey(0.01), {}, HenyeyGreenstein<double>{0.8});
    const Geometry geometry(scene);
    SingleSettings settings;
    settings.emissive_points = 256;
    const SingleContext usual(scene, geometry), fine(scene, geometry, settings);
    const PathContext paths(scene, geometry, 1, 1.0);
    for (const Vector& direction : {Vector{0, -0.2, -1}, Vector{-0.3, -0.3, -1}, Vector{0.3, -0.1, -1},
                                    Vector{-0.35, -0.6, -0.4}, Vector{0, -0.05, -1}}) {
      const Ray ray{{0.5, 1.6, 2}, normalized(direction)};
      const ProbeEstimate truth = path_probe(paths, ray, infinity, 60000, 5, 2);
      const auto compare = [&](const SingleContext& context, double tolerance) {
        const PixelLayers layers = single_radiance(context, ray);
        const double value = layers.surface[1] + layers.single[1];
        EXPECT_NEAR(value, truth.radiance[1], 4.0 * truth.standard_error[1] + tolerance * truth.radiance[1])
            << foggy << " " << direction.x << " " << direction.y;
      };
      compare(usual, 0.03);
      compare(fine, 0.015);
    }
  }
}

TEST(SingleGlow, EveryCutIsTheWholeGlow) {
  Scene scene = window_street();
  add_quad(scene, {0, 5, 0}, {1, 0, 0}, {0, 0, 1}, add_material(scene, Spectrum::grey(0.0), Spectrum::grey(2.0)));
  scene.materials.back().double_sided = true;
  const GlowTree tree(scene);
  double power = 0.0, area = 0.0;  // two-sided: both sides count
  const Emitters emitters(scene);
  for (const EmissiveTriangle& t : emitters.triangles()) {
    area += t.area * (t.double_sided ? 2.0 : 1.0);
    power += t.area * mean(t.radiance) * (t.double_sided ? 2.0 : 1.0);
  }
  for (const std::size_t most : {1, 7, 60, 1000}) {
    std::vector<GlowPart> cut;
    cut_glow(
        tree, most, 1e-9,
        [](const GlowCell& cell) {
          return GlowValue{cell.intensity, cell.radius, {}};
        },
        cut);
    EXPECT_LE(cut.size(), most + 3);
    EXPECT_GE(cut.size(), most);
    double cut_power = 0.0, cut_area = 0.0;
    for (const GlowPart& part : cut) {
      cut_power += mean(part.cell.intensity);
      cut_area += part.cell.area;
      EXPECT_GE(part.cell.falloff(part.cell.axis), part.cell.falloff(-part.cell.axis));
    }
    EXPECT_NEAR(cut_power / power, 1.0, 1e-12);
    EXPECT_NEAR(cut_area / area, 1.0, 1e-12);
  }
}

}  // namespace
}  // namespace tyndall
