#include "tyndall/image/panorama.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "tyndall/document/fault.h"
#include "tyndall/document/file_kind.h"
#include "tyndall/document/rehearsal.h"
#include "tyndall/document/whole_file.h"
#include "tyndall/image/exr.h"
#include "tyndall/image/radiance_picture.h"

namespace tyndall {
namespace {

float mended(float x) {
  if (!(x > 0.0F)) return 0.0F;
  return std::isinf(x) ? 65504.0F : x;
}

Panorama from_exr(const std::string& where, std::span<const std::uint8_t> bytes) {
  constexpr std::array<std::string_view, 4> names{"R", "G", "B", "Y"};
  const Image image = parse_exr(where, bytes, names);
  auto planes = find_layer(image, "");
  if (const Plane* grey = find_plane(image, "Y"); grey != nullptr && planes[0] == nullptr) planes.fill(grey);
  for (const Plane* plane : planes) {
    if (plane == nullptr) throw Fault{where, "an OpenEXR picture without channels R, G, B", "R, G and B, or Y"};
  }
  Panorama panorama{image.width, image.height, {}};
  panorama.radiance.resize(image.pixel_count());
  for (std::size_t c = 0; c < channel_count; ++c) {
    for (std::size_t i = 0; i < image.pixel_count(); ++i) panorama.radiance[i][c] = mended(planes[c]->values[i]);
  }
  return panorama;
}

Panorama from_radiance(const std::string& where, std::span<const std::uint8_t> bytes) {
  const Decoded<float> picture = decode_radiance(where, bytes);
  Panorama panorama{picture.width, picture.height, {}};
  panorama.radiance.resize(picture.rgb.size() / 3);
  for (std::size_t i = 0; i < picture.rgb.size(); ++i) panorama.radiance[i / 3][i % 3] = mended(picture.rgb[i]);
  return panorama;
}

}  // namespace

Panorama read_panorama(const std::filesystem::path& file) {
  const std::string where = place(file.string());
  const std::vector<std::uint8_t> bytes = read_whole_file(file);
  const bool is_exr = bytes.size() >= 4 && bytes[0] == 0x76 && bytes[1] == 0x2f && bytes[2] == 0x31 && bytes[3] == 0x01;
  const std::string_view start(reinterpret_cast<const char*>(bytes.data()), std::min<std::size_t>(bytes.size(), 32));
  if (const std::string_view kind = kind_of_start(start); !is_exr && !kind.empty() && !start.starts_with("#?")) {
    throw Fault(where, std::string(kind), "a panorama: an .hdr or .exr picture");
  }
  const auto parse = is_exr ? from_exr : from_radiance;
  rehearse(where, "a panorama in a sound .hdr or .exr file", [&] { parse(where, bytes); });
  return parse(where, bytes);
}

}  // namespace tyndall
