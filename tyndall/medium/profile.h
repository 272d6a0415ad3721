#pragma once
// Density profiles: how a species' coefficients vary in space, as a factor.
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <variant>

#include "tyndall/geometry/brick_grid.h"
#include "tyndall/geometry/shape.h"
#include "tyndall/medium/noise.h"
#include "tyndall/number/described.h"
#include "tyndall/number/grid_file.h"

namespace tyndall {

/// The same everywhere.
struct ConstantProfile {
  static constexpr std::string_view name = "constant";
  static constexpr std::string_view text = "The same density everywhere.";
  bool operator==(const ConstantProfile&) const = default;
  static constexpr auto fields() { return std::tuple<>{}; }
};

/// exp(-(y - base) / scale_height): 1 at height base, thinner above, thicker below. Heights are world y [m].
struct ExponentialProfile {
  static constexpr std::string_view name = "exponential";
  static constexpr std::string_view text = "Thins with height: by a factor e for every scale height.";
  double scale_height = 100.0, base = 0.0;
  bool operator==(const ExponentialProfile&) const = default;
  static constexpr auto fields() {
    return std::tuple{Field{"scale_height", &ExponentialProfile::scale_height, positive, "m",
                            "Height over which the density falls by a factor e.", Scaling::length, true},
                      Field{"base", &ExponentialProfile::base, any_number, "m",
                            "Height at which the density is as stated.", Scaling::length}};
  }
};

/// 1 for bottom <= y <= top, 0 elsewhere. Heights are world y [m].
struct LayerProfile {
  static constexpr std::string_view name = "layer";
  static constexpr std::string_view text = "The same density between two heights, nothing elsewhere.";
  double bottom = 0.0, top = 100.0;
  bool operator==(const LayerProfile&) const = default;
  static constexpr auto fields() {
    return std::tuple{
        Field{"bottom", &LayerProfile::bottom, any_number, "m", "Height where it begins.", Scaling::length, true},
        Field{"top", &LayerProfile::top, any_number, "m", "Height where it ends, above bottom.", Scaling::length,
              true}};
  }
};

/// 1 - |y - centre| / half_width, 0 where that is negative: the shape of the ozone layer (centre 25 km, half_width 15
/// km; Bruneton and Neyret 2008 in the form of Bruneton 2017). Heights are world y [m].
struct TentProfile {
  static constexpr std::string_view name = "tent";
  static constexpr std::string_view text = "Thins evenly to nothing above and below a height, as ozone does.";
  double centre = 0.0, half_width = 100.0;
  bool operator==(const TentProfile&) const = default;
  static constexpr auto fields() {
    return std::tuple{Field{"centre", &TentProfile::centre, any_number, "m", "Height where the density is as stated.",
                            Scaling::length, true},
                      Field{"half_width", &TentProfile::half_width, positive, "m",
                            "How far above and below the centre there is nothing left.", Scaling::length, true}};
  }
};

/// 1 inside an axis-aligned box, 0 outside. With a feather, the density rises inside each face from 0 to 1 over that
/// length as the smoothstep 3 x^2 - 2 x^3 of the distance to the face; faces multiply. At most half the shortest edge.
struct BoxProfile {
  static constexpr std::string_view name = "box";
  static constexpr std::string_view text = "Fills an axis-aligned box, to its faces or fading before them.";
  Vector min{-1.0, -1.0, -1.0}, max{1.0, 1.0, 1.0};
  double feather = 0.0;
  Box shape() const { return {min, max}; }
  bool operator==(const BoxProfile&) const = default;
  static constexpr auto fields() {
    return std::tuple{
        Field{"min", &BoxProfile::min, any_number, "m", "Corner with the least coordinates.", Scaling::length, true},
        Field{"max", &BoxProfile::max, any_number, "m", "Corner with the greatest coordinates, each above that of min.",
              Scaling::length, true},
        Field{"feather", &BoxProfile::feather, not_negative, "m",
              "Depth inside the faces over which it fades in; at most half the shortest edge.", Scaling::length}};
  }
};

/// 1 inside a sphere, 0 outside. With a feather, the density rises inside the surface from 0 to 1 over that length as
/// the smoothstep of (R^2 - r^2) / (R^2 - (R - feather)^2): along any ray that is a polynomial. At most the radius.
struct SphereProfile {
  static constexpr std::string_view name = "sphere";
  static constexpr std::string_view text = "Fills a sphere, to its surface or fading before it.";
  Vector center;
  double radius = 1.0, feather = 0.0;
  Sphere shape() const { return {center, radius}; }
  bool operator==(const SphereProfile&) const = default;
  static constexpr auto fields() {
    return std::tuple{
        Field{"center", &SphereProfile::center, any_number, "m", "Centre of the sphere.", Scaling::length, true},
        Field{"radius", &SphereProfile::radius, positive, "m", "Radius of the sphere.", Scaling::length, true},
        Field{"feather", &SphereProfile::feather, not_negative, "m",
              "Depth inside the surface over which it fades in; at most the radius.", Scaling::length}};
  }
};

/// Uneven density: smooth lattice noise (medium/noise.h) between 1 - contrast and 1 + contrast, with mean 1. Its
/// largest features are `scale` across, each further octave half as large and half as strong. Wind carries it along:
/// factor(p, t) = factor(p - wind t, 0).
struct NoiseProfile {
  static constexpr std::string_view name = "noise";
  static constexpr std::string_view text = "Patches of thicker and thinner air, drifting with the wind.";
  double scale = 10.0;
  int octaves = 4;
  double contrast = 0.5;
  int seed = 0;
  Vector wind;
  bool operator==(const NoiseProfile&) const = default;
  static constexpr auto fields() {
    return std::tuple{
        Field{"scale", &NoiseProfile::scale, positive, "m", "Size of the largest patches.", Scaling::length, true},
        Field{"octaves", &NoiseProfile::octaves, Range{1.0, 8.0}, "1",
              "How many sizes of patches, each half as large as the one before."},
        Field{"contrast", &NoiseProfile::contrast, unit_interval, "1",
              "How far the density may go above and below its mean: 0 is even, 1 nearly clear in places."},
        Field{"seed", &NoiseProfile::seed, Range{0.0, 2147483647.0}, "1", "Picks one of many patterns."},
        Field{"wind", &NoiseProfile::wind, any_number, "m/s", "Velocity with which the pattern drifts.",
              Scaling::length}};
  }
};

/// Density from a grid of voxels, trilinear between them, 0 outside. The grid's own transform says where its voxels
/// stand; its space is put into the world by a size and a position. Where scale times the grid's value is 1, the
/// density is as stated. A profile without a grid is 0 everywhere.
struct GridProfile {
  static constexpr std::string_view name = "grid";
  static constexpr std::string_view text = "The voxels of an OpenVDB file: clouds and smoke from other programs.";
  GridFile file;
  std::string grid_name;
  double scale = 1.0, size = 1.0;
  Vector position;
  int first_frame = 0;
  double fps = 24.0;
  bool operator==(const GridProfile&) const = default;
  static constexpr auto fields() {
    return std::tuple{
        Field{"file", &GridProfile::file, any_number, "",
              "OpenVDB file (.vdb) with the grid; smoke.####.vdb is a sequence of numbered files.", Scaling::none,
              true},
        Field{"name", &GridProfile::grid_name, any_number, "",
              "Name of the grid in the file; may be left out where there is only one."},
        Field{"scale", &GridProfile::scale, not_negative, "1", "What the grid's values are multiplied by."},
        Field{"size", &GridProfile::size, positive, "m", "Length of one unit of the grid's own space.",
              Scaling::length},
        Field{"position", &GridProfile::position, any_number, "m", "Where the origin of the grid's own space is put.",
              Scaling::length},
        Field{"first_frame", &GridProfile::first_frame, Range{0.0, 1e8}, "1",
              "The number of a sequence's file for time 0."},
        Field{"fps", &GridProfile::fps, positive, "1/s", "How many files of a sequence make a second."}};
  }
};

/// The closed list of profiles.
using Profile = std::variant<ConstantProfile, ExponentialProfile, LayerProfile, TentProfile, BoxProfile, SphereProfile,
                             NoiseProfile, GridProfile>;

/// What a density is multiplied by: one profile, or several of which the product is taken. One that is 0 somewhere
/// makes the product 0 there.
using Profiles = OneOrMore<Profile>;

/// A layer needs a thickness.
inline std::optional<Objection> objection_to(const LayerProfile& layer) {
  if (layer.bottom < layer.top) return std::nullopt;
  return Objection{"top", "a top that is not above bottom", "bottom < top"};
}

/// A box needs an inside, and room for its feather.
inline std::optional<Objection> objection_to(const BoxProfile& box) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!(box.min[axis] < box.max[axis])) {
      return Objection{"max", "a corner that is not above min in every coordinate", "min < max in x, y and z"};
    }
    const double half = 0.5 * box.max[axis] - 0.5 * box.min[axis];
    // A hair more is what another unit makes of exactly half.
    if (box.feather > half * (1.0 + 1e-12)) {
      return Objection{
          "feather",
          "a feather of " + short_number(box.feather) + " in a box with an edge of " + short_number(2.0 * half),
          "at most half the shortest edge"};
    }
  }
  return std::nullopt;
}

