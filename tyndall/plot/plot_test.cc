// What every figure promises: labels that stand apart on the page, lines that are the library's numbers.
#include "tyndall/plot/plot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "tyndall/document/fault.h"
#include "tyndall/document/law_text.h"
#include "tyndall/plot/lines.h"
#include "tyndall/plot/style.h"
#include "tyndall/plot/svg.h"
#include "tyndall/plot/text_width.h"

namespace tyndall {
namespace {

Subject law(const std::string& text) { return subject_of(text, law_from_text(text)); }

Subject medium(std::string name, std::vector<Species> species) {
  return subject_of(std::move(name), Medium{std::move(species)});
}

Subject coloured(const std::string& name = "Two coloured species", double scale = 1.0) {
  Species haze{"amber haze", {{{4e-3, 2.5e-3, 1e-3}}}, {{{0.0, 5e-4, 2e-3}}}, HenyeyGreenstein<double>{0.85}, {}};
  Species smoke{"blue smoke", {{{5e-4, 1.5e-3, 4e-3}}}, Spectrum::grey(1e-4), Rayleigh<double>{}, {}};
  for (Species* s : {&haze, &smoke}) {
    s->scattering *= scale;
    s->absorption *= scale;
  }
  return medium(name, {haze, smoke});
}

Subject absorbing() { return medium("Soot", {{"soot", {}, {{{0.1, 0.12, 0.15}}}, Isotropic<double>{}, {}}}); }

std::vector<Subject> eight() {
  std::vector<Subject> out;
  for (int i = 0; i < 8; ++i) {
    out.push_back(coloured(std::string(static_cast<std::size_t>(12 * i + 1), 'W') + " name", std::pow(10.0, i - 4)));
  }
  return out;
}

/// A law that is next to 0 in half of all directions.
Subject dips() {
  Subject subject = law("mie_hazy");
  subject.name = "dips";
  for (auto& phase : subject.phase) phase = {{1.0, PowerLobe<double>{200}}};
  return subject;
}

struct Case {
  std::string what;
  std::vector<Subject> subjects;
};

std::vector<Case> cases() {
  Subject tagged = coloured("By wavelength");
  tagged.channels = {"680.25 nm", "550.125 nm", "440.0625 nm"};
  Subject crowd = coloured("A crowd");
  while (crowd.parts.size() < 30) crowd.parts.push_back(crowd.parts[crowd.parts.size() % 2]);
  return {{"isotropic", {law("isotropic")}},
          {"peak", {law("henyey_greenstein:g=0.9999")}},
          {"backward peak", {law("henyey_greenstein:g=-0.9999")}},
          {"laws", {law("isotropic"), law("rayleigh"), law("mie_hazy"), law("mie_murky")}},
          {"coloured", {coloured()}},
          {"tagged", {tagged}},
          {"crowd", {crowd}},
          {"absorbing", {absorbing()}},
          {"vacuum", {medium("Nothing", {})}},
          {"vacuum and fog", {medium("", {}), coloured()}},
          {"mixed", {coloured(), absorbing(), law("mie_hazy")}},
          {"thin and thick", {coloured("thin", 1e-9), coloured("thick", 1e9)}},
          {"immense", {coloured("nothing to speak of", 1e-290), coloured("wall", 1e30)}},
          {"zero ahead and behind", {dips()}},
          {"eight", eight()}};
}

std::vector<PlotOptions> ways() {
  std::vector<PlotOptions> out;
  for (const bool log : {false, true}) {
    for (const bool species : {false, true}) {
      out.push_back({{}, log, species, {}});
      out.push_back({{}, log, species, 3.5});
      out.push_back({{Panel::phase}, log, species, {}});
      out.push_back({{Panel::polar}, log, species, {}});
      out.push_back({{Panel::table}, log, species, {}});
      out.push_back({{Panel::polar, Panel::polar_log, Panel::phase}, log, species, {}});
    }
  }
  return out;
}

std::vector<Text> texts_of(const Figure& figure) {
  std::vector<Text> out;
  for (const Group& group : figure.groups) {
    for (const Mark& mark : group.marks) {
      if (const auto* text = std::get_if<Text>(&mark)) out.push_back(*text);
    }
  }
  return out;
}

bool overlap(const Rectangle& a, const Rectangle& b) {
  // Lines of text may touch: letters stay well inside their line.
  const double free = 0.5;
  return a.x < b.right() - free && b.x < a.right() - free && a.y < b.bottom() - free && b.y < a.bottom() - free;
}

TEST(PlotLabels, StandOnThePageAndApartAndAreNotTooSmall) {
  for (const Case& c : cases()) {
    for (const PlotOptions& how : ways()) {
      const Figure figure = plot(c.subjects, how);
      const std::vector<Text> texts = texts_of(figure);
      ASSERT_FALSE(texts.empty()) << c.what;
      for (std::size_t i = 0; i < texts.size(); ++i) {
        const Rectangle box = bounds(texts[i]);
        EXPECT_GE(texts[i].size, 7.0);
        EXPECT_TRUE(box.x >= 0.0 && box.y >= 0.0 && box.right() <= figure.width && box.bottom() <= figure.height)
            << c.what << ": " << texts[i].text << " leaves the page";
        for (std::size_t k = 0; k < i; ++k) {
          EXPECT_FALSE(overlap(box, bounds(texts[k])))
              << c.what << ": \"" << texts[i].text << "\" lies on \"" << texts[k].text << "\" at " << box.x << ","
              << box.y << " and " << bounds(texts[k]).x << "," << bounds(texts[k]).y;
        }
      }
    }
  }
}

TEST(PlotLabels, StayApartInEveryShape) {
  for (const double aspect : {0.45, 0.6, 1.0, 2.0, 4.0}) {
    const std::vector<Text> texts = texts_of(plot(std::vector{coloured()}, {{}, false, true, aspect}));
    for (std::size_t i = 0; i < texts.size(); ++i) {
      for (std::size_t k = 0; k < i; ++k) {
        EXPECT_FALSE(overlap(bounds(texts[i]), bounds(texts[k]))) << aspect << texts[i].text << texts[k].text;
      }
    }
  }
}

/// The panels' axes and curves, read back from the SVG's own text.
struct Curve {
  std::map<std::string, std::string> names;
  std::vector<Point> points;
};
struct ReadPanel {
  std::map<std::string, std::vector<double>> axes;  // low high begin end
  std::map<std::string, bool> logarithmic;
  std::vector<Curve> curves;

