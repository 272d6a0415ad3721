#include "tyndall/plot/raster.h"

#include <cairo/cairo-ft.h>
#include <cairo/cairo.h>
#include <gtest/gtest.h>
#include FT_FREETYPE_H

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "tyndall/document/law_text.h"
#include "tyndall/plot/plot.h"
#include "tyndall/plot/text_width.h"

namespace tyndall {
namespace {

struct Picture {
  int width = 0, height = 0;
  std::vector<std::uint32_t> pixels;  // 0xRRGGBB
};

Picture read_png(const std::vector<std::uint8_t>& bytes) {
  struct Reader {
    const std::vector<std::uint8_t>& bytes;
    std::size_t at = 0;
  } reader{bytes};
  const auto read = [](void* from, unsigned char* to, unsigned count) {
    auto& r = *static_cast<Reader*>(from);
    if (r.at + count > r.bytes.size()) return CAIRO_STATUS_READ_ERROR;
    std::memcpy(to, r.bytes.data() + r.at, count);
    r.at += count;
    return CAIRO_STATUS_SUCCESS;
  };
  cairo_surface_t* surface = cairo_image_surface_create_from_png_stream(read, &reader);
  Picture out{cairo_image_surface_get_width(surface), cairo_image_surface_get_height(surface), {}};
  const int stride = cairo_image_surface_get_stride(surface);
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) {
      std::uint32_t pixel = 0;
      std::memcpy(&pixel, cairo_image_surface_get_data(surface) + y * stride + 4 * x, 4);
      out.pixels.push_back(pixel & 0xFFFFFFu);
    }
  }
  cairo_surface_destroy(surface);
  return out;
}

Figure laws() {
  return plot(std::vector{subject_of("a", law_from_text("mie_hazy")), subject_of("b", law_from_text("rayleigh"))}, {});
}

TEST(Raster, PaintsTheFigureInTheSizeAskedFor) {
  const Picture picture = read_png(png_bytes(laws(), 640, 480));
  ASSERT_EQ(picture.width, 640);
  ASSERT_EQ(picture.height, 480);
  const auto count = [&](auto is) { return std::count_if(picture.pixels.begin(), picture.pixels.end(), is); };
  EXPECT_GT(count([](std::uint32_t p) { return p == 0xFFFFFF; }), 640 * 480 / 2);
  // Letters and both curves, of blue and orange ink.
  EXPECT_GT(count([](std::uint32_t p) { return (p >> 16) < 0x60 && (p & 0xFF) < 0x60; }), 500);
  EXPECT_GT(count([](std::uint32_t p) { return (p >> 16) < 0x60 && (p & 0xFF) > 0x90; }), 300);
  EXPECT_GT(count([](std::uint32_t p) { return (p >> 16) > 0xB0 && (p & 0xFF) < 0x60; }), 300);
}

TEST(Raster, IsTheSameEveryTime) { EXPECT_EQ(png_bytes(laws(), 400, 300), png_bytes(laws(), 400, 300)); }

TEST(Raster, PaintsAnyBytesAsText) {
  Figure figure{100.0, 100.0, "", {}};
  Group group;
  std::string text;
  for (int c = 1; c < 256; ++c) text += static_cast<char>(c);
  group.marks.emplace_back(Text{{1.0, 50.0}, text + "\xef\xbf\xbe\xef\xb7\x90", 8.0, Anchor::middle, true, {}, true});
  figure.groups.push_back(group);
  EXPECT_EQ(read_png(png_bytes(figure, 100, 100)).width, 100);
}

TEST(TextWidth, IsThatOfTheFontInside) {
  FT_Library library = nullptr;
  FT_Face face = nullptr;
  ASSERT_EQ(FT_Init_FreeType(&library), 0);
  ASSERT_EQ(FT_New_Face(library, TYNDALL_FONT, 0, &face), 0);
  const double em = face->units_per_EM;
  const auto check = [&](char32_t c, const std::string& text) {
    ASSERT_EQ(FT_Load_Char(face, c, FT_LOAD_NO_SCALE), 0);
    EXPECT_TRUE(has_exact_width(text)) << text;
    EXPECT_DOUBLE_EQ(text_width(text, em), static_cast<double>(face->glyph->metrics.horiAdvance)) << text;
  };
  for (char32_t c = 0x20; c < 0x7F; ++c) check(c, std::string(1, static_cast<char>(c)));
  for (char32_t c = 0xA0; c <= 0xFF; ++c) {
    check(c, {static_cast<char>(0xC0 | (c >> 6)), static_cast<char>(0x80 | (c & 0x3F))});
  }
  for (const char32_t c : {0x2070, 0x2074, 0x2079, 0x207B, 0x2013, 0x2026, 0x2212, 0x221E}) {
    check(c, {static_cast<char>(0xE0 | (c >> 12)), static_cast<char>(0x80 | ((c >> 6) & 0x3F)),
              static_cast<char>(0x80 | (c & 0x3F))});
  }
  FT_Done_Face(face);
  FT_Done_FreeType(library);
}

}  // namespace
}  // namespace tyndall
