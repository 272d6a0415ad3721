#include "tyndall/image/exr.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>

#include <algorithm>
#include <cstring>
#include <optional>
#include <set>

#include "tyndall/document/fault.h"
#include "tyndall/document/rehearsal.h"
#include "tyndall/document/whole_file.h"

namespace tyndall {
namespace {

constexpr int largest_side = 16384;
constexpr std::uint64_t most_plane_bytes = std::uint64_t{1} << 31;
const std::string wanted = "an OpenEXR picture of one flat part, at most 16384 pixels a side";

/// OpenEXR's view of bytes in memory, to write to.
class Sink : public Imf::OStream {
 public:
  Sink() : OStream("memory") {}
  void write(const char c[], int n) override {
    if (at_ + static_cast<std::size_t>(n) > bytes.size()) bytes.resize(at_ + static_cast<std::size_t>(n));
    std::memcpy(bytes.data() + at_, c, static_cast<std::size_t>(n));
    at_ += static_cast<std::size_t>(n);
  }
  uint64_t tellp() override { return at_; }
  void seekp(uint64_t position) override { at_ = position; }
  std::vector<std::uint8_t> bytes;

 private:
  std::size_t at_ = 0;
};

/// OpenEXR's view of bytes in memory, to read from.
class Source : public Imf::IStream {
 public:
  explicit Source(std::span<const std::uint8_t> bytes) : IStream("memory"), bytes_(bytes) {}
  bool read(char c[], int n) override {
    if (n < 0 || at_ > bytes_.size() || static_cast<std::size_t>(n) > bytes_.size() - at_) {
      throw std::runtime_error("end of file");
    }
    std::memcpy(c, bytes_.data() + at_, static_cast<std::size_t>(n));
    at_ += static_cast<std::size_t>(n);
    return at_ < bytes_.size();
  }
  uint64_t tellg() override { return at_; }
  void seekg(uint64_t position) override { at_ = position; }

 private:
  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
};

std::uint32_t little_endian(std::span<const std::uint8_t> b, std::size_t at) {
  return b[at] | static_cast<std::uint32_t>(b[at + 1]) << 8 | static_cast<std::uint32_t>(b[at + 2]) << 16 |
         static_cast<std::uint32_t>(b[at + 3]) << 24;
}

/// Checks what a header declares before OpenEXR allocates for it (OpenEXR file layout: magic, version and flags, then
/// attributes as name 0, type 0, size, value; an empty name ends them).
void check_header(const std::string& where, std::span<const std::uint8_t> bytes) {
  if (bytes.size() < 9 || little_endian(bytes, 0) != 20000630) throw Fault{where, "not an OpenEXR file", wanted};
  if ((little_endian(bytes, 4) & 0x1800) != 0) throw Fault{where, "a deep or multi-part OpenEXR file", wanted};
  std::size_t at = 8;
  const auto text = [&]() -> std::optional<std::string_view> {
    const auto* const begin = bytes.data() + at;
    const void* const end = std::memchr(begin, 0, std::min<std::size_t>(bytes.size() - at, 256));
    if (end == nullptr) return std::nullopt;
    const auto length = static_cast<std::size_t>(static_cast<const std::uint8_t*>(end) - begin);
    at += length + 1;
    return std::string_view(reinterpret_cast<const char*>(begin), length);
  };
  bool has_size = false;
  for (;;) {
    const auto name = text();
    if (name && name->empty()) break;
    const auto type = name ? text() : std::nullopt;
    if (!type || bytes.size() - at < 4) throw Fault{where, "a damaged OpenEXR header", wanted};
    const std::uint32_t size = little_endian(bytes, at);
    at += 4;
    if (size > bytes.size() - at) throw Fault{where, "a damaged OpenEXR header", wanted};
    if ((*name == "dataWindow" || *name == "displayWindow") && *type == "box2i" && size == 16) {
      std::int64_t corner[4];
      for (std::size_t i = 0; i < 4; ++i) corner[i] = static_cast<std::int32_t>(little_endian(bytes, at + 4 * i));
      const std::int64_t width = corner[2] - corner[0] + 1, height = corner[3] - corner[1] + 1;
      if (width < 1 || height < 1 || width > largest_side || height > largest_side) {
        throw Fault{where, "a picture of " + std::to_string(width) + " x " + std::to_string(height) + " pixels",
                    wanted};
      }
      has_size = has_size || *name == "dataWindow";
    }
    at += size;
  }
  if (!has_size) throw Fault{where, "an OpenEXR header without a size", wanted};
}

Image parse(std::span<const std::uint8_t> bytes, const std::string& where, std::span<const std::string_view> only) {
  Source source(bytes);
  Imf::InputFile in(source, 0);
  const Imf::Header& header = in.header();
  const Imath::Box2i window = header.dataWindow();
  Image image;
  image.width = window.max.x - window.min.x + 1;
  image.height = window.max.y - window.min.y + 1;
  for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel) {
    if (!only.empty() && std::find(only.begin(), only.end(), channel.name()) == only.end()) continue;
    if (channel.channel().xSampling != 1 || channel.channel().ySampling != 1) {
      throw Fault{where, "an OpenEXR picture with subsampled channels", wanted};
    }
    image.planes.push_back({channel.name(), {}});
  }
  const std::uint64_t size = image.planes.size() * image.pixel_count() * sizeof(float);
  if (size > most_plane_bytes) {
    throw Fault{where, "an OpenEXR picture of " + std::to_string(size / 1000000) + " MB", "at most 2147 MB"};
  }
  Imf::FrameBuffer frame;
  for (Plane& plane : image.planes) {
    plane.values.resize(image.pixel_count());
    // OpenEXR addresses pixels by their coordinates in the data window, which need not start at 0.
    frame.insert(plane.name, Imf::Slice::Make(Imf::FLOAT, plane.values.data(), window.min, image.width, image.height,
                                              sizeof(float), static_cast<std::size_t>(image.width) * sizeof(float)));
  }
  in.setFrameBuffer(frame);
  in.readPixels(window.min.y, window.max.y);
  for (auto attribute = header.begin(); attribute != header.end(); ++attribute) {
    if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&attribute.attribute())) {
      image.notes.emplace_back(attribute.name(), text->value());
    }
  }
  return image;
}

}  // namespace