  double value(const std::string& axis, double at) const {
    const std::vector<double>& a = axes.at(axis);
    const double share = (at - a[2]) / (a[3] - a[2]);
    return logarithmic.at(axis) ? a[0] * std::pow(a[1] / a[0], share) : a[0] + share * (a[1] - a[0]);
  }
};

std::string attribute(const std::string& line, const std::string& name) {
  const std::size_t begin = line.find(' ' + name + "=\"");
  if (begin == line.npos) return "";
  const std::size_t from = begin + name.size() + 3;
  return line.substr(from, line.find('"', from) - from);
}

std::vector<ReadPanel> read_back(const std::string& svg) {
  std::vector<ReadPanel> panels;
  std::istringstream lines(svg);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("<g class=\"frame\"")) {
      panels.emplace_back();
      for (const char* axis : {"x-axis", "y-axis", "radius-axis", "center"}) {
        std::istringstream words(attribute(line, std::string("data-") + axis));
        std::string kind;
        words >> kind;
        panels.back().logarithmic[axis] = kind == "log";
        for (double x; words >> x;) panels.back().axes[axis].push_back(x);
      }
    } else if (line.starts_with("<path class=\"curve")) {
      Curve curve;
      for (const char* name : {"class", "data-of", "data-channel", "data-part"}) {
        curve.names[name] = attribute(line, name);
      }
      std::string d = attribute(line, "d");
      for (char& c : d) c = c == 'M' || c == 'L' || c == ',' || c == 'Z' ? ' ' : c;
      std::istringstream numbers(d);
      for (Point p; numbers >> p.x >> p.y;) curve.points.push_back(p);
      panels.back().curves.push_back(std::move(curve));
    }
  }
  return panels;
}

constexpr double pi = 3.14159265358979323846;
constexpr double rounding = 0.0006;  // of coordinates in the SVG [points]

