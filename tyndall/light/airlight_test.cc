// Airlight against published truth and against quadratures of another make.
#include <gtest/gtest.h>

#include <functional>
#include <random>

#include "tyndall/light/airlight_adaptive.h"
#include "tyndall/light/airlight_spot.h"
#include "tyndall/phase/law.h"

namespace tyndall {
namespace {

std::vector<ScatteringLobe> lobes_of(const Law<double>& law, const Spectrum& scattering) {
  std::vector<ScatteringLobe> out;
  for (const auto& part : lower(law)) out.push_back({scattering * part.weight, part.lobe});
  return out;
}

/// Adaptive Gauss-Kronrod (7, 15), nodes and weights of QUADPACK's dqk15 (Piessens et al. 1983), in the distance t
/// itself: nothing here knows of asinh or closed forms.
double kronrod(const std::function<double(double)>& f, double begin, double end, double tolerance, int depth) {
  static constexpr double node[8] = {0.991455371120812639206854697526329, 0.949107912342758524526189684047851,
                                     0.864864423359769072789712788640926, 0.741531185599394439863864773280788,
                                     0.586087235467691130294144691693013, 0.405845151377397166906606412076961,
                                     0.207784955007898467600689403773245, 0.0};
  static constexpr double kronrod_weight[8] = {
      0.022935322010529224963732008058970, 0.063092092629978553290700663189204, 0.104790010322250183839876322541518,
      0.140653259715525918745189590510238, 0.169004726639267902826583426598550, 0.190350578064785409913256402421014,
      0.204432940075298892414161999234649, 0.209482141084727828012999174891714};
  static constexpr double gauss_weight[4] = {0.129484966168869693270611432679082, 0.279705391489276667901467771423780,
                                             0.381830050505118944950369775488975, 0.417959183673469387755102040816327};
  const double middle = 0.5 * (begin + end), half = 0.5 * (end - begin);
  double k = 0.0, g = 0.0;
  for (int i = 0; i < 8; ++i) {
    const double value = i == 7 ? f(middle) : f(middle - half * node[i]) + f(middle + half * node[i]);
    k += kronrod_weight[i] * value;
    if (i % 2 == 1) g += gauss_weight[i / 2] * value;
  }
  if (depth == 0 || std::fabs(k - g) * half <= tolerance) return k * half;
  return kronrod(f, begin, middle, 0.5 * tolerance, depth - 1) + kronrod(f, middle, end, 0.5 * tolerance, depth - 1);
}

struct Setting {
  double along, aside, extinction, end;
};

/// The defining integral, int p(mu) I e^(-sigma (t + r)) / r^2 dt, cut where the integrand changes its scale.
double brute_force(const Law<double>& law, const Setting& s, const std::function<double(double)>& intensity,
                   std::vector<double> breaks = {}) {
  const LobeSum<double> lobes = lower(law);
  const double begin_path = s.along > 0.0 ? s.along : 0.0;
  const auto f = [&](double t) {
    const double d = t - s.along, r = std::hypot(d, s.aside);
    const double near = s.aside * s.aside / (r + std::fabs(d));  // r - |d|
    const double one_minus = (d < 0.0 ? near : r + d) / r, one_plus = (d < 0.0 ? r - d : near) / r;
    return density(lobes, Deflection<double>::from_ends(one_minus, one_plus)) * intensity(t) *
           std::exp(-s.extinction * (t + r - begin_path)) / (r * r);
  };
  breaks.insert(breaks.end(), {0.0, s.end});
  for (double step = 0.25 * s.aside; step < 4.0 * s.end; step *= 2.0) {
    breaks.push_back(s.along - step);
    breaks.push_back(s.along + step);
  }
  for (double step = 0.1 / s.extinction; step < s.end; step *= 2.0) {
    breaks.push_back(step);
    breaks.push_back(s.along + step);
  }
  std::erase_if(breaks, [&](double t) { return t < 0.0 || t > s.end; });
  std::sort(breaks.begin(), breaks.end());
  double rough = 0.0, sum = 0.0;
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) rough += kronrod(f, breaks[i], breaks[i + 1], infinity, 0);
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    sum += kronrod(f, breaks[i], breaks[i + 1], 1e-14 * rough, 40);
  }
  return sum * std::exp(-s.extinction * begin_path);
}

