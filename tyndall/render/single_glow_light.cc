// What emissive triangles give to a surface point, to a ray, and to the fluence at a point.
#include <numbers>

#include "tyndall/render/bsdf.h"
#include "tyndall/render/single_ray.h"

namespace tyndall {
namespace {

/// The cells of a cut number at most this many times SingleSettings::emissive_points.
constexpr std::size_t surface_cells = 4, ray_cells = 2;
/// Below this radius per distance a cell counts as a point: the next term is a square of it.
constexpr double point_like = 0.02;
/// What is left of the light when shadow rays cease.
constexpr double negligible = 1e-3;

/// The part of a triangle above the plane z = 0.
struct Clipped {
  std::array<Vector, 4> corner;
  std::size_t count = 0;
};
Clipped above_horizon(const std::array<Vector, 3>& p) {
  Clipped out;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector &here = p[i], &next = p[(i + 1) % 3];
    if (here.z >= 0.0) out.corner[out.count++] = here;
    if ((here.z < 0.0) != (next.z < 0.0)) out.corner[out.count++] = here + (next - here) * (here.z / (here.z - next.z));
  }
  return out;
}

/// int cos over the solid angle of a polygon above the horizon, seen from the origin, the normal being z (Lambert's
/// formula; Arvo 1995, eq. 2.6).
double projected_solid_angle(const Clipped& polygon) {
  double sum = 0.0;
  for (std::size_t i = 0; i < polygon.count; ++i) {
    const Vector &a = polygon.corner[i], &b = polygon.corner[(i + 1) % polygon.count];
    const Vector across = cross(a, b);
    const double size = length(across);
    if (size > 0.0) sum += across.z / size * std::atan2(size, dot(a, b));
  }
  return 0.5 * std::fabs(sum);
}

/// Solid angle of a triangle with the corners a, b, c, seen from the origin (van Oosterom and Strackee 1983, eq. 8).
double solid_angle(const Vector& a, const Vector& b, const Vector& c) {
  const double la = length(a), lb = length(b), lc = length(c);
  return 2.0 *
         std::fabs(std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(a, c) * lb + dot(b, c) * la));
}

/// What a cell contributes to the light that a surface reflects.
class ReflectedGlow {
 public:
  ReflectedGlow(const SurfacePoint& surface, const Vector& start, const Vector& out)
      : surface_(surface),
        reflection_(surface, out),
        start_(start),
        out_(out),
        out_cosine_(dot(surface.frame.normal, out)) {}

  GlowValue operator()(const GlowCell& cell) const {
    GlowValue value;
    const Vector way = cell.center - start_, local = surface_.frame.to_local(way);
    const double distance = length(way), reach = cell.radius / std::max(distance, cell.radius);
    // Bounds of the two cosines over the cell.
    const double highest = std::min(1.0, (local.z + cell.radius) / std::max(distance, 1e-300));
    if (!(highest > 0.0) || !(out_cosine_ > 0.0)) return value;
    const double faced = -dot(cell.axis, way);  // times the distance
    if (cell.dark(faced)) return value;
    const double facing = !cell.cluster() && reach < 1.0 ? std::min(1.0, faced / distance + reach) : 1.0;
    if (!cell.cluster()) {
      contribute(cell, way, local, distance, value);
    } else if (local.z > 0.0) {
      const Vector in = way / distance;
      value.aim = cell.place;
      value.light = cell.intensity * reflection_.evaluate(in) *
                    (cell.falloff(-in) / (distance * distance + cell.area / std::numbers::pi));
    }
    // The most that it can contribute, in a narrow lobe of the surface, too.
    const double gap = std::max(0.0, distance - cell.radius);
    const double solid_angle = std::min(2.0 * std::numbers::pi, facing * cell.area / std::max(gap * gap, 1e-300));
    value.key =
        mean(cell.intensity) / cell.area * solid_angle * brightest(way / std::max(distance, 1e-300), reach, highest);
    return value;
  }

