#include "tyndall/plot/raster.h"

#include <cairo/cairo-ft.h>
#include <cairo/cairo.h>
#include FT_FREETYPE_H

#include <memory>
#include <numbers>
#include <stdexcept>
#include <string>

#include "tyndall/plot/text_width.h"

// The font file, byte for byte, in the program.
asm(".pushsection .rodata\n"
    ".balign 16\n"
    "tyndall_font_begin:\n"
    ".incbin \"" TYNDALL_FONT
    "\"\n"
    "tyndall_font_end:\n"
    ".byte 0\n"
    ".popsection\n");
extern "C" {
extern const unsigned char tyndall_font_begin[] __attribute__((visibility("hidden")));
extern const unsigned char tyndall_font_end[] __attribute__((visibility("hidden")));
}

namespace tyndall {
namespace {

struct Release {
  void operator()(cairo_font_face_t* p) const { cairo_font_face_destroy(p); }
  void operator()(cairo_font_options_t* p) const { cairo_font_options_destroy(p); }
  void operator()(cairo_surface_t* p) const { cairo_surface_destroy(p); }
  void operator()(cairo_t* p) const { cairo_destroy(p); }
};
template <class P>
using Owned = std::unique_ptr<std::remove_pointer_t<P>, Release>;

[[noreturn]] void fail(const std::string& what) {
  throw std::runtime_error("the picture could not be painted: " + what);
}

/// The font inside the program. cairo keeps fonts for later, so that it is the one to release what they stand on.
Owned<cairo_font_face_t*> font_face() {
  struct Font {
    FT_Library library = nullptr;
    FT_Face face = nullptr;
    ~Font() {
      if (face != nullptr) FT_Done_Face(face);
      if (library != nullptr) FT_Done_FreeType(library);
    }
  };
  auto font = std::make_unique<Font>();
  if (FT_Init_FreeType(&font->library) != 0) fail("FreeType does not start");
  const auto size = static_cast<FT_Long>(tyndall_font_end - tyndall_font_begin);
  if (FT_New_Memory_Face(font->library, tyndall_font_begin, size, 0, &font->face) != 0) fail("no font");
  static const cairo_user_data_key_t key{};
  Owned<cairo_font_face_t*> face(cairo_ft_font_face_create_for_ft_face(font->face, FT_LOAD_NO_HINTING));
  if (cairo_font_face_set_user_data(face.get(), &key, font.get(), [](void* p) { delete static_cast<Font*>(p); }) !=
      CAIRO_STATUS_SUCCESS) {
    face.reset();
    fail("no font");
  }
  font.release();
  return face;
}

class Painter {
 public:
  explicit Painter(cairo_t* to) : cairo_(to) {}

  void operator()(const Path& path) const {
    cairo_new_path(cairo_);
    for (const Point& p : path.points) cairo_line_to(cairo_, p.x, p.y);
    if (path.closed) cairo_close_path(cairo_);
    paint(path.stroke, path.fill);
  }
  void operator()(const Circle& circle) const {
    cairo_new_path(cairo_);
    cairo_arc(cairo_, circle.center.x, circle.center.y, circle.radius, 0.0, 2.0 * std::numbers::pi);
    cairo_close_path(cairo_);
    paint(circle.stroke, circle.fill);
  }
  void operator()(const Text& text) const {
    const std::string safe = drawable(text.text);
    cairo_save(cairo_);
    if (!has_exact_width(safe)) clip(bounds(text));
    cairo_set_font_size(cairo_, text.size);
    cairo_text_extents_t extents;
    cairo_text_extents(cairo_, safe.c_str(), &extents);
    const double before = text.anchor == Anchor::start    ? 0.0
                          : text.anchor == Anchor::middle ? extents.x_advance / 2.0
                                                          : extents.x_advance;
    cairo_translate(cairo_, text.at.x, text.at.y);
    if (text.upwards) cairo_rotate(cairo_, -std::numbers::pi / 2.0);
    cairo_new_path(cairo_);
    cairo_move_to(cairo_, -before, 0.0);
    cairo_text_path(cairo_, safe.c_str());
    if (text.halo) {
      ink({255, 255, 255}, 1.0);
      cairo_set_line_width(cairo_, 2.0);
      cairo_set_dash(cairo_, nullptr, 0, 0.0);
      cairo_stroke_preserve(cairo_);
    }
    ink(text.ink, 1.0);
    cairo_set_fill_rule(cairo_, CAIRO_FILL_RULE_WINDING);
    cairo_fill(cairo_);
    cairo_restore(cairo_);
  }
  void operator()(const Group& group) const {
    cairo_save(cairo_);
    if (group.clip) clip(*group.clip);
    for (const Mark& mark : group.marks) std::visit(*this, mark);
    cairo_restore(cairo_);
  }

