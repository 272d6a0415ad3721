#include "tyndall/image/png.h"

#include <png.h>

#include <string>

#include "tyndall/document/fault.h"
#include "tyndall/document/whole_file.h"

namespace tyndall {

void write_png(const std::filesystem::path& file, int width, int height, std::span<const std::uint8_t> rgb) {
  if (width < 1 || height < 1 || rgb.size() != 3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {
    throw Fault{
        place(file.string()),
        std::to_string(rgb.size()) + " bytes for " + std::to_string(width) + " x " + std::to_string(height) + " pixels",
        "three bytes per pixel, at least one pixel"};
  }
  png_image description{};
  description.version = PNG_IMAGE_VERSION;
  description.width = static_cast<png_uint_32>(width);
  description.height = static_cast<png_uint_32>(height);
  description.format = PNG_FORMAT_RGB;  // 8 bits per channel are sRGB in libpng's simplified interface, and tagged so
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(description);
  std::vector<std::uint8_t> bytes(size);
  if (png_image_write_to_memory(&description, bytes.data(), &size, 0, rgb.data(), 0, nullptr) == 0) {
    throw Fault{place(file.string()), std::string("a picture that libpng cannot write: ") + description.message,
                "one that it can"};
  }
  bytes.resize(size);
  write_whole_file(file, bytes);
}

void write_png(const std::filesystem::path& file, const Image& image, const Development& how, std::string_view layer) {
  const auto planes = find_layer(image, layer);
  for (const Plane* plane : planes) {
    if (plane == nullptr || plane->values.size() != image.pixel_count()) {
      throw Fault{place(file.string()), "a picture without the layer \"" + std::string(layer) + "\"",
                  "planes R, G and B of that layer, one value per pixel"};
    }
  }
  std::vector<std::uint8_t> rgb;
  rgb.reserve(3 * image.pixel_count());
  for (std::size_t i = 0; i < image.pixel_count(); ++i) {
    const auto code = develop({{planes[0]->values[i], planes[1]->values[i], planes[2]->values[i]}}, how);
    rgb.insert(rgb.end(), code.begin(), code.end());
  }
  write_png(file, image.width, image.height, rgb);
}

}  // namespace tyndall
