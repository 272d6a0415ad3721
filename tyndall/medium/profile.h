#pragma once
// Density profiles: how a species' coefficients vary in space, as a factor.
#include <string_view>
#include <tuple>
#include <variant>

#include "tyndall/geometry/shape.h"
#include "tyndall/number/field.h"

namespace tyndall {

/// The same everywhere.
struct ConstantProfile {
  static constexpr std::string_view name = "constant";
  static constexpr std::string_view text = "The same density everywhere.";
  static constexpr auto fields() { return std::tuple<>{}; }
};

/// exp(-(y - base) / scale_height): 1 at height base, thinner above, thicker below. Heights are world y [m].
struct ExponentialProfile {
  static constexpr std::string_view name = "exponential";
  static constexpr std::string_view text = "Thins with height: by a factor e for every scale height.";
  double scale_height = 100.0, base = 0.0;
  static constexpr auto fields() {
    return std::tuple{Field{"scale_height", &ExponentialProfile::scale_height, positive, "m",
                            "Height over which the density falls by a factor e.", Scaling::length, true},
                      Field{"base", &ExponentialProfile::base, any_number, "m",
                            "Height at which the density is as stated.", Scaling::length}};
  }
};

/// 1 inside an axis-aligned box, 0 outside.
struct BoxProfile {
  static constexpr std::string_view name = "box";
  static constexpr std::string_view text = "Fills an axis-aligned box.";
  Vector min{-1.0, -1.0, -1.0}, max{1.0, 1.0, 1.0};
  Box shape() const { return {min, max}; }
  static constexpr auto fields() {
    return std::tuple{
        Field{"min", &BoxProfile::min, any_number, "m", "Corner with the least coordinates.", Scaling::length, true},
        Field{"max", &BoxProfile::max, any_number, "m", "Corner with the greatest coordinates.", Scaling::length,
              true}};
  }
};

/// 1 inside a sphere, 0 outside.
struct SphereProfile {
  static constexpr std::string_view name = "sphere";
  static constexpr std::string_view text = "Fills a sphere.";
  Vector center;
  double radius = 1.0;
  Sphere shape() const { return {center, radius}; }
  static constexpr auto fields() {
    return std::tuple{
        Field{"center", &SphereProfile::center, any_number, "m", "Centre of the sphere.", Scaling::length, true},
        Field{"radius", &SphereProfile::radius, positive, "m", "Radius of the sphere.", Scaling::length, true}};
  }
};

/// The closed list of profiles.
using Profile = std::variant<ConstantProfile, ExponentialProfile, BoxProfile, SphereProfile>;

/// The factor at a point, >= 0.
inline double factor(const Profile& profile, const Vector& p) {
  struct At {
    const Vector& p;
    double operator()(const ConstantProfile&) const { return 1.0; }
    double operator()(const ExponentialProfile& e) const { return std::exp(-(p.y - e.base) / e.scale_height); }
    double operator()(const BoxProfile& b) const { return contains(b.shape(), p) ? 1.0 : 0.0; }
    double operator()(const SphereProfile& s) const { return contains(s.shape(), p) ? 1.0 : 0.0; }
  };
  return std::visit(At{p}, profile);
}

}  // namespace tyndall
