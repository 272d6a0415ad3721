#include "tyndall/scene/gltf_material.h"

#include <cmath>

#include "tyndall/image/tone.h"

namespace tyndall {

const MaterialUse& GltfMaterials::use(int index, const std::string& pointer) {
  const auto [known, fresh] = known_.try_emplace(index);
  MaterialUse& use = known->second;
  if (!fresh || index < 0) return use;
  const tinygltf::Material& from = element(gltf_, gltf_.model.materials, index, pointer);
  scene_.materials.push_back(read(from, use, item("/materials", index)));
  use.index = static_cast<int>(scene_.materials.size()) - 1;
  return use;
}

Material GltfMaterials::read(const tinygltf::Material& from, MaterialUse& use, const std::string& pointer) {
  const auto& surface = from.pbrMetallicRoughness;
  const std::string surface_pointer = pointer + "/pbrMetallicRoughness";
  Material result;
  result.name = from.name;
  result.double_sided = from.doubleSided;
  result.base_color = color(surface.baseColorFactor, 1.0, surface_pointer + "/baseColorFactor");
  result.metallic = fraction(surface.metallicFactor, surface_pointer + "/metallicFactor");
  result.roughness = fraction(surface.roughnessFactor, surface_pointer + "/roughnessFactor");
  if (surface.baseColorTexture.index >= 0) {
    const std::string texture = surface_pointer + "/baseColorTexture";
    result.base_color_texture = color_texture(surface.baseColorTexture.index, texture + "/index");
    read_texture_map(surface.baseColorTexture, use, texture);
  }
  if (surface.metallicRoughnessTexture.index >= 0) {
    const Spectrum mean =
        mean_of(surface.metallicRoughnessTexture.index, false, surface_pointer + "/metallicRoughnessTexture/index");
    result.roughness *= mean[1];
    result.metallic *= mean[2];
    ignored_.insert("the variation of metalness and roughness over a surface (their means count)");
  }
  result.emission = read_emission(from, pointer);
  if (from.normalTexture.index >= 0) ignored_.insert("normal maps");
  if (from.occlusionTexture.index >= 0) ignored_.insert("occlusion maps");
  if (from.alphaMode != "OPAQUE") ignored_.insert("transparency (alpha)");
  return result;
}

Spectrum GltfMaterials::read_emission(const tinygltf::Material& from, const std::string& pointer) {
  constexpr double most = 1e30;
  // Exporters write factors above 1 although glTF forbids it; what they mean is clear.
  Spectrum emission = color(from.emissiveFactor, most, pointer + "/emissiveFactor");
  if (const auto found = from.extensions.find("KHR_materials_emissive_strength"); found != from.extensions.end()) {
    const std::string strength_pointer = pointer + "/extensions/KHR_materials_emissive_strength/emissiveStrength";
    const double strength =
        found->second.Has("emissiveStrength") ? number(found->second.Get("emissiveStrength"), strength_pointer) : 1.0;
    if (!(strength >= 0.0 && strength <= most)) {
      throw gltf_.fault(strength_pointer, "a number out of range", "a number from 0 to 1e30");
    }
    emission *= strength;
  }
  if (from.emissiveTexture.index >= 0 && !is_zero(emission)) {
    emission *= mean_of(from.emissiveTexture.index, true, pointer + "/emissiveTexture/index");
    ignored_.insert("the variation of emission over a surface (its mean counts)");
  }
  return emission;
}

void GltfMaterials::read_texture_map(const tinygltf::TextureInfo& info, MaterialUse& use, const std::string& pointer) {
  use.texture_set = info.texCoord;
  const auto found = info.extensions.find("KHR_texture_transform");
  if (found == info.extensions.end()) return;
  const tinygltf::Value& map = found->second;
  const std::string map_pointer = pointer + "/extensions/KHR_texture_transform";
  const auto pair = [&](const char* key, double missing) {
    Vector v{missing, missing, 0.0};
    if (!map.Has(key)) return v;
    const tinygltf::Value& list = map.Get(key);
    if (!list.IsArray() || list.ArrayLen() != 2) throw gltf_.fault(map_pointer + "/" + key, "no pair", "two numbers");
    v.x = number(list.Get(0), map_pointer + "/" + key);
    v.y = number(list.Get(1), map_pointer + "/" + key);
    return v;
  };
  const Vector offset = pair("offset", 0.0), scale = pair("scale", 1.0);
  const double angle = map.Has("rotation") ? number(map.Get("rotation"), map_pointer + "/rotation") : 0.0;
  if (map.Has("texCoord")) {
    const double set = number(map.Get("texCoord"), map_pointer + "/texCoord");
    if (!(set >= 0.0 && set < 1000.0))
      throw gltf_.fault(map_pointer + "/texCoord", "a number out of range", "0 or more");
    use.texture_set = static_cast<int>(set);
  }
  // Offset after rotation after scale, counter-clockwise where v points down: the matrices of the extension's text.
  use.texture_map.x = Vector{std::cos(angle), -std::sin(angle), 0.0} * scale.x;
  use.texture_map.y = Vector{std::sin(angle), std::cos(angle), 0.0} * scale.y;
  use.texture_map.origin = {offset.x, offset.y, 0.0};
}

Spectrum GltfMaterials::color(const std::vector<double>& values, double most, const std::string& pointer) const {
  Spectrum c;
  for (std::size_t i = 0; i < channel_count && i < values.size(); ++i) {
    if (!(values[i] >= 0.0 && values[i] <= most)) {
      throw gltf_.fault(pointer, "a colour out of range",
                        most == 1.0 ? "numbers from 0 to 1" : "numbers from 0 to 1e30");
    }
    c[i] = values[i];
  }
  return c;
}

double GltfMaterials::fraction(double value, const std::string& pointer) const {
  if (!(value >= 0.0 && value <= 1.0)) throw gltf_.fault(pointer, "a number out of range", "a number from 0 to 1");
  return value;
}

double GltfMaterials::number(const tinygltf::Value& value, const std::string& pointer) const {
  const double x = value.IsNumber() ? value.GetNumberAsDouble() : NAN;
  if (!std::isfinite(x)) throw gltf_.fault(pointer, "no finite number", "a finite number");
  return x;
}

int GltfMaterials::color_texture(int texture, const std::string& pointer) {
  const int image = picture(texture, pointer);
  if (image < 0) return -1;
  int wrap_u = TINYGLTF_TEXTURE_WRAP_REPEAT, wrap_v = TINYGLTF_TEXTURE_WRAP_REPEAT;
  if (const int sampler = gltf_.model.textures[static_cast<std::size_t>(texture)].sampler; sampler >= 0) {
    const auto& s = element(gltf_, gltf_.model.samplers, sampler, item("/textures", texture) + "/sampler");
    wrap_u = s.wrapS;
    wrap_v = s.wrapT;
  }
  const auto next = static_cast<int>(scene_.textures.size());
  const auto [known, fresh] = textures_.try_emplace({image, wrap_u, wrap_v}, next);
  if (!fresh) return known->second;
  std::array<float, 256> linear{};
  for (std::size_t code = 0; code < 256; ++code) {
    linear[code] = static_cast<float>(linear_from_srgb(static_cast<double>(code) / 255.0));
  }
  const auto wrap = [](int gl) {
    return gl == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE     ? Wrap::clamp
           : gl == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? Wrap::mirror
                                                         : Wrap::repeat;
  };
  const Decoded<std::uint8_t>& from = pixels(image);
  Texture result{from.width, from.height, {}, wrap(wrap_u), wrap(wrap_v)};
  result.color.resize(from.rgb.size() / 3);
  for (std::size_t i = 0; i < from.rgb.size(); ++i) result.color[i / 3][i % 3] = linear[from.rgb[i]];
  scene_.textures.push_back(std::move(result));
  return next;
}

Spectrum GltfMaterials::mean_of(int texture, bool srgb, const std::string& pointer) {
  const int image = picture(texture, pointer);
  if (image < 0) return Spectrum::grey(1.0);
  const Decoded<std::uint8_t>& from = pixels(image);
  std::array<std::array<std::size_t, 256>, 3> histogram{};
  for (std::size_t i = 0; i < from.rgb.size(); ++i) ++histogram[i % 3][from.rgb[i]];
  Spectrum mean;
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t code = 0; code < 256; ++code) {
      const double value = static_cast<double>(code) / 255.0;
      mean[c] += static_cast<double>(histogram[c][code]) * (srgb ? linear_from_srgb(value) : value);
    }
  }
  return mean / (static_cast<double>(from.rgb.size()) / 3.0);
}

/// The image of a texture; -1 where it has none that we could read.
int GltfMaterials::picture(int texture, const std::string& pointer) {
  const int source = element(gltf_, gltf_.model.textures, texture, pointer).source;
  if (source < 0) {
    ignored_.insert("textures whose picture is in an unknown format");
    return -1;
  }
  const auto& image = element(gltf_, gltf_.model.images, source, item("/textures", texture) + "/source");
  if (!image.image.empty()) return source;
  if (gltf_.unread) throw *gltf_.unread;
  throw gltf_.fault(item("/images", source), "no picture", "a PNG or JPEG picture");
}

const Decoded<std::uint8_t>& GltfMaterials::pixels(int image) {
  if (decoded_ != image) {
    decoded_ = -1;
    pixels_ = decode_picture(gltf_.fault(item("/images", image), "", "").where,
                             gltf_.model.images[static_cast<std::size_t>(image)].image);
    decoded_ = image;
  }
  return pixels_;
}

}  // namespace tyndall
