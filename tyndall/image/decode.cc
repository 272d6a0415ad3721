#include "tyndall/image/decode.h"

#include <algorithm>
#include <limits>
#include <memory>

#include "tyndall/document/fault.h"

// The one place that holds stb_image. STATIC: Debian's libtinygltf brings a libstb.so with functions of the same names.
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_NO_HDR
#define STBI_NO_LINEAR
#define STBI_NO_STDIO
#define STBI_MAX_DIMENSIONS 16384
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

namespace tyndall {
namespace {

const std::string wanted = "at most 16384 pixels a side and 134 million in all";

}  // namespace

Decoded<std::uint8_t> decode_picture(const std::string& where, std::span<const std::uint8_t> bytes) {
  if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
    throw Fault{where, "a picture file of more than 2 GB", "a smaller one"};
  }
  const int size = static_cast<int>(bytes.size());
  int width = 0, height = 0, channels = 0;
  if (stbi_info_from_memory(bytes.data(), size, &width, &height, &channels) == 0) {
    throw Fault{where, "not a PNG or JPEG picture, or a damaged one", "a PNG or JPEG picture, " + wanted};
  }
  if (width < 1 || height < 1 || width > longest_side || height > longest_side ||
      std::int64_t{width} * height > most_pixels) {
    throw Fault{where, "a picture of " + std::to_string(width) + " x " + std::to_string(height) + " pixels", wanted};
  }
  const bool has_alpha = channels == 2 || channels == 4;
  const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
      stbi_load_from_memory(bytes.data(), size, &width, &height, &channels, has_alpha ? 4 : 3), stbi_image_free);
  if (!pixels) throw Fault{where, "a PNG or JPEG picture that is damaged or cut short", "a whole one"};
  const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  Decoded<std::uint8_t> picture{width, height, {}, {}};
  if (!has_alpha) {
    picture.rgb.assign(pixels.get(), pixels.get() + 3 * count);
    return picture;
  }
  picture.rgb.resize(3 * count);
  picture.alpha.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    std::copy_n(pixels.get() + 4 * i, 3, picture.rgb.begin() + static_cast<std::ptrdiff_t>(3 * i));
    picture.alpha[i] = pixels.get()[4 * i + 3];
  }
  return picture;
}

}  // namespace tyndall
