// Fluence of at most one scattering: every light's own radiance is integrated over directions counted from that light,
// where it is singular or peaked.
#include <numbers>

#include "tyndall/render/single_ray.h"

namespace tyndall {
namespace {

constexpr int azimuth_count = 24;
constexpr std::array<double, 7> angle_breaks = {0.0, 1e-3, 0.01, 0.1, 0.5, 0.5 * std::numbers::pi, std::numbers::pi};

/// int over all directions of radiance(direction), by Gauss-Legendre in the angle from `pole` and even azimuths.
template <class Radiance>
Spectrum around_pole(const Vector& pole, const Radiance& radiance) {
  const Frame frame = Frame::around(pole);
  const std::vector<QuadraturePoint> rule = gauss_legendre(8);
  Spectrum sum;
  for (std::size_t i = 0; i + 1 < angle_breaks.size(); ++i) {
    const double span = angle_breaks[i + 1] - angle_breaks[i];
    for (const QuadraturePoint& q : rule) {
      const double angle = angle_breaks[i] + span * q.node, sine = std::sin(angle), cosine = std::cos(angle);
      Spectrum ring;
      for (int k = 0; k < azimuth_count; ++k) {
        const double azimuth = 2.0 * std::numbers::pi * (k + 0.5) / azimuth_count;
        ring += radiance(normalized(frame.to_world({sine * std::cos(azimuth), sine * std::sin(azimuth), cosine})));
      }
      sum += ring * (2.0 * std::numbers::pi / azimuth_count * sine * span * q.weight);
    }
  }
  return sum;
}

}  // namespace

Spectrum single_fluence(const SingleContext& context, const Vector& point) {
  const SingleContext::Prepared& prepared = context.prepared();
  std::vector<Stretch> scratch;
  Spectrum sum;
  SingleRay eye(prepared);
  for (std::size_t i = 0; i < prepared.lamps.size(); ++i) {
    const SingleLamp& lamp = prepared.lamps[i];
    const Vector way = lamp.position - point;
    const double squared = length_squared(way);
    if (squared == 0.0) {
      sum += map(lamp.intensity, [](double x) { return x > 0.0 ? infinity : 0.0; });
      continue;
    }
    const Vector toward = way / std::sqrt(squared);
    if (!prepared.geometry.occluded(point, lamp.position)) {
      const Spectrum depth = depth_between(prepared.medium.lowered, point, lamp.position, scratch);
      sum += lamp.intensity * exp(depth * -1.0) * (lamp.falloff(-toward) / squared);
    }
    sum += around_pole(toward, [&](const Vector& direction) {
      eye.set({point, direction}, infinity);
      return eye.from_lamp(i);
    });
  }
  for (std::size_t i = 0; i < prepared.suns.size(); ++i) {
    const SingleSun& sun = prepared.suns[i];
    if (!prepared.geometry.occluded(Ray{point, sun.toward})) {
      stretches_along(prepared.medium.lowered, {point, sun.toward}, infinity, scratch);
      sum += sun.irradiance * exp(optical_depth(scratch, infinity) * -1.0);
    }
    sum += around_pole(sun.toward, [&](const Vector& direction) {
      eye.set({point, direction}, infinity);
      return eye.from_sun(i);
    });
  }
  sum += eye.glow_around(point);
  // What is left has no one direction to count from: reflecting surfaces, the sky, and what sky and glow scatter.
  return sum + around_pole({0.0, 1.0, 0.0}, [&](const Vector& direction) {
           eye.set({point, direction}, infinity);
           return eye.surface(false) + eye.from_glow() + eye.from_sky();
         });
}

}  // namespace tyndall