/// Decades of every ratio, lamps before, beside and behind the ray's origin.
std::vector<Setting> random_settings(int count, unsigned seed) {
  std::mt19937_64 random(seed);
  const auto between = [&](double low, double high) {
    return low + (high - low) * (static_cast<double>(random() >> 11) * 0x1p-53);
  };
  const auto decades = [&](double low, double high) { return std::pow(10.0, between(low, high)); };
  std::vector<Setting> out;
  for (int i = 0; i < count; ++i) {
    const double along = between(0.0, 1.0) < 0.75 ? decades(-1.0, 2.5) : -decades(-1.0, 1.5);
    const double aside = decades(-3.0, 1.5), extinction = decades(-3.0, 0.7), end = decades(-1.0, 3.0);
    // No darker than e^-50: smaller than that is nobody's picture, and nobody's quadrature.
    if (extinction * std::hypot(along, aside) > 50.0) {
      --i;
      continue;
    }
    out.push_back({along, aside, extinction, end});
  }
  return out;
}

struct Errors {
  std::vector<double> all;
  void add(double value, double truth) { all.push_back(std::fabs(value - truth) / truth); }
  double median() {
    std::sort(all.begin(), all.end());
    return all[all.size() / 2];
  }
  double worst() const { return *std::max_element(all.begin(), all.end()); }
};

constexpr int geometry_count = 362;

TEST(Airlight, OfPointLightsAgreesWithBruteForceFor362RandomGeometries) {
  for (const Law<double>& law :
       {Law<double>{Isotropic<double>{}}, Law<double>{Rayleigh<double>{}}, Law<double>{HenyeyGreenstein<double>{0.7}},
        Law<double>{HenyeyGreenstein<double>{-0.4}}, Law<double>{MieHazy<double>{}}, Law<double>{MieMurky<double>{}}}) {
    Errors errors;
    for (const Setting& s : random_settings(geometry_count, 1)) {
      const Spectrum value = airlight(lobes_of(law, Spectrum::grey(1.0)), Spectrum::grey(s.extinction),
                                      LampAside{s.along, s.aside}, Interval{0.0, s.end});
      errors.add(value[0], brute_force(law, s, [](double) { return 1.0; }));
      EXPECT_EQ(value[0], value[2]);
    }
    EXPECT_LE(errors.median(), 1e-11) << law.index();
    EXPECT_LE(errors.worst(), 1e-9) << law.index();
  }
}

/// The law of Henyey and Greenstein as a table of `count` angles in geometric progression, and a bow.
Tabulated<double> table_of(int count, double g) {
  Tabulated<double> out;
  for (int i = 0; i < count; ++i) {
    const double angle = i == 0 ? 0.0 : 0.02 * std::pow(9000.0, (i - 1.0) / (count - 2.0));
    const double bow = std::exp(-0.05 * (angle - 139.0) * (angle - 139.0));
    const auto d = Deflection<double>::from_angle(std::min(angle, 180.0) * std::numbers::pi / 180.0);
    out.angles.push_back(i == count - 1 ? 180.0 : angle);
    out.values.push_back(Spectrum::grey(density(Law<double>(HenyeyGreenstein<double>{g}), d) + 0.01 * bow));
  }
  return out;
}

/// Where a setting's ray meets the knots of a table: t = along - aside mu / sine.
std::vector<double> knots_along(const Setting& s, const Tabulated<double>& table) {
  std::vector<double> out;
  for (const double angle : table.angles) {
    const double radians = angle * std::numbers::pi / 180.0;
    if (angle > 0.0 && angle < 180.0) out.push_back(s.along - s.aside / std::tan(radians));
  }
  return out;
}

/// Panels end at a table's knots. Where they do not, a bow three degrees wide is smeared; the difference is what
/// TableKnotPanels states.
TEST(Airlight, OfTablesAgreesWithBruteForceForRandomGeometries) {
  for (const Tabulated<double>& table : {table_of(300, 0.8), table_of(12, 0.5)}) {
    Errors split, crossed;
    for (const Setting& s : random_settings(100, 11)) {
      const auto lobes = lobes_of(table, Spectrum::grey(1.0));
      const double truth = brute_force(
          table, s, [](double) { return 1.0; }, knots_along(s, table));
      const auto light = [&](TableKnotPanels knots) {
        return airlight(lobes, Spectrum::grey(s.extinction), LampAside{s.along, s.aside}, {0.0, s.end}, knots)[0];
      };
      split.add(light(TableKnotPanels::split), truth);
      crossed.add(light(TableKnotPanels::crossed), truth);
    }
    EXPECT_LE(split.median(), 1e-11) << table.angles.size();
    EXPECT_LE(split.worst(), 1e-9) << table.angles.size();
    EXPECT_LE(crossed.worst(), 1e-2) << table.angles.size();
  }
}

