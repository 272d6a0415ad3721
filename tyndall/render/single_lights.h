#pragma once
// A scene's lights as `single` takes them: lamps, suns, and fixed quadratures of what fills an angle.
#include <vector>

#include "tyndall/render/single.h"
#include "tyndall/render/single_airlight.h"

namespace tyndall {

/// Parallel light from the unit direction `toward` of irradiance [W/m^2] on a plane facing it.
struct SingleSun {
  Vector toward;
  Spectrum irradiance;
};

/// The surroundings in two parts: a smooth rest, known by direction, and the cells too bright for a fixed quadrature,
/// each gathered into a sun.
class SingleSky {
 public:
  static constexpr int columns = 64, rows = 32;
  /// A cell this many times as bright as the mean over the sphere becomes a sun, but for that much.
  static constexpr double bright = 8.0;

  SingleSky(const EnvironmentLight* light, int most_suns);

  bool empty() const { return light_ == nullptr; }
  /// As the eye sees it.
  Spectrum radiance(const Vector& direction) const;
  /// The smooth rest: means over cells of 5.6 degrees, interpolated.
  Spectrum smooth(const Vector& direction) const;
  const std::vector<SingleSun>& suns() const { return suns_; }

 private:
  const EnvironmentLight* light_;
  std::vector<Spectrum> mean_;  // of the smooth rest in each cell; empty for a constant radiance
  std::vector<SingleSun> suns_;
};

/// Point and spot lights of a scene, in that order.
std::vector<SingleLamp> lamps_of(const Scene& scene);

/// Suns of a scene; those with an angular diameter as rings x azimuth parallel ones of equal share, at the Gauss nodes
/// of 1 - cos.
std::vector<SingleSun> suns_of(const Scene& scene, int rings, int azimuth);

}  // namespace tyndall
