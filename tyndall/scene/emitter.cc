#include "tyndall/scene/emitter.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tyndall {
namespace {

/// Mean over a triangle, at the centres of 64 equal triangles where it has a map.
Spectrum mean_emission(const Scene& scene, const Material& material, std::size_t mesh, std::size_t triangle) {
  constexpr int parts = 8;
  if (material.emission_map.texture < 0) return material.emission;
  Spectrum total;
  for (int i = 0; i < parts; ++i) {
    for (int j = 0; j < parts; ++j) {
      const bool beyond = i + j >= parts;  // the diagonal: those are the turned ones, one less in every row
      const double third = beyond ? 2.0 / 3.0 : 1.0 / 3.0;
      const double u = beyond ? parts - 1 - i : i, v = beyond ? parts - 1 - j : j;
      total += emission_at(scene, material, {mesh, triangle, (u + third) / parts, (v + third) / parts});
    }
  }
  return total / static_cast<double>(parts * parts);
}

}  // namespace

Emitters::Emitters(const Scene& scene) : scene_(scene) {
  double total = 0.0;
  for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
    first_of_mesh_.push_back(triangles_.size());
    const Mesh& mesh = scene.meshes[m];
    if (mesh.material < 0) continue;
    const Material& material = scene.materials[static_cast<std::size_t>(mesh.material)];
    if (is_zero(material.emission)) continue;
    const auto corner = [&](std::uint32_t i) {
      const auto& p = mesh.positions[i];
      return Vector{p[0], p[1], p[2]};
    };
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto& index = mesh.triangles[t];
      const Vector a = corner(index[0]), ab = corner(index[1]) - a, ac = corner(index[2]) - a;
      const Vector n = cross(ab, ac);
      const double twice = length(n);
      if (!(twice > 0.0)) continue;
      const Spectrum emission = mean_emission(scene, material, m, t);
      const double weight = 0.5 * twice * mean(emission) * (material.double_sided ? 2.0 : 1.0);
      if (!(weight > 0.0) || !std::isfinite(weight)) continue;
      triangles_.push_back({a, ab, ac, n / twice, 0.5 * twice, emission, material.double_sided, m, t});
      power_ += emission * (0.5 * twice * std::numbers::pi * (material.double_sided ? 2.0 : 1.0));
      total += weight;
      cumulative_.push_back(total);
    }
  }
  first_of_mesh_.push_back(triangles_.size());
  // From the sums rather than the weights: what binary search does is then exactly what density() says.
  density_.resize(triangles_.size());
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    density_[i] = (cumulative_[i] - (i == 0 ? 0.0 : cumulative_[i - 1])) / total / triangles_[i].area;
  }
}

EmitterSample Emitters::sample(double choice, double u, double v) const {
  const auto chosen = std::ranges::upper_bound(cumulative_, choice * cumulative_.back());
  const auto i = std::min(static_cast<std::size_t>(chosen - cumulative_.begin()), triangles_.size() - 1);
  const EmissiveTriangle& t = triangles_[i];
  // Uniform in area (Shirley and Chiu 1997's square root): b = 1 - sqrt(u) for the first corner.
  const double root = std::sqrt(u);
  const SurfacePlace at{t.mesh, t.triangle, root * (1.0 - v), root * v};
  const int material = scene_.meshes[t.mesh].material;
  return {t.a + t.ab * at.u + t.ac * at.v, density_[i], &t,
          emission_at(scene_, scene_.materials[static_cast<std::size_t>(material)], at)};
}

double Emitters::density(std::size_t mesh, std::size_t triangle) const {
  const auto begin = triangles_.begin() + static_cast<std::ptrdiff_t>(first_of_mesh_[mesh]);
  const auto end = triangles_.begin() + static_cast<std::ptrdiff_t>(first_of_mesh_[mesh + 1]);
  const auto found = std::ranges::lower_bound(begin, end, triangle, {}, &EmissiveTriangle::triangle);
  if (found == end || found->triangle != triangle) return 0.0;
  return density_[static_cast<std::size_t>(found - triangles_.begin())];
}

}  // namespace tyndall
