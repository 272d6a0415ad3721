#include "tyndall/render/single_lights.h"

#include <algorithm>
#include <numbers>
#include <numeric>

#include "tyndall/scene/panorama_sampling.h"

namespace tyndall {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

struct CellPlace {
  double column, row;  // in cells, from the left and top edge
};
CellPlace place_of(const Vector& d) {
  const double turns = std::atan2(d.x, -d.z) / two_pi + 0.5;
  const double polar = std::atan2(std::hypot(d.x, d.z), d.y) / std::numbers::pi;
  return {(turns - std::floor(turns)) * SingleSky::columns, polar * SingleSky::rows};
}
std::size_t index_of(int column, int row) {
  const int wrapped = (column % SingleSky::columns + SingleSky::columns) % SingleSky::columns;
  return static_cast<std::size_t>(std::clamp(row, 0, SingleSky::rows - 1) * SingleSky::columns + wrapped);
}

}  // namespace

SingleSky::SingleSky(const EnvironmentLight* light, int most_suns) : light_(light) {
  if (light == nullptr || !light->panorama) return;
  struct Gathered {
    Spectrum power;  // irradiance of the cell's pixels
    double solid_angle = 0.0;
    Vector middle;  // weighted by luminance
  };
  std::vector<Gathered> cells(static_cast<std::size_t>(columns) * rows);
  double whole = 0.0;
  for (const PanoramaSampler::Cell& pixel : PanoramaSampler(light).cells()) {
    const CellPlace at = place_of(pixel.direction);
    Gathered& cell = cells[index_of(static_cast<int>(at.column), static_cast<int>(at.row))];
    cell.power += pixel.irradiance;
    cell.solid_angle += pixel.solid_angle;
    cell.middle += pixel.direction * luminance(pixel.irradiance);
    whole += luminance(pixel.irradiance);
  }
  mean_.resize(cells.size());
  std::vector<std::size_t> order;
  const double limit = bright * whole / (2.0 * two_pi);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (cells[i].solid_angle > 0.0) {
      mean_[i] = cells[i].power / cells[i].solid_angle;
      if (luminance(mean_[i]) > limit) order.push_back(i);
    } else {
      // A panorama coarser than the cells: one pixel covers several.
      const std::size_t row = i / columns;
      const double polar = (static_cast<double>(row) + 0.5) * std::numbers::pi / rows;
      const double azimuth = ((static_cast<double>(i % columns) + 0.5) / columns - 0.5) * two_pi;
      mean_[i] = tyndall::radiance(
          *light, {std::sin(polar) * std::sin(azimuth), std::cos(polar), -std::sin(polar) * std::cos(azimuth)});
    }
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return luminance(cells[a].power) > luminance(cells[b].power); });
  if (order.size() > static_cast<std::size_t>(most_suns)) order.resize(static_cast<std::size_t>(most_suns));
  for (const std::size_t i : order) {
    const double kept = limit / luminance(mean_[i]);
    suns_.push_back({normalized(cells[i].middle), cells[i].power * (1.0 - kept)});
    mean_[i] *= kept;
  }
}

Spectrum SingleSky::radiance(const Vector& direction) const {
  return empty() ? Spectrum{} : tyndall::radiance(*light_, direction);
}

Spectrum SingleSky::smooth(const Vector& direction) const {
  if (empty()) return {};
  if (mean_.empty()) return tyndall::radiance(*light_, direction);
  const CellPlace at = place_of(direction);
  const double x = at.column - 0.5, y = at.row - 0.5;
  const int column = static_cast<int>(std::floor(x)), row = static_cast<int>(std::floor(y));
  const double right = x - column, below = y - row;
  return (mean_[index_of(column, row)] * (1.0 - right) + mean_[index_of(column + 1, row)] * right) * (1.0 - below) +
         (mean_[index_of(column, row + 1)] * (1.0 - right) + mean_[index_of(column + 1, row + 1)] * right) * below;
}

std::vector<SingleLamp> lamps_of(const Scene& scene) {
  std::vector<SingleLamp> lamps;
  for (const PointLight& point : scene.points) {
    SingleLamp lamp;
    lamp.position = point.position;
    lamp.intensity = point.intensity;
    lamps.push_back(lamp);
  }
  for (const SpotLight& spot : scene.spots) {
    SingleLamp lamp;
    lamp.shape = SingleLamp::Shape::spot;
    lamp.position = spot.position;
    lamp.intensity = spot.intensity;
    lamp.axis = normalized(spot.direction);
    lamp.spot = spot;
    lamps.push_back(lamp);
  }
  return lamps;
}

std::vector<SingleSun> suns_of(const Scene& scene, int rings, int azimuth) {
  std::vector<SingleSun> suns;
  for (const SunLight& sun : scene.suns) {
    const Vector toward = -normalized(sun.direction);
    if (sun.angular_diameter == 0.0) {
      suns.push_back({toward, sun.irradiance});
      continue;
    }
    const Frame frame = Frame::around(toward);
    const double sine = std::sin(0.25 * sun.angular_diameter * std::numbers::pi / 180.0);
    for (const QuadraturePoint& ring : gauss_legendre(rings)) {
      const double v = 2.0 * sine * sine * ring.node;  // 1 - cos, uniform over the disc
      const double s = std::sqrt(v * (2.0 - v));
      for (int k = 0; k < azimuth; ++k) {
        const double angle = two_pi * (k + 0.5) / azimuth;
        suns.push_back({normalized(frame.to_world({s * std::cos(angle), s * std::sin(angle), 1.0 - v})),
                        sun.irradiance * (ring.weight / azimuth)});
      }
    }
  }
  return suns;
}

}  // namespace tyndall
