#include "tyndall/render/single_medium.h"

#include <algorithm>

#include "tyndall/medium/free_flight.h"

namespace tyndall {
namespace {

/// Deeper than this nothing is seen: e^-60.
constexpr double opaque = 60.0;

/// Whether two lobes are one: of one kind and alike in three directions.
bool same(const Lobe<double>& a, const Lobe<double>& b) {
  const auto alike = [&](double mu) {
    const auto value = [&](const auto& l) { return l.density(Deflection<double>::from_mu(mu)); };
    return std::visit(value, a) == std::visit(value, b);
  };
  return a.index() == b.index() && alike(-1.0) && alike(0.3) && alike(1.0);
}

void sort_unique(std::vector<double>& x) {
  std::sort(x.begin(), x.end());
  x.erase(std::unique(x.begin(), x.end()), x.end());
}

}  // namespace

SingleMedium::SingleMedium(const Medium& from, double time) : lowered(lower(from, time)) {
  lobes.resize(lowered.lobes.size());
  kind.resize(lowered.lobes.size());
  bool constant = true, alike = true, unbounded = true;
  for (const LoweredSpecies& s : lowered.species) {
    for (std::size_t i = s.first_lobe; i < s.first_lobe + s.lobe_count; ++i) {
      const WeightedLobe<double>& lobe = lowered.lobes[i];
      lobes[i] = {s.scattering * lobe.weight, lobe.lobe};
      std::size_t k = 0;
      while (k < kinds.size() && !same(kinds[k], lobe.lobe)) ++k;
      if (k == kinds.size()) kinds.push_back(lobe.lobe);
      kind[i] = k;
    }
    constant = constant && s.decay == 0.0 && s.spheres.empty() && s.form.empty();
    unbounded = unbounded && s.boxes.empty() && s.spheres.empty() && !s.heights.bounded() && s.form.empty();
    alike = alike && s.decay == lowered.species.front().decay;
  }
  shaped = !unbounded;
  linear = constant || (alike && unbounded);
}

void RayMedium::set(const SingleMedium& medium, const Ray& ray, double end) {
  medium_ = &medium;
  ray_ = ray;
  borders_.clear();
  marks_.clear();
  stretches_along(medium.lowered, ray, end, stretches_);
  reach_ = 0.0;
  for (const Stretch& s : stretches_) reach_ = std::max(reach_, s.range.end);
  if (!(reach_ > 0.0)) return;
  // Opaque in every channel that scatters at all: the end of what is seen. A channel that never gets there, as the
  // medium thins with height, ends where the densest of what is left is a part in 1e18.
  double last = 0.0;
  for (std::size_t c = 0; c < channel_count; ++c) {
    double thinning = 0.0;
    bool scatters = false;
    for (const Stretch& s : stretches_) {
      if (!(s.species->extinction[c] > 0.0)) continue;
      scatters = true;
      const double away = s.rate > 0.0 ? std::min(s.range.end, s.range.begin + 42.0 / s.rate) : s.range.end;
      thinning = std::max(thinning, away);
    }
    if (scatters) last = std::max(last, std::min(thinning, distance_at_depth(stretches_, c, opaque, reach_)));
  }
  reach_ = std::min(reach_, last);
  for (const Stretch& s : stretches_) {
    if (s.range.begin > 0.0) borders_.push_back(s.range.begin);
    borders_.push_back(s.range.end);
    if (s.rate == 0.0 || s.points != 0) continue;  // pieces of a form are short enough
    // 16 points follow an exponential of an exponential over 5 scale lengths; further than 45 of them from its dense
    // end nothing is left of it.
    const double step = 5.0 / std::fabs(s.rate), top = std::min(s.range.end, reach_);
    for (int k = 1; k <= 9; ++k) {
      const double t = s.rate > 0.0 ? s.range.begin + k * step : top - k * step;
      if (t > s.range.begin && t < top) marks_.push_back(t);
    }
  }
  for (std::size_t c = 0; c < channel_count; ++c) {
    for (const double depth : {2.0, 20.0}) marks_.push_back(distance_at_depth(stretches_, c, depth, reach_));
  }
  const auto outside = [&](double t) { return !(t > 0.0 && t < reach_); };
  std::erase_if(borders_, outside);
  std::erase_if(marks_, outside);
  sort_unique(borders_);
  sort_unique(marks_);
}

Spectrum depth_between(const LoweredMedium& medium, const Vector& a, const Vector& b, std::vector<Stretch>& scratch) {
  // From the lower end, where the air is thickest: upward, exponentials only fall.
  const Vector &from = a.y < b.y ? a : b, &to = a.y < b.y ? b : a;
  const Vector way = to - from;
  const double distance = length(way);
  if (!(distance > 0.0)) return {};
  stretches_along(medium, {from, way / distance}, distance, scratch);
  return optical_depth(scratch, distance);
}

void add_kinks(const LoweredMedium& medium, const Wedge& wedge, std::vector<double>& breaks) {
  if (!wedge.flat) return;
  const auto add = [&](double px, double py) {
    if (py > 0.0 && (wedge.far || py < wedge.aside)) breaks.push_back(wedge.projected(px, py));
  };
  for (const LoweredSpecies& s : medium.species) {
    for (const Box& box : s.boxes) {
      for (int axis = 0; axis < 3; ++axis) {
        for (int corner = 0; corner < 4; ++corner) {
          double p[3], e[3] = {0.0, 0.0, 0.0};
          p[axis] = box.low[axis];
          e[axis] = box.high[axis] - box.low[axis];
          const int b = (axis + 1) % 3, c = (axis + 2) % 3;
          p[b] = corner % 2 == 0 ? box.low[b] : box.high[b];
          p[c] = corner / 2 == 0 ? box.low[c] : box.high[c];
          const Vector start = Vector{p[0], p[1], p[2]} - wedge.origin, edge{e[0], e[1], e[2]};
          const double rise = dot(edge, wedge.z), height = dot(start, wedge.z);
          if (rise == 0.0) continue;
          const double at = -height / rise;
          if (at < 0.0 || at > 1.0) continue;
          const Vector q = start + edge * at;
          add(dot(q, wedge.x), dot(q, wedge.y));
        }
      }
    }
    for (const Sphere& sphere : s.spheres) {
      const Vector to = sphere.center - wedge.origin;
      const double cx = dot(to, wedge.x), cy = dot(to, wedge.y), cz = dot(to, wedge.z);
      const double disc = sphere.radius * sphere.radius - cz * cz;
      if (!(disc > 0.0)) continue;
      if (wedge.far) {
        const double norm = std::sqrt(disc) / std::hypot(wedge.slope, 1.0);
        add(cx + norm, cy - wedge.slope * norm);
        add(cx - norm, cy + wedge.slope * norm);
      } else {
        const double dx = cx - wedge.along, dy = cy - wedge.aside, squared = dx * dx + dy * dy;
        if (!(squared > disc)) continue;
        const double along = (squared - disc) / squared, across = std::sqrt(disc * (squared - disc)) / squared;
        add(wedge.along + dx * along - dy * across, wedge.aside + dy * along + dx * across);
        add(wedge.along + dx * along + dy * across, wedge.aside + dy * along - dx * across);
      }
    }
  }
}

}  // namespace tyndall
