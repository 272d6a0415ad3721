#include "tyndall/image/radiance_picture.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

#include "tyndall/document/fault.h"

namespace tyndall {
namespace {

using Pixel = std::array<std::uint8_t, 4>;

struct Header {
  int width = 0, height = 0;
  bool bottom_first = false, right_first = false;
};

/// A walk through the file that never leaves it.
class Reader {
 public:
  Reader(const std::string& where, std::span<const std::uint8_t> bytes) : where_(where), bytes_(bytes) {}

  Decoded<float> picture() {
    const Header header = read_header();
    const auto width = static_cast<std::size_t>(header.width), height = static_cast<std::size_t>(header.height);
    // The old coding says a row of 16384 pixels in 12 bytes at best; what claims more is a small file after memory.
    if (width * height / 2048 > bytes_.size()) throw fault("fewer bytes than " + size_text(header) + " pixels take");
    Decoded<float> result{header.width, header.height, std::vector<float>(3 * width * height), {}};
    std::vector<Pixel> row(width);
    for (std::size_t y = 0; y < height; ++y) {
      read_row(row);
      float* const out = result.rgb.data() + 3 * width * (header.bottom_first ? height - 1 - y : y);
      for (std::size_t x = 0; x < width; ++x) put(row[header.right_first ? width - 1 - x : x], out + 3 * x);
    }
    return result;
  }

 private:
  Fault fault(const std::string& found) const { return {where_, found, "a sound Radiance picture (.hdr, RGBE)"}; }
  static std::string size_text(const Header& h) { return std::to_string(h.width) + " x " + std::to_string(h.height); }

  std::uint8_t byte() {
    if (at_ >= bytes_.size()) throw fault("a Radiance picture cut short");
    return bytes_[at_++];
  }

  std::string_view line() {
    const auto begin = bytes_.begin() + static_cast<std::ptrdiff_t>(at_);
    const auto end =
        std::find(begin, bytes_.begin() + static_cast<std::ptrdiff_t>(std::min(bytes_.size(), at_ + 4096)), '\n');
    const auto length = static_cast<std::size_t>(end - begin);
    if (at_ + length >= bytes_.size() || *end != '\n') throw fault("a Radiance header without end");
    const std::string_view text(reinterpret_cast<const char*>(bytes_.data()) + at_, length);
    at_ += length + 1;
    return text.ends_with('\r') ? text.substr(0, length - 1) : text;
  }

  Header read_header() {
    if (!line().starts_with("#?")) throw fault("not a Radiance picture");
    for (int lines = 0;; ++lines) {
      if (lines > 1000) throw fault("a Radiance header without end");
      const std::string_view text = line();
      if (text.empty()) break;
      if (text.starts_with("FORMAT=") && text != "FORMAT=32-bit_rle_rgbe") throw fault("a picture that is not RGBE");
    }
    return read_size(line());
  }

  /// "-Y 512 +X 1024": rows from the top, each from the left.
  Header read_size(std::string_view text) const {
    Header header;
    const auto axis = [&](char name, int& count, bool& reversed, char reverse) {
      const bool sound = text.size() > 3 && (text[0] == '-' || text[0] == '+') && text[1] == name && text[2] == ' ';
      if (!sound) throw fault("a Radiance picture by columns, or of no stated size");
      reversed = text[0] == reverse;
      const auto [end, error] = std::from_chars(text.data() + 3, text.data() + text.size(), count);
      if (error != std::errc{} || count < 1 || count > longest_side) {
        throw Fault(where_, "a picture size out of range", "1 to 16384 pixels a side");
      }
      text.remove_prefix(static_cast<std::size_t>(end - text.data()));
      if (text.starts_with(' ')) text.remove_prefix(1);
    };
    axis('Y', header.height, header.bottom_first, '+');
    axis('X', header.width, header.right_first, '-');
    if (std::int64_t{header.width} * header.height > most_pixels) {
      throw Fault(where_, "a picture of " + size_text(header) + " pixels", "at most 134 million");
    }
    return header;
  }

  void read_row(std::vector<Pixel>& row) {
    Pixel first;
    for (std::uint8_t& b : first) b = byte();
    const bool coded = first[0] == 2 && first[1] == 2 && first[2] < 128;
    if (coded && row.size() >= 8 && row.size() < 32768) {
      if ((std::size_t{first[2]} << 8 | first[3]) != row.size()) throw fault("a row of another length");
      for (std::size_t component = 0; component < 4; ++component) read_component(row, component);
    } else {
      read_flat(row, first);
    }
  }

  /// New coding: a count above 128 repeats the next byte count - 128 times, another is followed by as many bytes.
  void read_component(std::vector<Pixel>& row, std::size_t component) {
    for (std::size_t x = 0; x < row.size();) {
      const std::uint8_t count = byte();
      const bool run = count > 128;
      const std::size_t length = run ? count - 128U : count;
      if (length == 0 || length > row.size() - x) throw fault("a run that does not fit its row");
      std::uint8_t value = run ? byte() : std::uint8_t{0};
      for (std::size_t i = 0; i < length; ++i) row[x++][component] = run ? value : byte();
    }
  }

  /// Pixel by pixel; old coding: mantissas 1, 1, 1 repeat the pixel before, further such pixels being higher digits of
  /// the count.
  void read_flat(std::vector<Pixel>& row, Pixel pixel) {
    int shift = 0;
    for (std::size_t x = 0;;) {
      if (pixel[0] == 1 && pixel[1] == 1 && pixel[2] == 1) {
        const std::size_t length = std::size_t{pixel[3]} << shift;
        if (x == 0 || shift > 16 || length > row.size() - x) throw fault("a run that does not fit its row");
        std::fill_n(row.begin() + static_cast<std::ptrdiff_t>(x), length, row[x - 1]);
        x += length;
        shift += 8;
      } else {
        row[x++] = pixel;
        shift = 0;
      }
      if (x >= row.size()) return;
      for (std::uint8_t& b : pixel) b = byte();
    }
  }

  static void put(const Pixel& pixel, float* out) {
    const float unit = pixel[3] == 0 ? 0.0F : std::ldexp(1.0F, pixel[3] - 136);
    for (std::size_t c = 0; c < 3; ++c) out[c] = static_cast<float>(pixel[c]) * unit;
  }

  const std::string& where_;
  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
};

}  // namespace

Decoded<float> decode_radiance(const std::string& where, std::span<const std::uint8_t> bytes) {
  return Reader(where, bytes).picture();
}

}  // namespace tyndall
