// Nanoseconds per density and per sample of each law: the same text in float, one at a time without vectorisation
// (this file is compiled so), and in Lanes for each instruction set. Inputs and results in arrays of 4096.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <string>

#include "tyndall/phase/law_as.h"
#include "tyndall/phase/phase_kernels.h"

namespace tyndall {
namespace {

constexpr std::size_t count = 4096;

struct Arrays {
  std::vector<float> xi, mu, one_minus, one_plus, value;

  // Deflections as the law itself scatters, xi in an order that no branch predictor knows.
  explicit Arrays(const LobeSum<float>& lobes) : xi(count), mu(count), one_minus(count), one_plus(count), value(count) {
    for (std::size_t i = 0; i < count; ++i) {
      xi[i] = (static_cast<float>((i * 2654435761U) % count) + 0.5F) / static_cast<float>(count);
      const Deflection<float> d = sample(lobes, xi[i]);
      mu[i] = d.mu;
      one_minus[i] = d.one_minus;
      one_plus[i] = d.one_plus;
    }
  }
};

void report(benchmark::State& state) {
  using benchmark::Counter;
  const double items = static_cast<double>(count) * static_cast<double>(state.iterations());
  state.counters["seconds_per_value"] = Counter(items, Counter::kIsRate | Counter::kInvert);
}

// The kernel's order of work: a pass for each lobe, the lobe's kind chosen outside the loop.
void scalar_density(const LobeSum<float>& lobes, Arrays& a) {
  for (std::size_t k = 0; k < lobes.size(); ++k) {
    std::visit(
        [&](const auto& shared) {
          const auto lobe = shared;
          const float weight = lobes[k].weight;
          for (std::size_t i = 0; i < count; ++i) {
            const float term = weight * lobe.density({a.mu[i], a.one_minus[i], a.one_plus[i]});
            a.value[i] = k == 0 ? term : a.value[i] + term;
          }
        },
        lobes[k].lobe);
  }
}

template <class Inverse>
void scalar_samples(Arrays& a, Inverse inverse) {
  for (std::size_t i = 0; i < count; ++i) {
    const Deflection<float> d = inverse(a.xi[i]);
    a.mu[i] = d.mu;
    a.one_minus[i] = d.one_minus;
    a.one_plus[i] = d.one_plus;
  }
}

void scalar_sample(const Law<float>& law, const LobeSum<float>& lobes, const std::optional<QuantileStart>& start,
                   Arrays& a) {
  std::visit(
      [&](const auto& own) {
        if constexpr (requires { own.sample(0.5F); }) {
          scalar_samples(a, [own](float xi) { return own.sample(xi); });
        } else if (start) {
          scalar_samples(a, [&](float xi) { return sample(lobes, *start, xi); });
        } else if (lobes.size() == 1) {
          std::visit([&](const auto& lobe) { scalar_samples(a, [lobe](float xi) { return lobe.sample(xi); }); },
                     lobes.front().lobe);
        } else {
          scalar_samples(a, [&](float xi) { return sample(lobes, xi); });
        }
      },
      law);
}

void add(const std::string& name, const std::function<void()>& body) {
  benchmark::RegisterBenchmark(name.c_str(),
                               [body](benchmark::State& state) {
                                 for (auto _ : state) {
                                   body();
                                   benchmark::ClobberMemory();  // the arrays are reachable from outside: every result
                                                                // is stored, every input read
                                 }
                                 report(state);
                               })
      // The machine is shared: the least of many short runs is what it can do.
      ->MinTime(0.01)
      ->Repetitions(9)
      ->ReportAggregatesOnly(true)
      ->ComputeStatistics("least",
                          [](const std::vector<double>& all) { return *std::min_element(all.begin(), all.end()); });
}

void add_law(const std::string& name, const Law<double>& exact) {
  const auto law = std::make_shared<Law<float>>(law_as<float>(exact));
  const auto lobes = std::make_shared<LobeSum<float>>(lobes_as<float>(lower(exact)));
  const auto a = std::make_shared<Arrays>(*lobes);
  benchmark::DoNotOptimize(a.get());
  add("density/" + name + "/scalar", [=] { scalar_density(*lobes, *a); });
  std::vector<InstructionSet> sets{InstructionSet::baseline};
  for (const InstructionSet set : {InstructionSet::avx2, InstructionSet::avx512})
    if (set <= best_instruction_set()) sets.push_back(set);
  for (const InstructionSet set : sets) {
    add("density/" + name + "/" + std::string(name_of(set)), [=, arrays = PhaseArrays(*lobes, set)] {
      arrays.density({a->mu, a->one_minus, a->one_plus}, a->value);
    });
  }
  const auto b = std::make_shared<Arrays>(*lobes);
  benchmark::DoNotOptimize(b.get());
  add("sample/" + name + "/scalar", [=, start = quantile_start(*lobes)] { scalar_sample(*law, *lobes, start, *b); });
  for (const InstructionSet set : sets) {
    add("sample/" + name + "/" + std::string(name_of(set)), [=, arrays = PhaseArrays(*lobes, set)] {
      arrays.sample(b->xi, {b->mu, b->one_minus, b->one_plus});
    });
  }
}

// Henyey and Greenstein's law of g = 0.9 at angles in geometric progression: a table's cost is its binary search.
Tabulated<double> table_of(int knots) {
  Tabulated<double> out;
  for (int i = 0; i < knots; ++i) {
    const double angle = i == 0 ? 0.0 : i + 1 == knots ? 180.0 : 0.1 * std::pow(1800.0, (i - 1.0) / (knots - 2.0));
    out.angles.push_back(angle);
    const auto d = Deflection<double>::from_angle(angle * std::acos(-1.0) / 180.0);
    out.values.push_back(Spectrum::grey(density(Law<double>(HenyeyGreenstein<double>{0.9}), d)));
  }
  return out;
}

// Every law of the list, as it is by default or in ordinary use, and where it is hard. Names: law, or law:what.
const int registered = [] {
  add_law("isotropic", Isotropic<double>{});
  add_law("rayleigh", Rayleigh<double>{0.03});
  add_law("henyey_greenstein", HenyeyGreenstein<double>{0.8});
  add_law("henyey_greenstein:g=0.9999", HenyeyGreenstein<double>{0.9999});
  add_law("mie_hazy", MieHazy<double>{});
  add_law("mie_murky", MieMurky<double>{});
  add_law("nishita_murky", NishitaMurky<double>{});
  add_law("schlick", Schlick<double>{0.8});
  add_law("cornette_shanks", CornetteShanks<double>{0.7});
  add_law("draine", Draine<double>{0.5, 1.0});
  add_law("draine:g=0.3,alpha=250", Draine<double>{0.3, 250.0});
  add_law("droplet", Droplet<double>{10.0});
  add_law("droplet:diameter=5", Droplet<double>{5.0});  // two fits cross-faded: four lobes
  add_law("lambert_sphere", LambertSphere<double>{});
  add_law("fournier_forand", FournierForand<double>{1.1, 3.5835});
  add_law("fournier_forand:n=1.02,slope=3.2", FournierForand<double>{1.02, 3.2});
  for (const int knots : {32, 512, 8192}) add_law("tabulated:knots=" + std::to_string(knots), table_of(knots));
  add_law("mixture", Mixture<double>{{{0.7, HenyeyGreenstein<double>{0.9}}, {0.3, HenyeyGreenstein<double>{-0.2}}}});
  add_law("mixture:hg,hg,isotropic", Mixture<double>{{{0.3, HenyeyGreenstein<double>{0.9999}},
                                                      {0.2, HenyeyGreenstein<double>{-0.9999}},
                                                      {0.5, Isotropic<double>{}}}});
  return 0;
}();

}  // namespace
}  // namespace tyndall