 private:
  void contribute(const GlowCell& cell, const Vector& way, const Vector& local, double distance,
                  GlowValue& value) const {
    if (cell.radius < point_like * distance && local.z > cell.radius) {
      const Vector in = way / distance;
      value.aim = cell.center;
      value.light = cell.intensity * reflection_.evaluate(in) * (cell.falloff(-in) / (distance * distance));
      return;
    }
    const Vector a = surface_.frame.to_local(cell.a - start_);
    const Vector ab = surface_.frame.to_local(cell.ab), ac = surface_.frame.to_local(cell.ac);
    const Clipped polygon = above_horizon({a, a + ab, a + ac});
    if (polygon.count < 3) return;
    Vector middle;
    for (std::size_t i = 0; i < polygon.count; ++i) middle = middle + polygon.corner[i];
    middle = middle / static_cast<double>(polygon.count);
    const double away = length(middle);
    if (!(middle.z > 0.0)) return;
    const Vector aim = surface_.frame.to_world(middle);
    value.aim = start_ + aim;
    value.light = cell.intensity / cell.area * reflection_.evaluate(aim / away) *
                  (projected_solid_angle(polygon) / (middle.z / away));
  }

  /// The most that is reflected per irradiance, times the cosine, of directions within asin(reach) of `in`, cosines to
  /// the normal being `highest` at most; white, and without what lets a lobe only lose.
  double brightest(const Vector& in, double reach, double highest) const {
    const double matte = mean(surface_.base_color) * (1.0 - surface_.metallic) / std::numbers::pi * highest;
    const Vector sum = out_ + in;
    const double size = length(sum);
    double straightest = 1.0;  // cosine between normal and half vector
    if (size > 1e-6) {
      // The half vector turns by half as much as the direction, divided by its own cosine to it (half of size).
      const double turn = 0.5 * std::asin(reach) / std::max(0.5 * size, 0.5 * std::asin(reach));
      const double tilt = std::acos(std::clamp(dot(surface_.frame.normal, sum) / size, -1.0, 1.0));
      straightest = std::cos(std::max(0.0, tilt - turn));
    }
    const double facets = facet_density(surface_.alpha, straightest);
    const double shadowing =
        1.0 / (1.0 + smith_lambda(surface_.alpha, out_cosine_) + smith_lambda(surface_.alpha, std::max(1e-6, highest)));
    const double normal = 0.04 * (1.0 - surface_.metallic) + mean(surface_.base_color) * surface_.metallic;
    const double mirrored = normal + (1.0 - normal) * std::pow(1.0 - std::min(1.0, 0.5 * size), 5);  // Schlick
    return matte + mirrored * facets * shadowing / (4.0 * out_cosine_);
  }

  const SurfacePoint& surface_;
  Reflection reflection_;
  const Vector start_, out_;
  double out_cosine_;
};

}  // namespace

Spectrum SingleRay::reflected_glow(const SurfacePoint& surface, const Vector& start, const Vector& out,
                                   const Spectrum& others) {
  const auto points = static_cast<std::size_t>(std::max(1, context_.settings.emissive_points));
  cut_glow(context_.glow, surface_cells * points, 0.25 / static_cast<double>(points),
           ReflectedGlow(surface, start, out), cut_);
  return visible(start, others);
}

/// The brightest first, until what is left is a part in a thousand of what is there; that is taken for as visible as
/// they are.
Spectrum SingleRay::visible(const Vector& from, const Spectrum& others) {
  std::sort(cut_.begin(), cut_.end(),
            [](const GlowPart& a, const GlowPart& b) { return mean(a.value.light) > mean(b.value.light); });
  double left = 0.0, asked = 0.0;
  for (const GlowPart& part : cut_) left += mean(part.value.light);
  Spectrum sum;
  for (const GlowPart& part : cut_) {
    const double light = mean(part.value.light);
    if (!(light > 0.0) || left <= negligible * mean(sum + others)) break;
    sum += part.value.light * open_way(from, part.value.aim);
    asked += light;
    left -= light;
  }
  return asked > 0.0 ? sum * (1.0 + std::max(0.0, left) / asked) : sum;
}