TEST(PlotCurves, OfThePhaseFunctionAreItsDensity) {
  for (const bool log : {false, true}) {
    for (const std::string& text :
         {std::string("isotropic"), std::string("rayleigh"), std::string("mie_murky"),
          std::string("henyey_greenstein:g=0.9999"), std::string("henyey_greenstein:g=-0.97")}) {
      const Subject subject = law(text);
      const Figure figure = plot(std::vector{subject}, {{Panel::phase}, log, false, {}});
      const std::vector<ReadPanel> panels = read_back(svg_text(figure, {"100", "100"}));
      ASSERT_EQ(panels.size(), 1u);
      const ReadPanel& panel = panels[0];
      ASSERT_EQ(panel.curves.size(), 1u);
      ASSERT_GE(panel.curves[0].points.size(), 2u);
      const auto density = [&](double x) {
        const double degrees = std::clamp(panel.value("x-axis", x), 0.0, 180.0);
        return density_at(subject.phase[0], degrees * pi / 180.0);
      };
      for (const Point& p : panel.curves[0].points) {
        // Between the densities a rounding error away in both directions.
        const double a = density(p.x - rounding), b = density(p.x + rounding), here = density(p.x);
        EXPECT_LE(panel.value("y-axis", p.y + rounding), std::max({a, b, here}) * (1.0 + 1e-9)) << text << p.x;
        EXPECT_GE(panel.value("y-axis", p.y - rounding), std::min({a, b, here}) * (1.0 - 1e-9)) << text << p.x;
      }
      // The peak is met, not approached.
      const Point first = panel.curves[0].points.front();
      EXPECT_NEAR(std::log(panel.value("y-axis", first.y) / density(first.x)), 0.0, 1e-3) << text;
    }
  }
}

TEST(PlotCurves, AroundTheCentreAreTheDensityOfEveryChannelAndSpecies) {
  const Subject subject = coloured();
  for (const Panel kind : {Panel::polar, Panel::polar_log}) {
    const Figure figure = plot(std::vector{subject}, {{kind}, false, true, {}});
    const std::vector<ReadPanel> panels = read_back(svg_text(figure, {"100", "100"}));
    ASSERT_EQ(panels.size(), 1u);
    const ReadPanel& panel = panels[0];
    ASSERT_EQ(panel.curves.size(), 5u);
    const std::vector<double>& center = panel.axes.at("center");
    for (const Curve& curve : panel.curves) {
      const auto channel = static_cast<std::size_t>(
          std::find(subject.channels.begin(), subject.channels.end(), curve.names.at("data-channel")) -
          subject.channels.begin());
      ASSERT_LT(channel, channel_count);
      for (const Point& p : curve.points) {
        const double x = p.x - center[2], y = center[3] - p.y, radius = std::hypot(x, y);
        if (radius < 1.0) continue;  // its angle says little
        const double angle = std::atan2(std::fabs(y), x);
        double expected = density_at(subject.phase[channel], angle);
        for (const SubjectPart& part : subject.parts) {
          if (part.name == curve.names.at("data-part")) {
            expected = part.share[channel] * density_at(part.phase[channel], angle);
          }
        }
        const double drawn = panel.value("radius-axis", radius), slack = panel.value("radius-axis", radius + 0.01);
        EXPECT_NEAR(drawn, expected, slack - drawn) << curve.names.at("data-part") << angle;
      }
    }
  }
}

TEST(PlotCurves, AgainstDistanceAreTheTransmittance) {
  const Subject subject = coloured();
  for (const bool log : {false, true}) {
    const Figure figure = plot(std::vector{subject}, {{Panel::transmittance}, log, false, {}});
    const std::vector<ReadPanel> panels = read_back(svg_text(figure, {"100", "100"}));
    ASSERT_EQ(panels.size(), 1u);
    ASSERT_EQ(panels[0].curves.size(), channel_count);
    for (const Curve& curve : panels[0].curves) {
      const auto channel = static_cast<std::size_t>(
          std::find(subject.channels.begin(), subject.channels.end(), curve.names.at("data-channel")) -
          subject.channels.begin());
      for (const Point& p : curve.points) {  // visibilities near 600 m: the axis is in metres
        EXPECT_NEAR(panels[0].value("y-axis", p.y),
                    100.0 * std::exp(-subject.extinction[channel] * panels[0].value("x-axis", p.x)), 5e-3);
      }
    }
  }
}

