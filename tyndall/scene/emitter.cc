#include "tyndall/scene/emitter.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tyndall {

Emitters::Emitters(const Scene& scene) {
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
      const double weight = 0.5 * twice * mean(material.emission) * (material.double_sided ? 2.0 : 1.0);
      if (!(weight > 0.0) || !std::isfinite(weight)) continue;
      triangles_.push_back({a, ab, ac, n / twice, 0.5 * twice, material.emission, material.double_sided, m, t});
      power_ += material.emission * (0.5 * twice * std::numbers::pi * (material.double_sided ? 2.0 : 1.0));
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
  return {t.a + t.ab * (root * (1.0 - v)) + t.ac * (root * v), density_[i], &t};
}

double Emitters::density(std::size_t mesh, std::size_t triangle) const {
  const auto begin = triangles_.begin() + static_cast<std::ptrdiff_t>(first_of_mesh_[mesh]);
  const auto end = triangles_.begin() + static_cast<std::ptrdiff_t>(first_of_mesh_[mesh + 1]);
  const auto found = std::ranges::lower_bound(begin, end, triangle, {}, &EmissiveTriangle::triangle);
  if (found == end || found->triangle != triangle) return 0.0;
  return density_[static_cast<std::size_t>(found - triangles_.begin())];
}

}  // namespace tyndall