/// What a cell of intensity 1 scatters into the ray, roughly: without the light's own way and its shadows, by midpoints
/// of the angle at the cell, dt / r^2 = dangle / aside; and the most that parts of it might.
std::pair<double, double> SingleRay::glow_estimate(const GlowCell& cell, double along, double aside,
                                                   double reach) const {
  constexpr int count = 8;
  const double begin = std::atan(-along / aside), span = std::atan((reach - along) / aside) - begin;
  double sum = 0.0, most = 0.0;
  for (int k = 0; k < count; ++k) {
    const double angle = begin + span * (k + 0.5) / count, t = along + aside * std::tan(angle);
    const Deflection<double> d = Deflection<double>::from_mu(-std::sin(angle));
    double phase = 0.0;
    for (std::size_t kind = 0; kind < shares_.size(); ++kind) {
      if (shares_[kind] == 0.0) continue;
      phase += shares_[kind] * std::visit([&](const auto& l) { return l.density(d); }, context_.medium.kinds[kind]);
    }
    const Vector away = ray_.at(t) - cell.center;
    const double distance = std::max(length(away), 1e-300), light = phase * mean(medium_.transmittance_to(t));
    sum += light * cell.falloff(away / distance);
    most += light * cell.highest_falloff(away / distance, distance);
  }
  const double weight = span / (count * aside);
  return {sum * weight, most * weight};
}

Spectrum SingleRay::from_glow() {
  if (medium_.empty() || context_.glow.empty()) return {};
  const auto points = static_cast<std::size_t>(std::max(1, context_.settings.emissive_points));
  const double reach = medium_.reach();
  if (!(set_shares() > 0.0)) return {};
  cut_glow(
      context_.glow, ray_cells * points, 0.1 / static_cast<double>(points),
      [&](const GlowCell& cell) {
        GlowValue value;
        const Vector way = cell.center - ray_.origin;
        const double along = dot(way, ray_.direction), forward = dot(cell.axis, ray_.direction);
        // The end of the ray that is furthest in front of it.
        const double faced = std::max(-dot(cell.axis, way), reach * forward - dot(cell.axis, way));
        if (cell.dark(faced)) return value;
        const double nearest = std::clamp(along, 0.0, reach);
        const double distance = length(cell.center - ray_.at(nearest));
        const double aside = std::max({length(way - ray_.direction * along), 0.5 * cell.radius, 1e-9 * distance});
        const auto [light, most] = glow_estimate(cell, along, aside, reach);
        value.light = cell.intensity * light;
        value.key = mean(cell.intensity) * most * std::min(1.0, cell.radius / std::max(distance, 0.5 * cell.radius));
        return value;
      },
      cut_);
  const double tolerance = std::max(coarse_tolerance, context_.settings.tolerance);
  Spectrum sum;
  for (const GlowPart& part : cut_) {
    // A cluster's normals in two parts, as its falloff has them.
    SingleLamp lamp;
    lamp.position = part.cell.place;
    lamp.axis = part.cell.axis;
    lamp.softening = part.cell.area / std::numbers::pi;
    if (part.cell.order > 0.01) {
      lamp.shape = SingleLamp::Shape::one_sided;
      lamp.intensity = part.cell.intensity * part.cell.order;
      sum += from(lamp, tolerance);
    }
    if (part.cell.order < 0.99) {
      lamp.shape = SingleLamp::Shape::point;
      lamp.intensity = part.cell.intensity * (0.25 * (1.0 - part.cell.order));
      sum += from(lamp, tolerance);
    }
  }
  return sum;
}

Spectrum SingleRay::glow_around(const Vector& point) {
  const auto points = static_cast<std::size_t>(std::max(1, context_.settings.emissive_points));
  cut_glow(
      context_.glow, surface_cells * points, 0.25 / static_cast<double>(points),
      [&](const GlowCell& cell) {
        GlowValue value;
        const Vector way = point - cell.center;
        const double squared = length_squared(way), faced = dot(cell.axis, way);
        if (cell.dark(faced)) return value;
        value.aim = cell.place;
        if (cell.cluster()) {
          const double softened = squared + cell.area / std::numbers::pi;
          value.light = cell.intensity * (cell.falloff(way / std::sqrt(std::max(squared, 1e-300))) / softened);
        } else {
          const Vector a = cell.a - point;
          value.light = cell.intensity * (solid_angle(a, a + cell.ab, a + cell.ac) / cell.area);
        }
        const double gap = std::max(0.0, std::sqrt(squared) - cell.radius);
        value.key = mean(cell.intensity) / cell.area *
                    std::min(2.0 * std::numbers::pi, cell.area / std::max(gap * gap, 1e-300));
        return value;
      },
      cut_);
  return visible(point, {});
}

}  // namespace tyndall