void write_exr(const std::filesystem::path& file, const Image& image) {
  const std::string where = place(file.string());
  if (image.width < 1 || image.height < 1 || image.width > largest_side || image.height > largest_side) {
    throw Fault{where, "a picture of " + std::to_string(image.width) + " x " + std::to_string(image.height) + " pixels",
                "1 to 16384 pixels a side"};
  }
  Sink sink;
  try {
    Imf::Header header(image.width, image.height);
    header.compression() = Imf::ZIP_COMPRESSION;
    Imf::FrameBuffer frame;
    std::set<std::string_view> names;
    for (const Plane& plane : image.planes) {
      if (plane.values.size() != image.pixel_count()) {
        throw Fault{where, "a plane of " + std::to_string(plane.values.size()) + " values",
                    std::to_string(image.pixel_count()) + " values, one per pixel"};
      }
      if (!names.insert(plane.name).second) throw Fault{where, "two planes of one name", "planes of different names"};
      header.channels().insert(plane.name, Imf::Channel(Imf::FLOAT));
      // OpenEXR's slices are not const, but writing reads only.
      frame.insert(plane.name, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(const_cast<float*>(plane.values.data())),
                                          sizeof(float), static_cast<std::size_t>(image.width) * sizeof(float)));
    }
    for (const auto& [key, text] : image.notes) header.insert(key, Imf::StringAttribute(text));
    Imf::OutputFile out(sink, header, 0);
    out.setFrameBuffer(frame);
    out.writePixels(image.height);
  } catch (const Fault&) {
    throw;
  } catch (const std::exception& e) {
    throw Fault{where, std::string("a picture that OpenEXR cannot write: ") + e.what(), "one that it can"};
  }
  write_whole_file(file, sink.bytes);
}

Image parse_exr(const std::string& where, std::span<const std::uint8_t> bytes, std::span<const std::string_view> only) {
  check_header(where, bytes);
  try {
    return parse(bytes, where, only);
  } catch (const Fault&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw Fault{where, "an OpenEXR file that asks for too much memory", wanted};
  } catch (const std::exception&) {
    // The library's own text may quote the file: it stays here.
    throw Fault{where, "an OpenEXR file that is damaged or cut short", wanted};
  }
}

Image read_exr(const std::filesystem::path& file, std::span<const std::string_view> only) {
  const std::string where = place(file.string());
  const std::vector<std::uint8_t> bytes = read_whole_file(file);
  rehearse(where, wanted, [&] { parse_exr(where, bytes, only); });
  return parse_exr(where, bytes, only);
}

}  // namespace tyndall
