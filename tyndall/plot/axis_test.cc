#include "tyndall/plot/axis.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "tyndall/plot/curve.h"
#include "tyndall/plot/svg.h"
#include "tyndall/plot/text_width.h"

namespace tyndall {
namespace {

std::vector<std::string> labels(const std::vector<Tick>& ticks) {
  std::vector<std::string> out;
  for (const Tick& tick : ticks) {
    if (!tick.label.empty()) out.push_back(tick.label);
  }
  return out;
}

TEST(Axis, LabelsRoundValues) {
  using testing::ElementsAre;
  EXPECT_THAT(labels(ticks_of({false, 0.0, 700.0, 0.0, 200.0}, 40.0)), ElementsAre("0", "200", "400", "600"));
  EXPECT_THAT(labels(ticks_of({false, 0.0, 1.2, 0.0, 200.0}, 60.0)), ElementsAre("0", "0.5", "1.0"));
  EXPECT_THAT(labels(ticks_of({true, 0.02, 0.5, 100.0, 0.0}, 12.0)), ElementsAre("0.02", "0.05", "0.1", "0.2", "0.5"));
  EXPECT_THAT(labels(ticks_of({true, 1e-6, 1e6, 0.0, 100.0}, 12.0)),
              ElementsAre("10⁻⁶", "10⁻⁴", "10⁻²", "1", "10²", "10⁴", "10⁶"));
  EXPECT_THAT(labels(angle_ticks_of({false, 0.0, 180.0, 0.0, 200.0}, 30.0)),
              ElementsAre("0", "30", "60", "90", "120", "150", "180"));
  EXPECT_THAT(labels(angle_ticks_of({false, 0.0, 180.0, 0.0, 100.0}, 30.0)), ElementsAre("0", "60", "120", "180"));
  EXPECT_THAT(labels(distance_ticks_of({true, 0.05, 2e4, 0.0, 200.0}, 30.0)),
              ElementsAre("10 cm", "1 m", "10 m", "100 m", "1 km", "10 km"));
}

TEST(Axis, TicksAscendOnItWithLabelsApart) {
  for (const bool logarithmic : {false, true}) {
    for (double low = 1e-12; low < 1e12; low *= 7.3) {
      for (const double ratio : {1.7, 3.0, 20.0, 1e3, 1e9, 1e17}) {
        const Axis axis{logarithmic, logarithmic ? low : 0.0, low * ratio, 10.0, 210.0};
        const std::vector<Tick> ticks = ticks_of(axis, 32.0);
        std::set<std::string> seen;
        double last = -1e300, last_label = -1e300;
        for (const Tick& tick : ticks) {
          const double at = axis.at(tick.value);
          EXPECT_GT(tick.value, last);
          EXPECT_TRUE(at >= 10.0 - 1e-6 && at <= 210.0 + 1e-6) << low << " " << ratio;
          last = tick.value;
          if (tick.label.empty()) continue;
          EXPECT_GE(at - last_label, 29.0) << low << " " << ratio;
          EXPECT_TRUE(seen.insert(tick.label).second) << tick.label;
          last_label = at;
        }
        EXPECT_LE(ticks.size(), 200u);
      }
    }
  }
}

TEST(Axis, LimitsHoldTheirValues) {
  for (double x = 1e-12; x < 1e12; x *= 1.37) {
    for (const double ratio : {1.0, 1.5, 4.0, 99.0, 1e7}) {
      for (const Limits limits : {round_limits(x, x * ratio), decade_limits(x, x * ratio)}) {
        EXPECT_LE(limits.low, x * (1 + 1e-8));
        EXPECT_GE(limits.high, x * ratio * (1 - 1e-8));
        EXPECT_GE(limits.low, x / 10.001);
        EXPECT_LE(limits.high, x * ratio * 10.001);
      }
    }
  }
}

TEST(Quantities, HaveThreeDigitsAndFittingUnits) {
  EXPECT_EQ(quantity_text(0.0), "0");
  EXPECT_EQ(quantity_text(0.0123456), "0.0123");
  EXPECT_EQ(quantity_text(999.6), "1000");
  EXPECT_EQ(quantity_text(-12.345), "\u221212.3");
  EXPECT_EQ(quantity_text(1.5915e7), "1.59×10⁷");
  EXPECT_EQ(quantity_text(std::nan("")), "–");
  EXPECT_EQ(quantity_text(std::numeric_limits<double>::infinity()), "∞");
  EXPECT_EQ(share_text(0.5), "0.500");
  EXPECT_EQ(share_text(0.9999), "0.9999");
  EXPECT_EQ(share_text(1.0), "1");
  EXPECT_EQ(distance_text(1234.0), "1.23 km");
  EXPECT_EQ(distance_text(0.5), "50.0 cm");
  EXPECT_EQ(distance_text(0.0001), "0.100 mm");
  EXPECT_EQ(distance_text(1e-30), "< 1 µm");
  EXPECT_EQ(distance_text(1e300), "> 10⁶ km");
  EXPECT_EQ(share_text(-0.99999999), "~\u22121");
}

double distance_to_line(const std::vector<Point>& points, const Point& p) {
  double least = 1e300;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Point a = points[i - 1], b = points[i];
    const double dx = b.x - a.x, dy = b.y - a.y, squared = dx * dx + dy * dy;
    const double t = squared > 0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / squared, 0.0, 1.0) : 0.0;
    least = std::min(least, std::hypot(a.x + t * dx - p.x, a.y + t * dy - p.y));
  }
  return least;
}

