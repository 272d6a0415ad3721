#include "tyndall/render/single.h"

#include <algorithm>
#include <cstdio>
#include <numbers>

#include "tyndall/render/camera.h"
#include "tyndall/render/single_ray.h"

namespace tyndall {

SingleContext::SingleContext(const Scene& scene, const Geometry& geometry, const SingleSettings& settings)
    : prepared_(std::make_unique<Prepared>(scene, geometry, settings)) {}
SingleContext::~SingleContext() = default;

PixelLayers single_radiance(const SingleContext& context, const Ray& ray, double distance) {
  SingleRay eye(context.prepared());
  eye.set(ray, distance);
  PixelLayers layers{eye.surface(), eye.from_the_rest(), eye.transmittance(), eye.depth()};
  for (std::size_t i = 0; i < context.prepared().lamps.size(); ++i) layers.single += eye.from_lamp(i);
  return layers;
}

namespace {

struct FilmPoint {
  double x, y;
};

/// Where a point is seen on the film, if it is in front of the camera.
std::optional<FilmPoint> on_film(const Scene& scene, const Vector& p) {
  const Vector forward = normalized(scene.camera.look_at - scene.camera.position);
  const Vector right = normalized(cross(forward, scene.camera.up)), up = cross(right, forward);
  const Vector way = p - scene.camera.position;
  const double ahead = dot(way, forward);
  if (!(ahead > 0.0)) return std::nullopt;
  const double half_height = std::tan(0.5 * scene.camera.vertical_fov * std::numbers::pi / 180.0);
  const double per_pixel = 2.0 * half_height / scene.film.height * ahead;
  return FilmPoint{0.5 * scene.film.width + dot(way, right) / per_pixel,
                   0.5 * scene.film.height - dot(way, up) / per_pixel};
}

/// Points per side of the fan triangles around a lamp, and per side of a pixel near one.
constexpr int fan_points = 6, near_points = 4;
/// Pixels, from its centre, within which a lamp's 1/angle asks for more than the ordinary grid.
constexpr double near_distance = 2.5;

/// Mean over the pixel [x, x+1] x [y, y+1] of a lamp's airlight, the lamp being seen in it. The pixel is cut into four
/// triangles that meet at the lamp; on each, with p = lamp + s (edge(u) - lamp), dA = 2 area s ds du, and s cancels
/// the 1/angle of the radiance.
template <class Light>
Spectrum fan_mean(const FilmPoint& lamp, int x, int y, const Light& light) {
  static const std::vector<QuadraturePoint> rule = gauss_legendre(fan_points);
  const FilmPoint corner[5] = {
      {x + 0.0, y + 0.0}, {x + 1.0, y + 0.0}, {x + 1.0, y + 1.0}, {x + 0.0, y + 1.0}, {x + 0.0, y + 0.0}};
  Spectrum sum;
  for (int i = 0; i < 4; ++i) {
    const FilmPoint &a = corner[i], &b = corner[i + 1];
    const double twice_area = std::fabs((a.x - lamp.x) * (b.y - lamp.y) - (a.y - lamp.y) * (b.x - lamp.x));
    if (!(twice_area > 0.0)) continue;
    for (const QuadraturePoint& u : rule) {
      const FilmPoint edge{a.x + u.node * (b.x - a.x), a.y + u.node * (b.y - a.y)};
      for (const QuadraturePoint& s : rule) {
        const double weight = twice_area * u.weight * s.weight * s.node;
        sum += light(lamp.x + s.node * (edge.x - lamp.x), lamp.y + s.node * (edge.y - lamp.y)) * weight;
      }
    }
  }
  return sum;
}

}  // namespace

PixelLayers single_pixel(const SingleContext& context, int x, int y, int spp) {
  const SingleContext::Prepared& prepared = context.prepared();
  const CameraRays camera(prepared.scene.camera, prepared.scene.film);
  SingleRay eye(prepared);
  PixelLayers layers;
  const int side = std::max(1, static_cast<int>(std::ceil(std::sqrt(static_cast<double>(spp)) - 1e-9)));
  // Lamps in the pixel or close by are integrated apart.
  std::vector<std::size_t> ordinary, near;
  const auto light_of = [&](std::size_t lamp) {
    return [&eye, &camera, lamp](double fx, double fy) {
      eye.set(camera.through(fx, fy), infinity);
      return eye.from_lamp(lamp);
    };
  };
  for (std::size_t i = 0; i < prepared.lamps.size(); ++i) {
    const auto seen = on_film(prepared.scene, prepared.lamps[i].position);
    if (!seen || std::fabs(seen->x - x - 0.5) > near_distance || std::fabs(seen->y - y - 0.5) > near_distance) {
      ordinary.push_back(i);
    } else if (seen->x >= x && seen->x <= x + 1 && seen->y >= y && seen->y <= y + 1) {
      layers.single += fan_mean(*seen, x, y, light_of(i));
    } else if (side < near_points) {
      near.push_back(i);
    } else {
      ordinary.push_back(i);
    }
  }
  if (!near.empty()) {
    const std::vector<QuadraturePoint> rule = gauss_legendre(near_points);
    for (const QuadraturePoint& u : rule) {
      for (const QuadraturePoint& v : rule) {
        eye.set(camera.through(x + u.node, y + v.node), infinity);
        for (const std::size_t i : near) layers.single += eye.from_lamp(i) * (u.weight * v.weight);
      }
    }
  }
  const double weight = 1.0 / (side * side);
  for (int j = 0; j < side; ++j) {
    for (int i = 0; i < side; ++i) {
      eye.set(camera.through(x + (i + 0.5) / side, y + (j + 0.5) / side), infinity);
      layers.surface += eye.surface() * weight;
      layers.single += eye.from_the_rest() * weight;
      for (const std::size_t lamp : ordinary) layers.single += eye.from_lamp(lamp) * weight;
      layers.transmittance += eye.transmittance() * weight;
    }
  }
  eye.set(camera.through(x + 0.5, y + 0.5), infinity);
  layers.depth = eye.depth();
  return layers;
}

std::string single_description(const SingleSettings& s) {
  char text[512];
  std::snprintf(text, sizeof text,
                "point, spot and parallel sun lights: exact shadows, closed forms or panels to %.0e; suns with a disc: "
                "%d x %d directions; sky: at most %d suns, %d directions in media with shadows at %d places, %d on "
                "surfaces; emissive "
                "surfaces: cut into at most %d cells per ray, %d per surface point",
                s.tolerance, s.sun_rings, s.sun_azimuth, s.sky_suns, s.sky_directions, s.sky_shadows,
                s.surface_directions, 2 * s.emissive_points, 4 * s.emissive_points);
  return text;
}

}  // namespace tyndall
