#pragma once
// A picture as named planes of floats: what the renderer fills and the files hold.
#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tyndall {

/// One channel of a picture. `name` is the full EXR name: "R" of the beauty, "single.G", "depth.Z". One value per
/// pixel, row-major, top row first; linear.
struct Plane {
  std::string name;
  std::vector<float> values;
};

/// Planes of equal size, and notes (key, text) saying how the picture was made; an EXR file carries them in its header.
struct Image {
  int width = 0, height = 0;
  std::vector<Plane> planes;
  std::vector<std::pair<std::string, std::string>> notes;

  std::size_t pixel_count() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
};

/// The channels of a layer: "R" in the layer "" is "R", in the layer "single" it is "single.R".
inline std::string channel_name(std::string_view layer, std::string_view channel) {
  return layer.empty() ? std::string(channel) : std::string(layer) + "." + std::string(channel);
}

/// Appends one plane, filled with `value`; returns its place in image.planes.
inline std::size_t add_plane(Image& image, std::string_view layer, std::string_view channel, float value = 0.0F) {
  image.planes.push_back({channel_name(layer, channel), std::vector<float>(image.pixel_count(), value)});
  return image.planes.size() - 1;
}

/// Appends the planes R, G, B of a layer; returns the place of R in image.planes, G and B follow it.
inline std::size_t add_layer(Image& image, std::string_view layer, float value = 0.0F) {
  const std::size_t first = add_plane(image, layer, "R", value);
  add_plane(image, layer, "G", value);
  add_plane(image, layer, "B", value);
  return first;
}

/// The plane of that full name, or null.
inline const Plane* find_plane(const Image& image, std::string_view name) {
  for (const Plane& plane : image.planes) {
    if (plane.name == name) return &plane;
  }
  return nullptr;
}

/// R, G, B of a layer; null where one is absent.
inline std::array<const Plane*, 3> find_layer(const Image& image, std::string_view layer) {
  return {find_plane(image, channel_name(layer, "R")), find_plane(image, channel_name(layer, "G")),
          find_plane(image, channel_name(layer, "B"))};
}

}  // namespace tyndall