inline std::optional<Objection> objection_to(const SphereProfile& sphere) {
  if (sphere.feather <= sphere.radius * (1.0 + 1e-12)) return std::nullopt;
  return Objection{
      "feather",
      "a feather of " + short_number(sphere.feather) + " in a sphere of radius " + short_number(sphere.radius),
      "at most the radius"};
}

/// A grid in the world: what takes a point to voxels, and what its numbers are multiplied by.
struct PlacedGrid {
  std::shared_ptr<const BrickGrid> grid;
  double scale = 1.0;
  Vector start, row[3];  // voxels at p: start + (row[0] . p, row[1] . p, row[2] . p)
  Box bounds;            // [m], around all that is not 0
  double typical = 0.0;  // a factor: the mean over the bricks that hold something of the middle of their bounds
  double brick = 0.0;  // [m], the greatest factor times the length of three edges of a brick: no ray goes through more

  Vector voxels(const Vector& p) const { return start + voxels_along(p); }
  Vector voxels_along(const Vector& way) const { return {dot(row[0], way), dot(row[1], way), dot(row[2], way)}; }
  double at(const Vector& p) const { return scale * grid->at(voxels(p)); }
};

/// Puts a grid into the world; nothing where there is nothing in it, or its voxels have no volume.
inline std::optional<PlacedGrid> placed(const GridProfile& profile) {
  const BrickGrid* const grid = profile.file.grid.get();
  if (grid == nullptr || grid->nothing() || !(profile.scale > 0.0)) return std::nullopt;
  const Vector origin = profile.position + grid->origin * profile.size;
  const Vector step[3]{grid->step[0] * profile.size, grid->step[1] * profile.size, grid->step[2] * profile.size};
  const double volume = dot(step[0], cross(step[1], step[2]));
  if (!(std::fabs(volume) > 0.0) || !std::isfinite(1.0 / volume)) return std::nullopt;
  PlacedGrid out{profile.file.grid,
                 profile.scale,
                 {},
                 {},
                 {{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}},
                 0.0,
                 0.0};
  for (int a = 0; a < 3; ++a) out.row[a] = cross(step[(a + 1) % 3], step[(a + 2) % 3]) / volume;
  out.start = -out.voxels_along(origin);
  for (int i = 0; i < 8; ++i) {
    Vector p = origin;
    for (int a = 0; a < 3; ++a) {
      const auto k = static_cast<std::size_t>(a);
      p += step[a] * static_cast<double>((i >> a & 1) != 0 ? grid->high[k] : grid->low[k]);
    }
    out.bounds.low = {std::min(out.bounds.low.x, p.x), std::min(out.bounds.low.y, p.y),
                      std::min(out.bounds.low.z, p.z)};
    out.bounds.high = {std::max(out.bounds.high.x, p.x), std::max(out.bounds.high.y, p.y),
                       std::max(out.bounds.high.z, p.z)};
  }
  double middles = 0.0, greatest = 0.0, count = 0.0;
  for (std::size_t i = 0; i < grid->greatest.size(); ++i) {
    const double most = static_cast<double>(grid->greatest[i]);
    if (!(most > 0.0)) continue;
    middles += 0.5 * (most + static_cast<double>(grid->least[i]));
    greatest = std::max(greatest, most);
    count += 1.0;
  }
  out.typical = profile.scale * middles / count;
  out.brick = profile.scale * greatest * BrickGrid::edge * (length(step[0]) + length(step[1]) + length(step[2]));
  return out;
}