TEST(Airlight, OfSpotLightsAgreesWithBruteForceFor362RandomGeometries) {
  std::mt19937_64 random(7);
  const auto between = [&](double low, double high) {
    return low + (high - low) * (static_cast<double>(random() >> 11) * 0x1p-53);
  };
  Errors errors;
  const Ray ray{{0, 0, 0}, {1, 0, 0}};
  int lit_count = 0;
  for (const Setting& s : random_settings(geometry_count, 2)) {
    // Aimed near a point of the ray, so that most cones meet it; half of them with a soft edge.
    const double azimuth = between(0.0, 6.28);
    SpotLight spot;
    spot.position = {s.along, s.aside * std::cos(azimuth), s.aside * std::sin(azimuth)};
    const double aim = s.along + s.aside * between(-2.0, 2.0);
    spot.direction = Vector{aim, 0, 0} - spot.position + Vector{0, between(-0.3, 0.3), between(-0.3, 0.3)} * s.aside;
    spot.outer_angle = between(2.0, 80.0);
    spot.inner_angle = between(0.0, 1.0) < 0.5 ? spot.outer_angle : spot.outer_angle * between(0.0, 0.95);
    const Law<double> law = HenyeyGreenstein<double>{0.7};
    const Interval lit{0.0, s.end};
    const double value = airlight(lobes_of(law, Spectrum::grey(1.0)), Spectrum::grey(s.extinction), ray, spot, lit)[0];
    // Its own search for the edges: bisection of the falloff between dense points of the ray.
    const Vector axis = normalized(spot.direction);
    const auto cosine = [&](double t) { return dot(normalized(ray.at(t) - spot.position), axis); };
    std::vector<double> breaks;
    for (const double angle : {spot.inner_angle, spot.outer_angle}) {
      const double edge = std::cos(angle * std::numbers::pi / 180.0);
      double before = 0.0;
      for (int i = 1; i <= 4000; ++i) {
        const double theta0 = std::atan2(-s.along, s.aside), theta1 = std::atan2(s.end - s.along, s.aside);
        const double t = i == 4000 ? s.end : s.along + s.aside * std::tan(theta0 + (theta1 - theta0) * i / 4000.0);
        if ((cosine(before) > edge) != (cosine(t) > edge)) {
          double low = before, high = t;
          for (int k = 0; k < 100; ++k) {
            const double middle = 0.5 * (low + high);
            ((cosine(middle) > edge) == (cosine(low) > edge) ? low : high) = middle;
          }
          breaks.push_back(low);
        }
        before = t;
      }
    }
    const double truth = brute_force(
        law, s, [&](double t) { return spot_falloff(spot, cosine(t)); }, breaks);
    if (truth == 0.0) {
      EXPECT_LT(value, 1e-12);
      continue;
    }
    ++lit_count;
    errors.add(value, truth);
  }
  EXPECT_GT(lit_count, 150);
  EXPECT_LE(errors.median(), 1e-11);
  EXPECT_LE(errors.worst(), 1e-9);
}

TEST(Airlight, ClosedFormAndPanelsAgreeWhereBothHold) {
  int closed_count = 0;
  for (const Law<double>& law : {Law<double>{Isotropic<double>{}}, Law<double>{Rayleigh<double>{0.04}},
                                 Law<double>{MieHazy<double>{}}, Law<double>{MieMurky<double>{}}}) {
    for (const Setting& s : random_settings(2000, 3)) {
      const auto lobes = lobes_of(law, {{1.0, 0.5, 2.0}});
      const Spectrum extinction{{s.extinction, 2.0 * s.extinction, 0.1 * s.extinction}};
      const AirlightStretch stretch = AirlightStretch::of({s.along, s.aside}, {0.0, s.end});
      const auto closed = airlight_in_closed_form(lobes, extinction, stretch);
      if (!closed) continue;
      ++closed_count;
      const Spectrum panels = airlight_by_panels(lobes, extinction, stretch);
      for (std::size_t c = 0; c < channel_count; ++c) {
        EXPECT_NEAR((*closed)[c] / panels[c], 1.0, 1e-10) << s.along << " " << s.aside << " " << s.extinction;
      }
    }
  }
  EXPECT_GT(closed_count, 2000);
}

