#include "tyndall/scene/fingerprint.h"

#include "tyndall/number/digest.h"

namespace tyndall {
namespace {

void add_texture(Digest& digest, const Texture& texture) {
  for (const int x :
       {texture.width, texture.height, static_cast<int>(texture.wrap_u), static_cast<int>(texture.wrap_v)})
    add_value(digest, x);
  add_value(digest, texture.color);
  add_value(digest, texture.alpha);
}

void add_material(Digest& digest, const Material& material) {
  add_value(digest, material.base_color);
  add_value(digest, material.emission);
  for (const double x : {material.alpha, material.alpha_cutoff, material.metallic, material.roughness, material.ior,
                         material.normal_scale})
    add_value(digest, x);
  for (const Map& map : {material.color_map, material.roughness_map, material.emission_map, material.normal_map}) {
    add_value(digest, map.texture);
    add_value(digest, map.uv_set);
  }
  add_value(digest, material.alpha_mode);
  add_value(digest, material.double_sided);
}

void add_mesh(Digest& digest, const Mesh& mesh) {
  add_value(digest, mesh.positions);
  add_value(digest, mesh.normals);
  add_value(digest, mesh.tangents);
  add_value(digest, mesh.uvs);
  add_value(digest, mesh.triangles);
  add_value(digest, mesh.material);
}

void add_environment(Digest& digest, const EnvironmentLight& light) {
  add_value(digest, light.radiance);
  add_value(digest, light.scale);
  add_value(digest, light.rotation);
  add_value(digest, light.panorama != nullptr);
  if (!light.panorama) return;
  add_value(digest, light.panorama->width);
  add_value(digest, light.panorama->height);
  add_value(digest, light.panorama->radiance);
}

template <class T>
void add_each(Digest& digest, const std::vector<T>& list, void (*add)(Digest&, const T&)) {
  add_value(digest, list.size());
  for (const T& x : list) add(digest, x);
}

}  // namespace

std::uint64_t fingerprint(const Scene& scene) {
  Digest digest;
  add_each(digest, scene.meshes, add_mesh);
  add_each(digest, scene.materials, add_material);
  add_each(digest, scene.textures, add_texture);
  add_value(digest, scene.points);
  add_value(digest, scene.spots);
  add_value(digest, scene.suns);
  add_value(digest, scene.environment.has_value());
  if (scene.environment) add_environment(digest, *scene.environment);
  add_each(
      digest, scene.medium.species, +[](Digest& into, const Species& species) {
        add_value(into, species.scattering);
        add_value(into, species.absorption);
        add_value(into, species.phase);
        add_value(into, species.profiles);
      });
  add_value(digest, scene.camera);
  add_value(digest, scene.film);
  add_value(digest, scene.time);
  return digest.value();
}

}  // namespace tyndall
