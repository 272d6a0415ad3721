#include "tyndall/scene/gltf_material.h"

#include <algorithm>
#include <cmath>

#include "tyndall/document/spelling.h"
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
  constexpr double most = 1e30;
  Material result;
  result.name = from.name;
  result.double_sided = from.doubleSided;
  result.base_color = color(surface.baseColorFactor, 1.0, surface_pointer + "/baseColorFactor");
  result.metallic = fraction(surface.metallicFactor, surface_pointer + "/metallicFactor");
  result.roughness = fraction(surface.roughnessFactor, surface_pointer + "/roughnessFactor");
  result.color_map = read_map(surface.baseColorTexture, Codes::srgb, use, surface_pointer + "/baseColorTexture");
  result.roughness_map =
      read_map(surface.metallicRoughnessTexture, Codes::linear, use, surface_pointer + "/metallicRoughnessTexture");
  read_alpha(from, result, pointer);
  result.ior = read_ior(from, pointer + "/extensions/KHR_materials_ior/ior");
  // Exporters write factors above 1 although glTF forbids it; what they mean is clear.
  result.emission = color(from.emissiveFactor, most, pointer + "/emissiveFactor") * read_strength(from, pointer);
  if (!is_zero(result.emission))
    result.emission_map = read_map(from.emissiveTexture, Codes::srgb, use, pointer + "/emissiveTexture");
  result.normal_map = read_map(from.normalTexture, Codes::linear, use, pointer + "/normalTexture");
  use.bends_normals = result.normal_map.texture >= 0;
  result.normal_scale = from.normalTexture.scale;
  if (!(std::fabs(result.normal_scale) <= 1e6))
    throw gltf_.fault(pointer + "/normalTexture/scale", "a number out of range", "a number from -1e6 to 1e6");
  if (from.occlusionTexture.index >= 0) ignored_.insert("occlusion maps");
  return result;
}

void GltfMaterials::read_alpha(const tinygltf::Material& from, Material& into, const std::string& pointer) {
  if (from.alphaMode == "MASK") into.alpha_mode = AlphaMode::mask;
  else if (from.alphaMode == "BLEND") into.alpha_mode = AlphaMode::blend;
  else if (from.alphaMode != "OPAQUE")
    throw gltf_.fault(pointer + "/alphaMode", in_quotes(from.alphaMode),
                      one_of(from.alphaMode, {"OPAQUE", "MASK", "BLEND"}));
  const auto& factor = from.pbrMetallicRoughness.baseColorFactor;
  if (factor.size() > 3) into.alpha = fraction(factor[3], pointer + "/pbrMetallicRoughness/baseColorFactor/3");
  into.alpha_cutoff = from.alphaCutoff;
  if (!(from.alphaCutoff >= 0.0 && from.alphaCutoff <= 1e30))
    throw gltf_.fault(pointer + "/alphaCutoff", "a number out of range", "a number of at least 0");
}

double GltfMaterials::read_strength(const tinygltf::Material& from, const std::string& pointer) {
  constexpr double most = 1e30;
  const auto found = from.extensions.find("KHR_materials_emissive_strength");
  if (found == from.extensions.end() || !found->second.Has("emissiveStrength")) return 1.0;
  const std::string here = pointer + "/extensions/KHR_materials_emissive_strength/emissiveStrength";
  const double strength = number(found->second.Get("emissiveStrength"), here);
  if (!(strength >= 0.0 && strength <= most))
    throw gltf_.fault(here, "a number out of range", "a number from 0 to 1e30");
  return strength;
}

double GltfMaterials::read_ior(const tinygltf::Material& from, const std::string& pointer) {
  const auto found = from.extensions.find("KHR_materials_ior");
  if (found == from.extensions.end() || !found->second.Has("ior")) return 1.5;
  const double ior = number(found->second.Get("ior"), pointer);
  if (ior == 0.0) return 1e30;  // the extension's word for a mirror
  if (!(ior >= 1.0 && ior <= 1e30)) throw gltf_.fault(pointer, "a number out of range", "0, or a number of at least 1");
  return ior;
}

template <class Info>
Map GltfMaterials::read_map(const Info& info, Codes codes, MaterialUse& use, const std::string& pointer) {
  if (info.index < 0) return {};
  const UvUse wanted = read_uv_use(info.texCoord, info.extensions, pointer);
  const auto same = [&](const UvUse& u) {
    return u.texture_set == wanted.texture_set && u.transform.x == wanted.transform.x &&
           u.transform.y == wanted.transform.y && u.transform.origin == wanted.transform.origin;
  };
  const auto known = std::ranges::find_if(use.uv_sets, same);
  const Map map{texture(info.index, codes, pointer + "/index"), static_cast<int>(known - use.uv_sets.begin())};
  if (known == use.uv_sets.end()) use.uv_sets.push_back(wanted);
  return map;
}

UvUse GltfMaterials::read_uv_use(int texture_set, const tinygltf::ExtensionMap& extensions,
                                 const std::string& pointer) {
  UvUse use{texture_set, {}};
  const auto found = extensions.find("KHR_texture_transform");
  if (found == extensions.end()) return use;
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
  use.transform.x = Vector{std::cos(angle), -std::sin(angle), 0.0} * scale.x;
  use.transform.y = Vector{std::sin(angle), std::cos(angle), 0.0} * scale.y;
  use.transform.origin = {offset.x, offset.y, 0.0};
  return use;
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

int GltfMaterials::texture(int index, Codes codes, const std::string& pointer) {
  const int image = picture(index, pointer);
  if (image < 0) return -1;
  int wrap_u = TINYGLTF_TEXTURE_WRAP_REPEAT, wrap_v = TINYGLTF_TEXTURE_WRAP_REPEAT;
  if (const int sampler = gltf_.model.textures[static_cast<std::size_t>(index)].sampler; sampler >= 0) {
    const auto& s = element(gltf_, gltf_.model.samplers, sampler, item("/textures", index) + "/sampler");
    wrap_u = s.wrapS;
    wrap_v = s.wrapT;
  }
  const auto next = static_cast<int>(scene_.textures.size());
  const auto [known, fresh] = textures_.try_emplace({image, wrap_u, wrap_v, codes}, next);
  if (!fresh) return known->second;
  std::array<float, 256> linear{};
  for (std::size_t code = 0; code < 256; ++code) {
    const double x = static_cast<double>(code) / 255.0;
    linear[code] = static_cast<float>(codes == Codes::srgb ? linear_from_srgb(x) : x);
  }
  const auto wrap = [](int gl) {
    return gl == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE     ? Wrap::clamp
           : gl == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? Wrap::mirror
                                                         : Wrap::repeat;
  };
  const Decoded<std::uint8_t>& from = pixels(image);
  Texture result{from.width, from.height, {}, wrap(wrap_u), wrap(wrap_v), {}};
  result.color.resize(from.rgb.size() / 3);
  for (std::size_t i = 0; i < from.rgb.size(); ++i) result.color[i / 3][i % 3] = linear[from.rgb[i]];
  for (const std::uint8_t code : from.alpha) result.alpha.push_back(static_cast<float>(code) / 255.0F);
  scene_.textures.push_back(std::move(result));
  return next;
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
