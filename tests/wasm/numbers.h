#pragma once
// What floors 0 to 4 compute, as one long list of numbers: the same text is run here and in WebAssembly.
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "tyndall/artist/medium_dials.h"
#include "tyndall/artist/mix.h"
#include "tyndall/artist/morph.h"
#include "tyndall/medium/free_flight.h"
#include "tyndall/medium/scatter.h"
#include "tyndall/phase/law_as.h"
#include "tyndall/phase/law_cases_test.h"
#include "tyndall/sampling/random_stream.h"

namespace tyndall {

/// Numbers of one kind: "rayleigh double", "transmittance", ...
struct NumberGroup {
  std::string name;
  std::vector<double> values;
};

/// Deflections from straight on to straight back, made without a library function: they are the same everywhere.
inline std::vector<Deflection<double>> exact_deflections() {
  std::vector<Deflection<double>> out;
  for (const double v : {0.0, 0x1p-30, 0x1p-20, 0x1p-12, 0x1p-7}) {
    out.push_back(Deflection<double>::from_ends(2.0 * v, 2.0 - 2.0 * v));
    out.push_back(Deflection<double>::from_ends(2.0 - 2.0 * v, 2.0 * v));
  }
  for (int i = 1; i < 32; ++i) out.push_back(Deflection<double>::from_ends(i / 16.0, 2.0 - i / 16.0));
  return out;
}

/// Everything a law offers, for each of its hard cases.
template <class T, class L>
NumberGroup numbers_of_law(const std::string& number) {
  NumberGroup group{std::string(L::name) + ' ' + number, {}};
  const auto add = [&](const T& x) { group.values.push_back(static_cast<double>(x)); };
  for (const Law<double>& described : law_cases<L>()) {
    const Law<T> law = law_as<T>(described);
    const LobeSum<T> lobes = lower(law);
    for (const Deflection<double>& d : exact_deflections()) {
      const Deflection<T> at{static_cast<T>(d.mu), static_cast<T>(d.one_minus), static_cast<T>(d.one_plus)};
      add(density(lobes, at));
      add(cdf(lobes, at));
      add(survival(lobes, at));
    }
    for (const double xi : test_xi()) {
      const Deflection<T> d = sample(law, static_cast<T>(xi));
      add(d.one_minus);
      add(d.one_plus);
    }
    for (int l = 0; l <= 8; ++l) add(moment(lobes, l));
  }
  return group;
}

/// One medium of each artist model, in air that thins with height.
inline std::vector<MediumDials> dials_of_every_model() {
  Background air;
  air.air = Air::standard;
  air.profile = ExponentialProfile{8000.0, 0.0};
  air.ozone = 300.0;
  Simple simple;
  simple.w = 0.7;
  simple.thickness = Visibility{Spectrum::grey(600.0), 0.05};
  simple.veil = Veil{PlainExtinction{Spectrum::grey(1e-4)}, {{0.95, 0.92, 0.88}}};
  simple.profile = ExponentialProfile{30.0, 0.0};
  simple.hold = Hold::visibility;
  TwoLobes lobes;
  lobes.r = 0.8, lobes.g1 = -0.3, lobes.g2 = 0.9;
  lobes.thickness = PlainExtinction{{{2e-3, 3e-3, 4e-3}}};
  lobes.profile = TentProfile{10.0, 50.0};
  TwoLobesExplicit explicit_lobes;
  explicit_lobes.first = {0.1, MeanFreePath{Spectrum::grey(300.0)}, Spectrum::grey(0.9)};
  explicit_lobes.second = {0.85, PlainExtinction{{{1e-3, 2e-3, 3e-3}}}};
  explicit_lobes.profile = SphereProfile{{100.0, 0.0, 10.0}, 90.0, 40.0};
  Measured measured;
  measured.air = Particles::fog;
  measured.visibility = 400.0;
  measured.droplet_diameter = 8.0;
  measured.profile = NoiseProfile{25.0, 3, 0.6, 7, {2.0, 0.0, 0.0}};
  StatedSpecies soot;
  soot.name = "soot";
  soot.scattering = Spectrum::grey(2e-5);
  soot.absorption = Spectrum::grey(5e-5);
  soot.phase = HenyeyGreenstein<double>{0.47};
  soot.profile = BoxProfile{{-50.0, -5.0, -50.0}, {60.0, 40.0, 50.0}, 8.0};
  std::vector<MediumDials> all;
  for (const Conditions& model :
       {Conditions{simple}, Conditions{lobes}, Conditions{explicit_lobes}, Conditions{measured}}) {
    all.push_back({air, model, {soot}});
  }
  return all;
}

inline void add(const Spectrum& x, std::vector<double>& out) { out.insert(out.end(), x.value.begin(), x.value.end()); }

/// The coefficients that dials compile to, alone and blended in each way.
inline NumberGroup numbers_of_dials() {
  NumberGroup group{"coefficients", {}};
  const auto add_medium = [&](const MediumDials& dials) {
    const auto compiled = compile(dials);
    const Medium* medium = std::get_if<Medium>(&compiled);
    group.values.push_back(medium != nullptr ? static_cast<double>(medium->species.size()) : -1.0);
    if (medium == nullptr) return;
    for (const Species& s : medium->species) {
      add(s.scattering, group.values);
      add(s.absorption, group.values);
      group.values.push_back(mean_cosine(s.phase));
    }
  };
  const std::vector<MediumDials> all = dials_of_every_model();
  for (const MediumDials& dials : all) add_medium(dials);
  MediumDials murkier = all[0];
  std::get<Simple>(*murkier.conditions).w = 1.0;
  for (const Blend& blend : {interpolate(all[0], murkier, 0.3), mix(all[0], all[1], 0.3), morph(all[0], all[1], 0.3)}) {
    const MediumDials* dials = std::get_if<MediumDials>(&blend);
    if (dials != nullptr) add_medium(*dials);
    group.values.push_back(dials != nullptr);
  }
  return group;
}

/// Rays through each medium: what comes through, where light collides, how it turns there.
inline std::vector<NumberGroup> numbers_of_rays() {
  NumberGroup transmittances{"transmittances", {}}, flights{"flights", {}}, scattering{"scattering", {}};
  std::uint32_t sample_number = 0;
  for (const MediumDials& dials : dials_of_every_model()) {
    const auto compiled = compile(dials);
    const LoweredMedium lowered = lower(std::get<Medium>(compiled), 3.0);
    std::vector<Stretch> stretches;
    ScatterPoint point;
    for (const Vector& direction : {Vector{1, 0, 0}, Vector{1, 0.2, 0.1}, Vector{1, -0.01, 0}, Vector{0.1, 1, 0.1}}) {
      const Ray ray{{0.0, 2.0, 0.0}, normalized(direction)};
      stretches_along(lowered, ray, 1000.0, stretches);
      for (const double t : {1.0, 30.0, 77.0, 200.0, 1000.0}) add(transmittance(stretches, t), transmittances.values);
      for (int i = 0; i < 20; ++i) {
        RandomStream random(1, 0, sample_number++);
        const double xi_channel = random.next();
        const Flight flight =
            sample_flight(stretches, {{0.5, 0.3, 0.2}}, 1000.0, i % 2 == 0, xi_channel, random.next());
        flights.values.push_back(flight.t);
        add(flight.weight, flights.values);
        if (!(flight.t < infinity)) continue;
        point.set(lowered, stretches, flight.t);
        add(point.scattering(), scattering.values);
        if (is_zero(point.scattering())) continue;
        point.aim(flight.weight);
        const Deflection<double> d = point.sample(random.next());
        scattering.values.insert(scattering.values.end(), {d.one_minus, d.one_plus, point.density(d)});
        add(point.scattered(d), scattering.values);
      }
    }
  }
  return {transmittances, flights, scattering};
}

inline std::vector<NumberGroup> every_number() {
  std::vector<NumberGroup> out;
  [&]<class... L>(std::type_identity<std::variant<L...>>) {
    (out.push_back(numbers_of_law<double, L>("double")), ...);
    (out.push_back(numbers_of_law<float, L>("float")), ...);
  }(std::type_identity<Law<double>>{});
  out.push_back(numbers_of_dials());
  for (NumberGroup& group : numbers_of_rays()) out.push_back(std::move(group));
  return out;
}

}  // namespace tyndall
