#pragma once
// Every law with its hard parameters, made from the list of laws and their field descriptions: a new law is tested
// without a line here.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <type_traits>
#include <vector>

#include "tyndall/phase/law.h"

namespace tyndall {

/// Values of a parameter that have broken somebody's code: both ends of the range or next to them, almost 0, ordinary
/// ones. All are floats, so that float tests and double references speak of the same law.
inline std::vector<double> hard_values(const Range& range) {
  std::vector<double> values;
  const auto add = [&](double x) {
    const double rounded = static_cast<double>(static_cast<float>(x));
    if (range.contains(rounded) && std::find(values.begin(), values.end(), rounded) == values.end())
      values.push_back(rounded);
  };
  if (std::isfinite(range.low) && std::isfinite(range.high)) {
    add(range.low);
    for (const double part : {5e-5, 0.005, 0.15, 0.25, 0.5, 0.6, 0.75, 0.85, 0.995, 0.99995})
      add(range.low + part * (range.high - range.low));
    add(range.high);
  } else {
    for (const double x : {1e-3, 0.5, 1.0, 30.0, 1e3}) add(x);
  }
  for (const double x : {1e-6, -1e-6}) add(x);
  return values;
}

/// A law of numeric parameters: its default, and each hard value of each parameter in turn.
template <template <class> class L>
std::vector<L<double>> cases_of(std::type_identity<L<double>>) {
  std::vector<L<double>> cases{L<double>{}};
  for_each_field<L<double>>([&](const auto& field) {
    for (const double x : hard_values(field.range)) {
      L<double> law;
      law.*(field.member) = x;
      cases.push_back(law);
    }
  });
  return cases;
}

/// Mixtures of two to four: alike and far apart lobes, peaks both ways over a faint background, each law with
/// Henyey-Greenstein, mixtures of mixtures, a part of no weight.
inline std::vector<Mixture<double>> cases_of(std::type_identity<Mixture<double>>) {
  const auto share = [](double weight) { return static_cast<double>(static_cast<float>(weight)); };
  const auto lobe = [&](double weight, double g) {
    return MixturePart<double>{share(weight), HenyeyGreenstein<double>{share(g)}};
  };
  std::vector<Mixture<double>> cases{
      {{lobe(1.0, 0.5)}},
      {{lobe(1.0, 0.3), lobe(2.0, 0.31)}},
      {{lobe(1.0, 0.8), lobe(0.25, -0.4)}},
      {{lobe(1.0, 0.99), lobe(1.0, -0.99)}},
      {{lobe(0.3, 0.9999), lobe(0.2, -0.9999), {share(1e-3), Isotropic<double>{}}}},
      {{lobe(0.0, 0.9999), lobe(1.0, 1e-6)}},
      {{lobe(1.0, 0.95), lobe(1.0, 0.5), lobe(1.0, -0.2), lobe(1.0, 0.9999)}},
  };
  const auto beside = [&]<class L>(std::type_identity<L>) {
    if constexpr (!std::is_same_v<L, Mixture<double>>) cases.push_back({{{1.0, L{}}, lobe(0.5, 0.7)}});
  };
  [&]<class... Each>(std::type_identity<std::variant<Each...>>) {
    (beside(std::type_identity<Each>{}), ...);
  }(std::type_identity<Law<double>>{});
  const Mixture<double> haze{{{share(0.7), MieHazy<double>{}}, {share(0.3), MieMurky<double>{}}}};
  cases.push_back(haze);
  cases.push_back({{{2.0, haze}, lobe(1.0, 0.9), {share(0.1), Rayleigh<double>{share(0.03)}}}});
  cases.push_back({{{1.0, cases[3]}, {1.0, haze}, {1.0, Mixture<double>{{{1.0, haze}, lobe(1.0, -0.7)}}}}});
  return cases;
}

/// Tables: the least there can be, a peak as narrow as any with knots that follow it, both ways round, ends left out,
/// bows and dips of clouds, as many knots as shaders keep. (Gaps without scattering: phase/tabulated_test.cc.)
inline std::vector<Tabulated<double>> cases_of(std::type_identity<Tabulated<double>>) {
  const auto table = [](std::vector<double> angles, const std::vector<double>& values) {
    Tabulated<double> out{std::move(angles), {}, {}};
    for (const double x : values) out.values.push_back(Spectrum::grey(x));
    return out;
  };
  // Henyey and Greenstein's law at angles in geometric progression from the peak.
  const auto peak = [&](double g, int count, double smallest, bool backward) {
    std::vector<double> angles, values;
    for (int i = 0; i <= count; ++i) {
      const double angle = i == 0 ? 0.0 : smallest * std::pow(180.0 / smallest, (i - 1.0) / (count - 1.0));
      const double sine = std::sin(angle * (std::acos(-1.0) / 360.0)), distance = (1.0 - g) * (1.0 - g) / (4.0 * g);
      angles.push_back(i == count ? 180.0 : angle);
      values.push_back(std::pow(distance + sine * sine, -1.5));
    }
    if (backward) {
      std::reverse(angles.begin(), angles.end());
      std::reverse(values.begin(), values.end());
      for (double& angle : angles) angle = 180.0 - angle;
    }
    return table(angles, values);
  };
  return {Tabulated<double>{},
          table({0.0, 180.0}, {3.0, 1.0}),
          table({0.0, 180.0}, {1.0, 0.0}),
          table({0.0, 90.0, 180.0}, {0.0, 7.0, 0.5}),
          table({21.0, 102.0}, {2.0, 1.0}),
          table({0.0, 2.2, 11.0, 31.0, 62.0, 90.0, 101.0, 128.0, 142.0, 155.0, 177.0, 180.0},
                {4e4, 1500.0, 90.0, 20.0, 3.0, 0.7, 0.55, 0.8, 2.6, 1.1, 1.3, 3.9}),
          peak(0.9, 40, 0.5, false),
          peak(0.9, 40, 0.5, true),
          peak(0.9999, 200, 1e-4, false),
          peak(0.98, 511, 1e-3, false)};
}

template <class L>
std::vector<Law<double>> law_cases() {
  const auto cases = cases_of(std::type_identity<L>{});
  return {cases.begin(), cases.end()};
}

/// The law and its parameters in words, for messages.
inline std::string words(const Law<double>& law) {
  return std::visit(
      [](const auto& l) {
        std::string out(l.name);
        for_each_field<std::decay_t<decltype(l)>>([&](const auto& field) {
          if constexpr (requires { std::to_string(l.*(field.member)); }) {
            char text[40];
            std::snprintf(text, sizeof text, ":%s=%.7g", std::string(field.name).c_str(), l.*(field.member));
            out += text;
          } else if constexpr (requires { l.knots(0); }) {
            if (field.name == "angles") out += " of " + std::to_string(l.size()) + " knots";
          } else {
            for (const auto& part : l.*(field.member))
              out += (out.back() == ' ' || out == l.name ? " " : " + ") + std::to_string(part.weight) + " " +
                     words(part.phase);
          }
        });
        return out;
      },
      law);
}

/// How far float may be from double, relatively: a millionth, but for Fournier and Forand's law, which takes powers of
/// numbers over 18 decades.
inline double float_error(const Law<double>& law) {
  if (std::holds_alternative<FournierForand<double>>(law)) return 1e-5;
  double worst = 1e-6;
  if (const auto* mixture = std::get_if<Mixture<double>>(&law)) {
    for (const auto& part : mixture->parts) worst = std::max(worst, float_error(part.phase));
  }
  return worst;
}

/// Deflections from straight on to straight back, the peaks resolved.
inline std::vector<Deflection<double>> test_deflections() {
  std::vector<Deflection<double>> out{Deflection<double>::from_ends(0.0, 2.0), Deflection<double>::from_ends(2.0, 0.0)};
  const double half_turn = std::acos(-1.0);
  for (const double small : {1e-4, 3e-4, 1e-3, 0.01, 0.03}) {
    out.push_back(Deflection<double>::from_angle(small));
    const auto forward = Deflection<double>::from_angle(small);
    out.push_back(Deflection<double>::from_ends(forward.one_plus, forward.one_minus));
  }
  for (int i = 1; i < 40; ++i) out.push_back(Deflection<double>::from_angle(half_turn * i / 40.0));
  return out;
}

/// Numbers of [0, 1], all of them floats: both ends, next to them, between.
inline std::vector<double> test_xi() {
  std::vector<double> out{0.0, 1e-9, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1.0};
  for (int i = 1; i < 64; ++i) out.push_back(i / 64.0);
  for (const double y : {0x1p-24, 0x1p-20, 0x1p-17, 0x1p-13, 0x1p-10}) out.push_back(1.0 - y);
  for (double& xi : out) xi = static_cast<double>(static_cast<float>(xi));
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace tyndall
