#include "tyndall/scene/surface.h"

#include <algorithm>
#include <cmath>

namespace tyndall {
namespace {

double wrapped(double x, Wrap wrap) {
  if (!std::isfinite(x)) return 0.0;
  if (wrap == Wrap::clamp) return std::clamp(x, 0.0, 1.0);
  if (wrap == Wrap::repeat) return x - std::floor(x);
  const double twice = x - 2.0 * std::floor(0.5 * x);
  return twice <= 1.0 ? twice : 2.0 - twice;
}

/// The texel that a place beyond the edge shows.
std::size_t texel(int i, int count, Wrap wrap) {
  if (wrap == Wrap::repeat) i = (i + count) % count;
  return static_cast<std::size_t>(std::clamp(i, 0, count - 1));
}

/// Sums add(index of a texel, its weight) over the four around a place.
template <class Add>
void around(const Texture& texture, const std::array<double, 2>& uv, Add add) {
  const double x = wrapped(uv[0], texture.wrap_u) * texture.width - 0.5;
  const double y = wrapped(uv[1], texture.wrap_v) * texture.height - 0.5;
  const int column = static_cast<int>(std::floor(x)), row = static_cast<int>(std::floor(y));
  const double right = x - column, below = y - row;
  for (int j = 0; j < 2; ++j) {
    for (int i = 0; i < 2; ++i) {
      add(texel(row + j, texture.height, texture.wrap_v) * static_cast<std::size_t>(texture.width) +
              texel(column + i, texture.width, texture.wrap_u),
          (i == 1 ? right : 1.0 - right) * (j == 1 ? below : 1.0 - below));
    }
  }
}

/// A map's coordinates by corner; none where it cannot be looked up.
struct Corners {
  const Texture* texture = nullptr;
  std::array<std::array<double, 2>, 3> uv{};

  std::array<double, 2> at(double u, double v) const {
    std::array<double, 2> mixed{};
    for (std::size_t i = 0; i < 2; ++i) mixed[i] = (1.0 - u - v) * uv[0][i] + u * uv[1][i] + v * uv[2][i];
    return mixed;
  }
};

Corners corners_of(const Scene& scene, const Map& map, const SurfacePlace& at) {
  const Mesh& mesh = scene.meshes[at.mesh];
  const auto set = static_cast<std::size_t>(map.uv_set);
  if (map.texture < 0 || set >= mesh.uvs.size() || mesh.uvs[set].empty()) return {};
  Corners corners{&scene.textures[static_cast<std::size_t>(map.texture)], {}};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& uv = mesh.uvs[set][mesh.triangles[at.triangle][i]];
    corners.uv[i] = {uv[0], uv[1]};
  }
  return corners;
}

/// A unit tangent across `normal`, and the direction up the map.
struct Tangents {
  Vector right, up;
};

std::optional<Tangents> tangents_at(const Mesh& mesh, const Corners& corners, const SurfacePlace& at,
                                    const Vector& normal) {
  const auto& index = mesh.triangles[at.triangle];
  Vector right, up;
  double sign = 0.0;
  if (!mesh.tangents.empty()) {
    const std::array<double, 3> weight{1.0 - at.u - at.v, at.u, at.v};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& t = mesh.tangents[index[i]];
      right = right + Vector{t[0], t[1], t[2]} * weight[i];
      sign += t[3] * weight[i];
    }
  } else {
    // Position as a function of the coordinates: its derivatives, times the determinant, whose sign turns both.
    const auto position = [&](std::size_t i) {
      const auto& p = mesh.positions[index[i]];
      return Vector{p[0], p[1], p[2]};
    };
    const Vector ab = position(1) - position(0), ac = position(2) - position(0);
    const auto& [a, b, c] = corners.uv;
    const double u1 = b[0] - a[0], v1 = b[1] - a[1], u2 = c[0] - a[0], v2 = c[1] - a[1];
    const double turn = u1 * v2 - u2 * v1 < 0.0 ? -1.0 : 1.0;
    right = (ab * v2 - ac * v1) * turn;
    up = (ab * u2 - ac * u1) * turn;  // the coordinate v points down
  }
  right = right - normal * dot(right, normal);
  const double size = length(right);
  if (!(size > 0.0) || !std::isfinite(size)) return std::nullopt;
  right = right / size;
  const Vector across = cross(normal, right);
  return Tangents{right, across * ((sign != 0.0 ? sign : dot(across, up)) < 0.0 ? -1.0 : 1.0)};
}

}  // namespace

Spectrum map_color(const Scene& scene, const Map& map, const SurfacePlace& at) {
  const Corners corners = corners_of(scene, map, at);
  if (corners.texture == nullptr) return Spectrum::grey(1.0);
  Spectrum color;
  around(*corners.texture, corners.at(at.u, at.v), [&](std::size_t i, double weight) {
    const auto& c = corners.texture->color[i];
    color += Spectrum{{c[0], c[1], c[2]}} * weight;
  });
  return color;
}

double alpha_at(const Scene& scene, const Material& material, const SurfacePlace& at) {
  const Corners corners = corners_of(scene, material.color_map, at);
  if (corners.texture == nullptr || corners.texture->alpha.empty()) return material.alpha;
  double alpha = 0.0;
  around(*corners.texture, corners.at(at.u, at.v),
         [&](std::size_t i, double weight) { alpha += corners.texture->alpha[i] * weight; });
  return material.alpha * alpha;
}

Vector mapped_normal(const Scene& scene, const Material& material, const SurfacePlace& at, const Vector& normal) {
  const Corners corners = corners_of(scene, material.normal_map, at);
  if (corners.texture == nullptr) return normal;
  const auto tangents = tangents_at(scene.meshes[at.mesh], corners, at, normal);
  if (!tangents) return normal;
  const Spectrum code = map_color(scene, material.normal_map, at);
  const Vector bent = tangents->right * ((2.0 * code[0] - 1.0) * material.normal_scale) +
                      tangents->up * ((2.0 * code[1] - 1.0) * material.normal_scale) +
                      normal * std::max(0.0, 2.0 * code[2] - 1.0);
  const double size = length(bent);
  return size > 0.0 && std::isfinite(size) ? bent / size : normal;
}

}  // namespace tyndall