TEST(Airlight, ALossOfDigitsIsNoticed) {
  const auto lobes = lobes_of(MieMurky<double>{}, Spectrum::grey(1.0));
  const auto closed = [&](const LampAside& lamp, const Interval& lit, double extinction) {
    return airlight_in_closed_form(lobes, Spectrum::grey(extinction), AirlightStretch::of(lamp, lit));
  };
  EXPECT_TRUE(closed({2.0, 1.0}, {0.0, 8.0}, 0.1).has_value());
  EXPECT_FALSE(closed({2.0, 1.0}, {3.0, 3.0 + 1e-9}, 0.1).has_value()) << "a short stretch";
  EXPECT_FALSE(closed({2.0, 1.0}, {0.0, 8.0}, 40.0).has_value()) << "a dark one";
  const auto even = lobes_of(Isotropic<double>{}, Spectrum::grey(1.0));
  const AirlightStretch behind = AirlightStretch::of({-100.0, 1.0}, {0.0, 8.0});
  EXPECT_TRUE(airlight_in_closed_form(even, Spectrum::grey(8.0), behind)) << "e^(-sigma a) alone would overflow";
  // And what takes over is right: a short stretch is the integrand times its length.
  const double length = 1e-9, r = std::hypot(1.0, 1.0), mu = -1.0 / r;
  const double truth = density(Law<double>{MieMurky<double>{}}, Deflection<double>::from_mu(mu)) *
                       std::exp(-0.1 * (3.0 + r)) / (r * r) * (3.0 + length - 3.0);
  EXPECT_NEAR(airlight(lobes, Spectrum::grey(0.1), LampAside{2.0, 1.0}, {3.0, 3.0 + length})[0] / truth, 1.0, 1e-8);
}

TEST(Airlight, PiecesAddUpToTheWhole) {
  for (const Law<double>& law : {Law<double>{HenyeyGreenstein<double>{0.9}}, Law<double>{MieMurky<double>{}}}) {
    const auto lobes = lobes_of(law, {{1.0, 2.0, 3.0}});
    const Spectrum extinction{{0.1, 1.0, 3.0}};
    const LampAside lamp{4.0, 0.3};
    const Spectrum whole = airlight(lobes, extinction, lamp, {0.5, 30.0});
    Spectrum sum;
    double begin = 0.5;
    for (const double end : {1.0, 3.9, 4.0, 4.2, 4.2000001, 17.0, 30.0}) {
      sum += airlight(lobes, extinction, lamp, {begin, end});
      begin = end;
    }
    for (std::size_t c = 0; c < channel_count; ++c) EXPECT_NEAR(sum[c] / whole[c], 1.0, 1e-11);
  }
}

TEST(Airlight, ALampOnTheRayDivergesOnlyWhereItStands) {
  for (const Law<double>& law : {Law<double>{Isotropic<double>{}}, Law<double>{HenyeyGreenstein<double>{0.7}}}) {
    const auto lobes = lobes_of(law, {{1.0, 0.0, 2.0}});
    const Spectrum extinction{{1.0, 0.5, 2.0}};
    const LampAside lamp{3.0, 0.0};
    const Spectrum through = airlight(lobes, extinction, lamp, {0.0, 5.0});
    EXPECT_TRUE(std::isinf(through[0]) && through[1] == 0.0 && std::isinf(through[2]));
    // Before it all light is undeflected: int_0^2 e^(-(t + 3 - t)) / (3 - t)^2 dt = e^-3 (1 - 1/3).
    const double forward = density(law, Deflection<double>::from_mu(1.0));
    EXPECT_NEAR(airlight(lobes, extinction, lamp, {0.0, 2.0})[0] / (forward * std::exp(-3.0) * (1.0 - 1.0 / 3.0)), 1.0,
                1e-12);
    // The limit: 1/h, with the same constant from 1e-6 to 1e-12.
    const double coarse = airlight(lobes, extinction, {3.0, 1e-6}, {0.0, 5.0})[0] * 1e-6;
    const double fine = airlight(lobes, extinction, {3.0, 1e-12}, {0.0, 5.0})[0] * 1e-12;
    EXPECT_NEAR(coarse / fine, 1.0, 1e-4);
  }
  const auto lobes = lobes_of(Isotropic<double>{}, Spectrum::grey(1.0));
  EXPECT_TRUE(std::isinf(airlight(lobes, Spectrum::grey(1.0), LampAside{0.0, 0.0}, {0.0, 1.0})[0]));
}