TEST(PlotCurves, OfSpeciesAddUpToTheWhole) {
  const std::vector<Subject> subjects{coloured()};
  const std::vector<Line> lines = lines_of(subjects, Quantity::phase, true);
  for (const double angle : {0.0, 0.3, 1.0, 2.0, pi}) {
    double parts = 0.0, whole = 0.0;
    for (const Line& line : lines) {
      if (line.part != nullptr) parts += density_of(line, angle);
      if (line.part == nullptr && line.channel == reference_channel) whole = density_of(line, angle);
    }
    EXPECT_NEAR(parts, whole, 1e-14 * whole);
  }
}

TEST(PlotLines, LeaveOutChannelsThatDoNotScatter) {
  const Spectrum scattering{{{0.0, 0.0, 1e-3}}};
  const std::vector<Subject> subjects{medium("blue", {{"a", scattering, Spectrum::grey(1e-4), Rayleigh<double>{}, {}}}),
                                      law("mie_hazy")};
  for (const std::span<const Subject> drawn : {std::span(subjects).first(1), std::span(subjects)}) {
    const std::vector<Line> lines = lines_of(drawn, Quantity::phase, false);
    ASSERT_EQ(lines.size(), drawn.size());
    EXPECT_EQ(lines[0].channel, 2u);
    EXPECT_GT(density_of(lines[0], 0.0), 0.05);
  }
  EXPECT_FALSE(is_coloured(subjects[0], Quantity::phase));
  EXPECT_TRUE(is_coloured(subjects[0], Quantity::transmittance));
}

TEST(PlotLines, TellSubjectsAndChannelsApart) {
  std::vector<Stroke> strokes;
  for (std::size_t i = 0; i < most_plotted; ++i) strokes.push_back(style::subject_line(i));
  for (std::size_t c = 0; c < channel_count; ++c) strokes.push_back(style::channel_line(c));
  for (std::size_t i = 0; i < strokes.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if ((i < most_plotted) != (k < most_plotted)) continue;
      EXPECT_NE(strokes[i].dash, strokes[k].dash) << "a print without colour must tell " << i << " from " << k;
      EXPECT_FALSE(strokes[i].ink == strokes[k].ink);
    }
  }
  EXPECT_EQ(lines_of(std::vector{coloured()}, Quantity::phase, false).size(), channel_count);
  EXPECT_EQ(lines_of(std::vector{law("rayleigh")}, Quantity::phase, false).size(), 1u);
  EXPECT_EQ(lines_of(std::vector{law("rayleigh")}, Quantity::transmittance, false).size(), 0u);
  EXPECT_EQ(lines_of(std::vector{absorbing()}, Quantity::phase, true).size(), 0u);
  EXPECT_EQ(lines_of(eight(), Quantity::phase, false).size(), 8u);
}

TEST(Plot, IsTheSameForTheSameSubjects) {
  const std::vector<Subject> subjects{coloured(), law("mie_hazy")};
  const PlotOptions how{{}, false, true, {}};
  EXPECT_EQ(svg_text(plot(subjects, how), {"1", "1"}), svg_text(plot(subjects, how), {"1", "1"}));
}

TEST(Plot, RefusesWhatItCannotDraw) {
  EXPECT_THROW(plot({}, {}), Fault);
  EXPECT_THROW(plot(std::vector<Subject>(9, law("isotropic")), {}), Fault);
  EXPECT_THROW(plot(std::vector{law("isotropic")}, {{Panel::transmittance}, false, false, {}}), Fault);
  EXPECT_THROW(plot(std::vector{coloured()}, {{}, false, false, 0.1}), Fault);
  EXPECT_THROW(plot(std::vector{coloured()}, {{}, false, false, 10.0}), Fault);
}

TEST(Plot, HoldsFiniteCoordinatesWhateverTheMedium) {
  for (const Case& c : cases()) {
    for (const PlotOptions& how : ways()) {
      for (const Group& group : plot(c.subjects, how).groups) {
        for (const Mark& mark : group.marks) {
          const auto* path = std::get_if<Path>(&mark);
          for (const Point& p : path != nullptr ? path->points : std::vector<Point>{}) {
            ASSERT_TRUE(std::fabs(p.x) < 1e4 && std::fabs(p.y) < 1e4) << c.what;
          }
        }
      }
    }
  }
}

TEST(Plot, SaysSoWhereNothingScatters) {
  const Figure figure = plot(std::vector{absorbing()}, {{Panel::phase}, false, false, {}});
  EXPECT_THAT(svg_text(figure, {"1", "1"}), testing::HasSubstr("nothing scatters here"));
}

}  // namespace
}  // namespace tyndall