/// 0 for x <= 0, 1 for x >= 1, in between 3 x^2 - 2 x^3: level at both ends.
inline double smooth_step(double x) {
  const double c = std::clamp(x, 0.0, 1.0);
  return c * c * (3.0 - 2.0 * c);
}

/// The fading inside one pair of faces: x is the coordinate, low < high the faces.
inline double feather_factor(double x, double low, double high, double feather) {
  return feather > 0.0 ? smooth_step(std::min(x - low, high - x) / feather) : 1.0;
}
/// The fading inside a sphere's surface, by the squared distance from its centre.
inline double feather_factor(double squared, double radius, double feather) {
  return feather > 0.0 ? smooth_step((radius * radius - squared) / (feather * (2.0 * radius - feather))) : 1.0;
}

/// The factor at a point [m] and time [s], >= 0. Errors: rounding only.
inline double factor(const Profile& profile, const Vector& p, double time = 0.0) {
  struct At {
    const Vector& p;
    double time;
    double operator()(const ConstantProfile&) const { return 1.0; }
    double operator()(const ExponentialProfile& e) const { return std::exp(-(p.y - e.base) / e.scale_height); }
    double operator()(const LayerProfile& l) const { return p.y >= l.bottom && p.y <= l.top ? 1.0 : 0.0; }
    double operator()(const TentProfile& t) const {
      return std::max(0.0, 1.0 - std::fabs(p.y - t.centre) / t.half_width);
    }
    double operator()(const BoxProfile& b) const {
      if (!contains(b.shape(), p)) return 0.0;
      double product = 1.0;
      for (int axis = 0; axis < 3; ++axis) {
        product *= feather_factor(p[axis], b.min[axis], b.max[axis], b.feather);
      }
      return product;
    }
    double operator()(const SphereProfile& s) const {
      if (!contains(s.shape(), p)) return 0.0;
      return feather_factor(length_squared(p - s.center), s.radius, s.feather);
    }
    double operator()(const NoiseProfile& n) const {
      return noise_factor({n.scale, n.octaves, n.contrast, n.seed}, p - n.wind * time);
    }
    double operator()(const GridProfile& g) const {
      const std::optional<PlacedGrid> grid = placed(g);
      return grid ? grid->at(p) : 0.0;
    }
  };
  return std::visit(At{p, time}, profile);
}

/// The factor with noise at its mean of 1, and a grid where it is 1: what a stated visibility refers to, and what tells
/// about a place rather than about the pattern that happens to be there.
inline double mean_factor(const Profile& profile, const Vector& p) {
  const bool pattern = std::holds_alternative<NoiseProfile>(profile) || std::holds_alternative<GridProfile>(profile);
  return pattern ? 1.0 : factor(profile, p);
}

inline double mean_factor(const Profiles& profiles, const Vector& p) {
  double product = 1.0;
  for (const Profile& profile : profiles.all) product *= mean_factor(profile, p);
  return product;
}

/// Height over which all exponentials among the profiles together thin by a factor e [m]; nothing where there is none.
inline std::optional<double> scale_height_of(const Profiles& profiles) {
  double rate = 0.0;
  for (const Profile& profile : profiles.all) {
    if (const auto* e = std::get_if<ExponentialProfile>(&profile)) rate += 1.0 / e->scale_height;
  }
  return rate > 0.0 ? std::optional(1.0 / rate) : std::nullopt;
}

}  // namespace tyndall
