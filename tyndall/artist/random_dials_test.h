#pragma once
// Random media for property tests: everything the dials allow, over the ranges that people use and a little beyond.
#include <algorithm>
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
    const double far = magnitude(1.0, 1e3);
    switch (below(7)) {
      case 0:
        return PlainExtinction{spectrum(low, high)};
      case 3:
        return Transmittance{exp(-far * spectrum(low, std::min(high, 600.0 / far))), far};
      case 4:
        return OpticalDepth{far * spectrum(low, high), far};
      case 5: {
        const double grams = magnitude(1e-6, 1.0);
        return MassExtinction{Spectrum::grey(grams), spectrum(low, high) / grams};
      }
      case 1:
        return StatedExtinction{spectrum(low, high)};
      case 2:
        return MeanFreePath{spectrum(1.0 / high, 1.0 / low)};
      default:
        return Visibility{spectrum(3.0 / high, 3.0 / low), coin() ? 0.05 : between(0.01, 0.1)};
    }
  }
  /// A profile that covers the origin, or a product of such.
  std::optional<Profiles> profile() {
    auto out = one_profile();
    for (int more = out && coin(0.2) ? 1 + below(2) : 0; more > 0; --more) {
      if (const auto another = one_profile()) out->all.push_back(another->all.front());
    }
    return out;
  }
  std::optional<Profiles> one_profile() {
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
  /// Knots anywhere, grey or per channel.
  Tabulated<double> table() {
    Tabulated<double> out;
    const bool grey = coin();
    for (double angle = between(0.0, 20.0); angle < 180.0; angle += magnitude(1.0, 60.0)) {
      out.angles.push_back(angle);
      out.values.push_back(grey ? Spectrum::grey(magnitude(0.01, 10.0)) : spectrum(0.01, 10.0));
    }
    out.angles.push_back(180.0);
    out.values.push_back(Spectrum::grey(coin() ? 0.0 : 1.0));
    return out;
  }
  Law<double> law(int depth = 0) {
    switch (below(depth < 2 ? 7 : 6)) {
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
      case 5:
        return table();
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
    Background air;
    air.air = coin(0.4) ? Air::note : coin(0.6) ? Air::standard : Air::none;
    air.exaggeration = coin() ? 1.0 : between(0.0, 5.0);
    if (coin()) air.profile = profile();
    if (coin(0.3)) air.altitude = between(-400.0, 8000.0);
    if (coin(0.3)) air.ozone = between(100.0, 500.0);
    return air;
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
  TwoLobesExplicit two_lobes_explicit() {
    return {{between(-0.99, 0.99), density(1e-4, 1.0), albedo()},
            {between(-0.99, 0.99), density(1e-4, 1.0), albedo()},
            veil(),
            profile()};
  }
  Measured measured() {
    Measured m;
    m.air = static_cast<Particles>(below(8));
    switch (is_water(m.air) ? below(4) : below(3)) {
      case 0:
        m.visibility = magnitude(1.0, 1e5);
        m.contrast = coin() ? 0.05 : 0.02;
        break;
      case 1:
        m.extinction = magnitude(1e-5, 1.0);
        break;
      case 2:
        m.turbidity = between(1.0, 10.0);
        break;
      default:
        m.liquid_water_content = magnitude(1e-3, 1.0);
    }
    if (is_water(m.air) && coin()) {
      m.droplet_diameter = m.air == Particles::fog ? magnitude(1.5, 50.0) : magnitude(100.0, 1e4);
    }
    if (coin(0.3)) m.albedo = albedo();
    if (coin(0.3)) m.angstrom_exponent = between(-0.2, 2.0);
    if (coin(0.3)) m.mean_cosine = between(-0.5, 0.95);
    m.profile = profile();
    return m;
  }
  std::optional<Conditions> conditions() {
    switch (below(5)) {
      case 0:
        return simple();
      case 1:
        return two_lobes();
      case 2:
        return two_lobes_explicit();
      case 3:
        return measured();
      default:
        return std::nullopt;
    }
  }
  /// Where a measured visibility is beyond what else is in the medium leaves, takes half of that.
  static void make_possible(MediumDials& dials) {
    auto* m = dials.conditions ? std::get_if<Measured>(&*dials.conditions) : nullptr;
    if (m == nullptr || !m->visibility) return;
    MediumDials rest = dials;
    rest.conditions.reset();
    const auto others = std::get<Medium>(compile(rest));
    const double extinction =
        at_wavelength(surroundings_of(rest, others).extinction, wavelengths_of(dials.channels), 550.0);
    if (extinction > 0.0) m->visibility = std::min(*m->visibility, 0.5 * -std::log(m->contrast) / extinction);
  }
  MediumDials medium() {
    MediumDials dials{background(), conditions(), {}, {}};
    for (int i = below(3); i > 0; --i) dials.species.push_back(species(coin() ? "soot" : "dust"));
    make_possible(dials);
    return dials;
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace tyndall::tests
