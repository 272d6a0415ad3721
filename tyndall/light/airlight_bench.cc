// Airlight per ray and light: closed form, panels, and what chooses between them. Inputs and results stay in memory.
#include <benchmark/benchmark.h>

#include <random>

#include "tyndall/light/airlight_spot.h"
#include "tyndall/phase/law.h"

namespace tyndall {
namespace {

struct Setting {
  LampAside lamp;
  Interval lit;
  Spectrum extinction;
};

/// A street: lamps 1 to 100 m ahead, 0.1 to 10 m beside the ray, mean free paths of 10 to 1000 m.
std::vector<Setting> settings(bool chromatic) {
  std::mt19937_64 random(1);
  const auto decades = [&](double low, double high) {
    return std::pow(10.0, low + (high - low) * (static_cast<double>(random() >> 11) * 0x1p-53));
  };
  std::vector<Setting> out;
  for (int i = 0; i < 256; ++i) {
    const double sigma = decades(-3.0, -1.0);
    out.push_back({{decades(0.0, 2.0), decades(-1.0, 1.0)},
                   {0.0, decades(1.0, 2.5)},
                   chromatic ? Spectrum{{sigma, 1.5 * sigma, 3.0 * sigma}} : Spectrum::grey(sigma)});
  }
  return out;
}

Law<double> law_of(long index) {
  switch (index) {
    case 0:
      return Isotropic<double>{};
    case 1:
      return Rayleigh<double>{};
    case 2:
      return MieHazy<double>{};
    case 3:
      return MieMurky<double>{};
    default:
      return HenyeyGreenstein<double>{0.7};
  }
}

template <class Value>
void run(benchmark::State& state, Value value) {
  const Law<double> law = law_of(state.range(0));
  std::vector<ScatteringLobe> lobes;
  for (const auto& part : lower(law)) lobes.push_back({Spectrum::grey(0.01 * part.weight), part.lobe});
  const std::vector<Setting> all = settings(state.range(1) == 1);
  std::vector<Spectrum> results(all.size());
  long answered = 0;
  for (auto _ : state) {
    for (std::size_t i = 0; i < all.size(); ++i) answered += value(lobes, all[i], results[i]);
    benchmark::DoNotOptimize(results.data());
  }
  const auto count = static_cast<double>(all.size());
  state.counters["per_ray_and_light"] =
      benchmark::Counter(count, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  state.counters["answered"] = static_cast<double>(answered) / (count * static_cast<double>(state.iterations()));
  state.SetLabel(std::visit([](const auto& l) { return std::string(std::decay_t<decltype(l)>::name); }, law) +
                 (state.range(1) == 1 ? ", chromatic" : ", grey"));
}

using Lobes = std::vector<ScatteringLobe>;

void closed_form(benchmark::State& state) {
  run(state, [](const Lobes& lobes, const Setting& s, Spectrum& out) {
    const auto value = airlight_in_closed_form(lobes, s.extinction, AirlightStretch::of(s.lamp, s.lit));
    if (value) out = *value;
    return value ? 1 : 0;
  });
}
void panels(benchmark::State& state) {
  run(state, [](const Lobes& lobes, const Setting& s, Spectrum& out) {
    out = airlight_by_panels(lobes, s.extinction, AirlightStretch::of(s.lamp, s.lit));
    return 1;
  });
}
void whichever(benchmark::State& state) {
  run(state, [](const Lobes& lobes, const Setting& s, Spectrum& out) {
    out = airlight(lobes, s.extinction, s.lamp, s.lit);
    return 1;
  });
}

BENCHMARK(closed_form)->ArgsProduct({{0, 1, 2, 3}, {0, 1}});
BENCHMARK(panels)->ArgsProduct({{0, 1, 2, 3, 4}, {0, 1}});
BENCHMARK(whichever)->ArgsProduct({{0, 1, 2, 3, 4}, {0, 1}});

}  // namespace
}  // namespace tyndall