TEST(Airlight, IsFiniteAndNotNegativeAtTheEndsOfItsRanges) {
  for (const Law<double>& law : {Law<double>{Isotropic<double>{}}, Law<double>{HenyeyGreenstein<double>{0.9999}},
                                 Law<double>{HenyeyGreenstein<double>{-0.9999}}, Law<double>{MieMurky<double>{}}}) {
    const auto lobes = lobes_of(law, Spectrum::grey(1.0));
    for (const double along : {-1e6, -1.0, 0.0, 1e-12, 1.0, 1e6}) {
      for (const double aside : {1e-300, 1e-12, 1.0, 1e6}) {
        for (const double extinction : {0.0, 1e-300, 1e-12, 1.0, 1e6}) {
          for (const double end : {0.0, 1e-12, 1.0, 1e6, infinity}) {
            const Spectrum value =
                airlight(lobes, Spectrum::grey(extinction), LampAside{along, aside}, Interval{0.0, end});
            EXPECT_TRUE(is_finite(value) && value[0] >= 0.0)
                << along << " " << aside << " " << extinction << " " << end << ": " << value[0];
          }
        }
      }
    }
  }
}

TEST(Airlight, WithoutExtinctionIsTheAngleUnderWhichTheStretchIsSeen) {
  // Isotropic, sigma = 0: int dt / r^2 / (4 pi) = (angle) / (4 pi h), to infinity.
  const auto lobes = lobes_of(Isotropic<double>{}, Spectrum::grey(1.0));
  const double value = airlight(lobes, Spectrum::grey(0.0), LampAside{3.0, 2.0}, {0.0, infinity})[0];
  const double angle = 0.5 * std::numbers::pi + std::atan2(3.0, 2.0);
  EXPECT_NEAR(value / (angle / (4.0 * std::numbers::pi * 2.0)), 1.0, 1e-13);
}

TEST(ConeStretch, IsEmptyFiniteOrHalfInfiniteAsGeometrySays) {
  const Ray ray{{0, 0, 0}, {1, 0, 0}};
  const LampView lamp = LampView::of(ray, {5, 2, 0});
  const Interval down = cone_stretch(lamp, {0, -1, 0}, 15.0);
  EXPECT_NEAR(down.begin, 5.0 - 2.0 * std::tan(std::numbers::pi / 12.0), 1e-14);
  EXPECT_NEAR(down.end, 5.0 + 2.0 * std::tan(std::numbers::pi / 12.0), 1e-14);
  EXPECT_TRUE(cone_stretch(lamp, {0, 1, 0}, 89.0).empty());
  EXPECT_TRUE(cone_stretch(lamp, {0, 0, 1}, 40.0).empty());
  const Interval ahead = cone_stretch(lamp, {1, 0, 0}, 45.0);
  EXPECT_NEAR(ahead.begin, 7.0, 1e-14);
  EXPECT_EQ(ahead.end, infinity);
  const Interval back = cone_stretch(lamp, {-1, 0, 0}, 45.0);
  EXPECT_NEAR(back.end, 3.0, 1e-14);
  EXPECT_EQ(back.begin, -infinity);
  EXPECT_EQ(cone_stretch(lamp, {0, -1, 0}, 90.0).begin, -infinity);
  EXPECT_NEAR(cone_stretch(lamp, normalized({1, -1, 0}), 90.0).begin, 3.0, 1e-14);
  // A lamp on the ray, shining along it: lit from the lamp on.
  const Interval along = cone_stretch(LampView::of(ray, {5, 0, 0}), {1, 0, 0}, 10.0);
  EXPECT_EQ(along.begin, 5.0);
  EXPECT_EQ(along.end, infinity);
}

TEST(AdaptivePanels, ReachTheirToleranceAcrossKinksAndRoots) {
  const double breaks[] = {0.0, 1.0, 4.0};
  int calls = 0;
  const Spectrum value = integrate_adaptively(breaks, 2.0, 1e-10, [&](double x) {
    ++calls;
    return Spectrum{{std::fabs(x - std::numbers::sqrt2), std::sqrt(std::fabs(x - 2.3)), std::exp(-x)}};
  });
  const double kink = 0.5 * (2.0 + std::pow(4.0 - std::numbers::sqrt2, 2));
  const double root = (std::pow(2.3, 1.5) + std::pow(1.7, 1.5)) * 2.0 / 3.0;
  EXPECT_NEAR(value[0] / kink, 1.0, 1e-9);
  EXPECT_NEAR(value[1] / root, 1.0, 1e-9);
  EXPECT_NEAR(value[2] / (1.0 - std::exp(-4.0)), 1.0, 1e-13);
  EXPECT_LT(calls, 10000);
}

}  // namespace
}  // namespace tyndall
