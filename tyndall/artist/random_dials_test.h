#pragma once
// Random media for property tests: everything the dials allow, over the ranges that people use and a little beyond.
#include <cmath>
#include <random>
#include <string>

#include "tyndall/artist/medium_dials.h"

namespace tyndall::tests {

class Dice {
 public:
  explicit Dice(std::uint64_t seed) : engine_(seed) {}
  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  /// Spread evenly over magnitudes.
  double magnitude(double low, double high) { return std::exp(between(std::log(low), std::log(high))); }
  bool coin(double heads = 0.5) { return between(0.0, 1.0) < heads; }
  int below(int n) { return std::uniform_int_distribution<int>(0, n - 1)(engine_); }

  Spectrum spectrum(double low, double high) {
    if (coin()) return Spectrum::grey(magnitude(low, high));
    return {{magnitude(low, high), magnitude(low, high), magnitude(low, high)}};
  }
  Spectrum albedo() {
    if (coin(0.3)) return Spectrum::grey(1.0);
    return {{between(0.0, 1.0), between(0.0, 1.0), between(0.0, 1.0)}};
  }

  /// Extinction between `low` and `high` [1/m], in any form.
  Density density(double low, double high) {
    switch (below(4)) {
      case 0:
        return PlainExtinction{spectrum(low, high)};
      case 1:
        return StatedExtinction{spectrum(low, high)};
      case 2:
        return MeanFreePath{spectrum(1.0 / high, 1.0 / low)};
      default:
        return Visibility{spectrum(3.0 / high, 3.0 / low), coin() ? 0.05 : between(0.01, 0.1)};
    }
  }
  /// A profile that covers the origin.
  std::optional<Profile> profile() {
    switch (below(6)) {
      case 0:
        return ConstantProfile{};
      case 1:
        return ExponentialProfile{magnitude(1.0, 1e4), 0.0};
      case 2:
        return ExponentialProfile{magnitude(100.0, 1e4), between(-50.0, 50.0)};
      case 3:
        return BoxProfile{{-between(1, 9), -between(1, 9), -between(1, 9)}, {between(1, 9), between(1, 9), 5.0}};
      case 4:
        return SphereProfile{{between(-1.0, 1.0), between(-1.0, 1.0), 0.0}, magnitude(2.0, 100.0)};
      default:
        return std::nullopt;
    }
  }
  Law<double> law(int depth = 0) {
    switch (below(depth < 2 ? 6 : 5)) {
      case 0:
        return Isotropic<double>{};
      case 1:
        return Rayleigh<double>{between(0.0, 0.5)};
      case 2:
        return HenyeyGreenstein<double>{between(-0.99, 0.99)};
      case 3:
        return MieHazy<double>{};
      case 4:
        return MieMurky<double>{};
      default: {
        Mixture<double> mixture;
        const int parts = 1 + below(3);
        for (int i = 0; i < parts; ++i) mixture.parts.push_back({magnitude(0.1, 10.0), law(depth + 1)});
        return mixture;
      }
    }
  }
  std::optional<Veil> veil() {
    if (coin()) return std::nullopt;
    return Veil{density(1e-7, 1e-3), albedo()};
  }
  std::optional<Background> background() {
    if (coin(0.3)) return std::nullopt;
    return Background{coin(0.8) ? Air::note : Air::none, coin() ? 1.0 : between(0.0, 5.0),
                      coin() ? std::nullopt : profile()};
  }
  StatedSpecies species(const std::string& name) {
    StatedSpecies s;
    s.name = name;
    if (coin()) {
      if (coin(0.8)) s.scattering = spectrum(1e-7, 1e-3);
      if (!s.scattering || coin()) s.absorption = spectrum(1e-7, 1e-3);
    } else {
      s.density = density(1e-7, 1e-3);
      if (coin()) s.albedo = albedo();
    }
    s.phase = law();
    s.profile = profile();
    return s;
  }
  Simple simple() {
    return {
        coin(0.2) ? 0.5 * below(3) : between(0.0, 1.0), density(1e-4, 1.0), albedo(), veil(), profile(), std::nullopt};
  }
  TwoLobes two_lobes() {
    return {between(0.0, 1.0), between(-0.99, 0.99), between(-0.99, 0.99), density(1e-4, 1.0), albedo(), veil(),
            profile()};
  }
  std::optional<Conditions> conditions() {
    switch (below(3)) {
      case 0:
        return simple();
      case 1:
        return two_lobes();
      default:
        return std::nullopt;
    }
  }
  MediumDials medium() {
    MediumDials dials{background(), conditions(), {}};
    for (int i = below(3); i > 0; --i) dials.species.push_back(species(coin() ? "soot" : "dust"));
    return dials;
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace tyndall::tests
