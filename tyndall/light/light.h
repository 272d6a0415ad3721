#pragma once
// Lights without a surface: lamps, spots, the sun, and what surrounds the scene.
#include <memory>
#include <numbers>
#include <string_view>
#include <tuple>
#include <variant>
#include <vector>

#include "tyndall/color/spectrum.h"
#include "tyndall/geometry/vector.h"
#include "tyndall/number/field.h"

namespace tyndall {

/// How bright lights may be: squares and products of a few of these stay within double precision.
constexpr Range light_range{0.0, 1e30};

/// Same intensity [W/sr] per channel in all directions from a position [m].
struct PointLight {
  static constexpr std::string_view name = "point";
  static constexpr std::string_view text = "A small lamp shining alike in all directions.";
  Vector position;
  Spectrum intensity = Spectrum::grey(1.0);
  static constexpr auto fields() {
    return std::tuple{
        Field{"position", &PointLight::position, any_number, "m", "Where the lamp is.", Scaling::length, true},
        Field{"intensity", &PointLight::intensity, light_range, "W/sr", "Radiant intensity per channel.", Scaling::none,
              true}};
  }
};

/// A cone of light. Full intensity [W/sr] within inner_angle of the axis, none beyond outer_angle (degrees off axis);
/// between them glTF's falloff (KHR_lights_punctual). Equal angles are a hard edge.
struct SpotLight {
  static constexpr std::string_view name = "spot";
  static constexpr std::string_view text = "A lamp shining into a cone.";
  Vector position, direction{0.0, -1.0, 0.0};
  Spectrum intensity = Spectrum::grey(1.0);
  double inner_angle = 0.0, outer_angle = 45.0;
  static constexpr auto fields() {
    return std::tuple{
        Field{"position", &SpotLight::position, any_number, "m", "Where the lamp is.", Scaling::length, true},
        Field{"direction", &SpotLight::direction, any_number, "1", "Where it shines; need not be unit.", Scaling::none,
              true},
        Field{"intensity", &SpotLight::intensity, light_range, "W/sr", "On-axis radiant intensity per channel.",
              Scaling::none, true},
        Field{"inner_angle", &SpotLight::inner_angle, Range{0.0, 90.0}, "degrees",
              "Off axis, up to which it is fully bright."},
        Field{"outer_angle", &SpotLight::outer_angle, Range{0.0, 90.0, true, false}, "degrees",
              "Off axis, beyond which it is dark."}};
  }
};

/// Light from afar. direction is that of travel; irradiance [W/m^2] on a plane facing it; angular_diameter in degrees
/// (0: parallel).
struct SunLight {
  static constexpr std::string_view name = "sun";
  static constexpr std::string_view text = "Light from very far away, such as the sun.";
  Vector direction{0.0, -1.0, 0.0};
  Spectrum irradiance = Spectrum::grey(1.0);
  double angular_diameter = 0.0;
  static constexpr auto fields() {
    return std::tuple{Field{"direction", &SunLight::direction, any_number, "1",
                            "Direction in which the light travels; need not be unit.", Scaling::none, true},
                      Field{"irradiance", &SunLight::irradiance, light_range, "W/m^2",
                            "On a surface facing the sun, per channel.", Scaling::none, true},
                      Field{"angular_diameter", &SunLight::angular_diameter, Range{0.0, 90.0}, "degrees",
                            "Apparent size; the real sun's is 0.53."}};
  }
};

/// A picture of the surroundings: latitude-longitude, its centre looking along -Z, u growing toward +X, top row up.
/// Row-major.
struct Panorama {
  int width = 0, height = 0;
  std::vector<std::array<float, channel_count>> radiance;  // [W/(m^2 sr)]
};

/// Light from all around: a constant radiance, or a panorama turned by `rotation` degrees about +Y (counter-clockwise
/// seen from above), times `scale`.
struct EnvironmentLight {
  static constexpr std::string_view name = "environment";
  Spectrum radiance = Spectrum::grey(0.0);  // without a panorama
  Spectrum scale = Spectrum::grey(1.0);
  double rotation = 0.0;                     // degrees
  std::shared_ptr<const Panorama> panorama;  // null: constant
};

/// Fraction of a spot's on-axis intensity toward a point at cosine `cosine` off its axis (KHR_lights_punctual: squared
/// ramp in cosine).
inline double spot_falloff(const SpotLight& spot, double cosine) {
  const double degree = std::numbers::pi / 180.0;
  const double outer = std::cos(spot.outer_angle * degree), inner = std::cos(spot.inner_angle * degree);
  if (cosine >= inner) return 1.0;
  if (cosine <= outer) return 0.0;
  const double ramp = (cosine - outer) / (inner - outer);
  return ramp * ramp;
}

}  // namespace tyndall
