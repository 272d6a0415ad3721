#include "tyndall/plot/svg.h"

#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string_view>

#include "tyndall/plot/text_width.h"

namespace tyndall {
namespace {

// Verdana has the widths of DejaVu Sans, the others are narrower: a reader without the font gets no overlaps.
constexpr std::string_view font_family = "DejaVu Sans, Bitstream Vera Sans, Verdana, Helvetica, Arial, sans-serif";

/// Any bytes as XML character data or attribute value.
std::string xml(std::string_view text) {
  std::string out;
  for (const char c : drawable(text)) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&#39;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

/// To a thousandth, without trailing zeros, whatever the locale.
std::string number(double x) {
  char text[64];
  const auto [end, error] = std::to_chars(text, text + sizeof text, x, std::chars_format::fixed, 3);
  if (error != std::errc() || !std::isfinite(x)) return "0";
  std::string_view digits(text, static_cast<std::size_t>(end - text));
  while (digits.back() == '0') digits.remove_suffix(1);
  if (digits.back() == '.') digits.remove_suffix(1);
  return digits == "-0" ? "0" : std::string(digits);
}

std::string attribute(std::string_view name, std::string_view value) {
  return ' ' + std::string(name) + "=\"" + xml(value) + '"';
}
std::string attribute(std::string_view name, double value) { return attribute(name, number(value)); }

std::string attributes(const Attributes& list) {
  std::string out;
  for (const auto& [name, value] : list) out += attribute(name == "class" ? name : "data-" + name, value);
  return out;
}

std::string hex(const Ink& ink) {
  char text[8];
  std::snprintf(text, sizeof text, "#%02x%02x%02x", ink.red & 0xFF, ink.green & 0xFF, ink.blue & 0xFF);
  return text;
}

std::string paint(const std::optional<Stroke>& stroke, const std::optional<Fill>& fill) {
  std::string out = attribute("fill", fill ? hex(fill->ink) : "none");
  if (fill && fill->opacity < 1.0) out += attribute("fill-opacity", fill->opacity);
  if (!stroke) return out;
  out += attribute("stroke", hex(stroke->ink)) + attribute("stroke-width", stroke->width);
  std::string dash;
  for (const double length : stroke->dash) dash += (dash.empty() ? "" : " ") + number(length);
  return dash.empty() ? out : out + attribute("stroke-dasharray", dash);
}

std::string text_of(const Path& path) {
  std::string d;
  for (std::size_t i = 0; i < path.points.size(); ++i) {
    d += (i == 0 ? "M" : i == 1 ? "L" : " ") + number(path.points[i].x) + ',' + number(path.points[i].y);
  }
  if (path.closed) d += 'Z';
  return "<path" + attributes(path.attributes) + paint(path.stroke, path.fill) +
         (path.fill ? attribute("fill-rule", "evenodd") : "") + attribute("d", d) + "/>\n";
}

std::string text_of(const Circle& circle) {
  return "<circle" + attribute("cx", circle.center.x) + attribute("cy", circle.center.y) +
         attribute("r", circle.radius) + paint(circle.stroke, circle.fill) + "/>\n";
}

/// A window onto the page: what is outside does not show. A nested <svg> needs no id, as a clip path would.
std::string window(const Rectangle& r) {
  const std::string sides = number(r.x) + ' ' + number(r.y) + ' ' + number(r.width) + ' ' + number(r.height);
  return "<svg" + attribute("x", r.x) + attribute("y", r.y) + attribute("width", r.width) +
         attribute("height", r.height) + attribute("viewBox", sides) + " overflow=\"hidden\">\n";
}

std::string text_of(const Text& text) {
  std::string out = "<text" + attribute("x", text.at.x) + attribute("y", text.at.y);
  if (text.upwards) {
    out += attribute("transform", "rotate(-90 " + number(text.at.x) + ' ' + number(text.at.y) + ')');
  }
  out += attribute("font-size", text.size);
  if (text.anchor != Anchor::start) out += attribute("text-anchor", text.anchor == Anchor::middle ? "middle" : "end");
  if (text.ink != Ink{}) out += attribute("fill", hex(text.ink));
  if (text.halo) out += " stroke=\"#ffffff\" stroke-width=\"2\" stroke-linejoin=\"round\" paint-order=\"stroke\"";
  out += '>' + xml(text.text) + "</text>\n";
  return has_exact_width(text.text) ? out : window(bounds(text)) + out + "</svg>\n";
}

}  // namespace

std::string svg_text(const Figure& figure, const SvgSize& size) {
  std::string out = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\"";
  out += attribute("width", size.width) + attribute("height", size.height);
  out += attribute("viewBox", "0 0 " + number(figure.width) + ' ' + number(figure.height));
  out += " role=\"img\"" + attribute("font-family", font_family) + " stroke-linejoin=\"round\">\n";
  out += "<title>" + xml(figure.title) + "</title>\n<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n";
  for (const Group& group : figure.groups) {
    out += "<g" + attributes(group.attributes) + ">\n" + (group.clip ? window(*group.clip) : "");
    for (const Mark& mark : group.marks) {
      out += std::visit([](const auto& m) { return text_of(m); }, mark);
    }
    out += std::string(group.clip ? "</svg>\n" : "") + "</g>\n";
  }
  return out + "</svg>\n";
}

}  // namespace tyndall