 private:
  void clip(const Rectangle& r) const {
    cairo_new_path(cairo_);
    cairo_rectangle(cairo_, r.x, r.y, r.width, r.height);
    cairo_clip(cairo_);
  }
  void ink(const Ink& color, double opacity) const {
    cairo_set_source_rgba(cairo_, color.red / 255.0, color.green / 255.0, color.blue / 255.0, opacity);
  }
  void paint(const std::optional<Stroke>& stroke, const std::optional<Fill>& fill) const {
    if (fill) {
      ink(fill->ink, fill->opacity);
      cairo_set_fill_rule(cairo_, CAIRO_FILL_RULE_EVEN_ODD);
      cairo_fill_preserve(cairo_);
    }
    if (stroke) {
      ink(stroke->ink, 1.0);
      cairo_set_line_width(cairo_, stroke->width);
      cairo_set_dash(cairo_, stroke->dash.data(), static_cast<int>(stroke->dash.size()), 0.0);
      cairo_stroke(cairo_);
    }
    cairo_new_path(cairo_);
  }

  cairo_t* cairo_;
};

cairo_status_t append(void* to, const unsigned char* bytes, unsigned count) {
  try {
    auto& out = *static_cast<std::vector<std::uint8_t>*>(to);
    out.insert(out.end(), bytes, bytes + count);
    return CAIRO_STATUS_SUCCESS;
  } catch (...) {  // cairo is C
    return CAIRO_STATUS_NO_MEMORY;
  }
}

}  // namespace

std::vector<std::uint8_t> png_bytes(const Figure& figure, int width, int height) {
  const Owned<cairo_surface_t*> surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height));
  std::vector<std::uint8_t> out;
  {
    const Owned<cairo_font_face_t*> font = font_face();
    const Owned<cairo_font_options_t*> options(cairo_font_options_create());
    cairo_font_options_set_hint_style(options.get(), CAIRO_HINT_STYLE_NONE);
    cairo_font_options_set_hint_metrics(options.get(), CAIRO_HINT_METRICS_OFF);
    cairo_font_options_set_antialias(options.get(), CAIRO_ANTIALIAS_GRAY);
    const Owned<cairo_t*> cairo(cairo_create(surface.get()));
    cairo_set_source_rgb(cairo.get(), 1.0, 1.0, 1.0);
    cairo_paint(cairo.get());
    cairo_scale(cairo.get(), width / figure.width, height / figure.height);
    cairo_set_font_face(cairo.get(), font.get());
    cairo_set_font_options(cairo.get(), options.get());
    cairo_set_line_join(cairo.get(), CAIRO_LINE_JOIN_ROUND);
    const Painter painter(cairo.get());
    for (const Group& group : figure.groups) painter(group);
    if (cairo_status(cairo.get()) != CAIRO_STATUS_SUCCESS) fail(cairo_status_to_string(cairo_status(cairo.get())));
  }
  const cairo_status_t status = cairo_surface_write_to_png_stream(surface.get(), append, &out);
  if (status != CAIRO_STATUS_SUCCESS) fail(cairo_status_to_string(status));
  return out;
}

}  // namespace tyndall