TEST(Curve, StaysWithinItsToleranceOfTheTruth) {
  // A Lorentz peak of half width 1e-4 on a logarithmic axis of values, as a sharp phase function is drawn.
  const auto at = [](double t) { return Point{60.0 * t, 10.0 * std::log10(1e8 / (1.0 + std::pow(t / 1e-4, 2.0)))}; };
  const std::vector<Point> drawn = curve(angles_from(0.0), at);
  EXPECT_LT(drawn.size(), 1500u);
  for (int i = 0; i < 4000; ++i) {
    const double t = 3.14159 * std::pow(i / 4000.0, 5.0);
    EXPECT_LE(distance_to_line(drawn, at(t)), curve_tolerance) << t;
  }
}

TEST(Curve, IsTwoPointsWhereItIsStraight) {
  EXPECT_LE(curve(angles_from(0.0), [](double t) { return Point{t, 3.0 * t}; }).size(), 40u);
}

TEST(Angles, AscendFromTheirFirstToPi) {
  for (const double least : {0.0, 1e-6, 0.02}) {
    const std::vector<double> angles = angles_from(least);
    EXPECT_EQ(angles.front(), least);
    EXPECT_DOUBLE_EQ(angles.back(), 3.14159265358979323846);
    EXPECT_TRUE(std::is_sorted(angles.begin(), angles.end()));
  }
}

TEST(TextWidth, ShortensToWhatFits) {
  const std::string text = "a long name of a medium";
  for (const double width : {10.0, 30.0, 60.0}) {
    const std::string kept = shortened(text, 8.0, width);
    EXPECT_LE(text_width(kept, 8.0), std::max(width, text_width("…", 8.0)));
    EXPECT_THAT(kept, testing::EndsWith("…"));
  }
  EXPECT_EQ(shortened(text, 8.0, 1000.0), text);
  EXPECT_TRUE(has_exact_width("Nebel über 10⁻⁴ sr⁻¹ – 50 °"));
  EXPECT_FALSE(has_exact_width("上海"));
}

TEST(Svg, WritesTextAsData) {
  Figure figure{100.0, 100.0, "</title><script>", {}};
  Group group{{{"class", "x"}, {"of", "\"><script>'"}}, {}, {}};
  group.marks.emplace_back(
      Text{{1.0, 2.0}, "</text><script>&\x01\xff\xef\xbf\xbf", 8.0, Anchor::start, false, {}, false});
  figure.groups.push_back(group);
  const std::string svg = svg_text(figure, {"100", "100"});
  EXPECT_THAT(svg, testing::Not(testing::HasSubstr("<script")));
  EXPECT_THAT(svg, testing::HasSubstr("&lt;/text&gt;&lt;script&gt;&amp;\\u0001\\xff\uFFFD"));
  EXPECT_THAT(svg, testing::HasSubstr("data-of=\"&quot;&gt;&lt;script&gt;&#39;\""));
}

}  // namespace
}  // namespace tyndall
