// Scattering in mixtures whose shares differ by channel: one sample serves all channels, weighted by the balance
// heuristic.
#include "tyndall/medium/scatter.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/property.h"
#include "tyndall/phase/law_suites_test.h"
#include "tyndall/phase/sample_histogram_test.h"

namespace tyndall {
namespace {

using tests::expect_property;
using tests::magnitude;
using tests::real;

template <class... L>
std::vector<Law<double>> all_cases(std::type_identity<std::variant<L...>>) {
  std::vector<Law<double>> out;
  const auto add = [&](const std::vector<Law<double>>& cases) { out.insert(out.end(), cases.begin(), cases.end()); };
  (add(law_cases<L>()), ...);
  Tabulated<double> rainbow{{0.0, 5.0, 60.0, 137.0, 139.0, 142.0, 180.0}, {}, {}};
  for (const double x : {900.0, 40.0, 1.0, 0.7, 2.0, 0.9, 1.5})
    rainbow.values.push_back(Spectrum{{x, std::sqrt(x), 1.0 + 0.5 * x}});
  for (int i = 0; i < 20; ++i) out.push_back(rainbow);
  return out;
}

Species species_of(const Spectrum& scattering, const Law<double>& phase) { return {"", scattering, {}, phase, {}}; }

/// A constant medium and a path's throughput, with what follows from them.
struct Scattering {
  LoweredMedium medium;
  Spectrum beta;
  ScatterPoint point;

  Scattering(const Medium& of, const Spectrum& throughput) : medium(lower(of)), beta(throughput) {
    std::vector<Stretch> stretches;
    stretches_along(medium, {{0, 0, 0}, {1, 0, 0}}, 1.0, stretches);
    point.set(medium, stretches, 0.5);
    point.aim(beta);
  }
  /// Chance of each channel to be the one that is sampled for.
  Spectrum channel_chances() const {
    const Spectrum light = beta * point.scattering();
    return light / sum(light);
  }
  /// What a path's throughput is multiplied by, per channel, when it scatters by d.
  Spectrum weight(const Deflection<double>& d) const {
    const Spectrum scattered = point.scattered(d);
    Spectrum w;
    for (std::size_t c = 0; c < channel_count; ++c)
      w[c] = point.scattering()[c] > 0.0 ? scattered[c] / (point.scattering()[c] * point.density(d)) : 0.0;
    return w;
  }

  /// visit(per channel, its share of the lobe; the lobe) of all lobes, in the order in which sample takes them.
  template <class Visit>
  void for_each_lobe(Visit visit) const {
    for (const LoweredSpecies& s : medium.species) {
      if (is_zero(s.scattering)) continue;
      for (std::size_t i = 0; i < s.lobe_count; ++i) {
        const WeightedLobe<double>& lobe = medium.lobes[s.first_lobe + i];
        visit(s.scattering * lobe.weight / total(), lobe.lobe);
      }
    }
  }

  /// The estimator's mean of f(d) per channel, int weight(sample(xi)) f dxi over [0, 1]: each lobe's part of xi, which
  /// is the integral over its deflections at xi = F(d).
  template <class Function>
  Spectrum mean(Function f) const {
    Spectrum out;
    double start = 0.0;
    const Spectrum chances = channel_chances();
    for_each_lobe([&](const Spectrum& share, const Lobe<double>& lobe) {
      const double chance = sum(chances * share);
      const auto integrand = [&](const Deflection<double>& at) {
        const double p = std::visit([&](const auto& l) { return l.density(at); }, lobe);
        if (p * at.one_minus * at.one_plus < 1e-14) return Spectrum();
        const double xi = std::visit([&](const auto& l) { return l.cdf(at); }, lobe);
        const Deflection<double> d = point.sample(start + chance * xi);
        return weight(d) * (f(d) * chance * p);
      };
      if (chance > 0.0) out += integral_over_sphere(kinks_of(medium.lobes), integrand);
      start += chance;
    });
    return out;
  }

 private:
  Spectrum total() const {
    return map(point.scattering(), [](double x) { return x > 0.0 ? x : 1.0; });
  }
};

/// One to four species of any laws, faint in some channels and absent from others, met by a path that may have lost all
/// its light in some.
Scattering any_scattering(const std::vector<Law<double>>& laws) {
  const auto any_spectrum = [] {
    Spectrum out;
    for (double& x : out.value) x = *rc::gen::inRange(0, 5) == 4 ? 0.0 : *magnitude(1e-6, 1.0);
    return out;
  };
  Medium medium;
  const int count = *rc::gen::inRange(1, 5);
  for (int i = 0; i < count; ++i)
    medium.species.push_back(species_of(any_spectrum(), laws[*rc::gen::inRange<std::size_t>(0, laws.size())]));
  return {medium, any_spectrum()};
}

/// Where a path's light is the same in all channels, no weight exceeds their number; in general that of a channel is at
/// most one over its share of the light, so that the sum of throughputs never grows.
void weights_are_bounded(int cases) {
  const std::vector<Law<double>> laws = all_cases(std::type_identity<Law<double>>{});
  expect_property(cases, [&] {
    Scattering s = any_scattering(laws);
    const Spectrum scattering = s.point.scattering();
    if (*rc::gen::inRange(0, 2) == 0) s.beta = map(scattering, [](double x) { return x > 0.0 ? 1.0 / x : 0.0; });
    RC_PRE(sum(s.beta * scattering) > 0.0);
    s.point.aim(s.beta);
    const Spectrum chances = s.channel_chances();
    const auto bright = static_cast<double>(
        std::count_if(chances.value.begin(), chances.value.end(), [](double p) { return p > 0.0; }));
    const bool equal = std::all_of(chances.value.begin(), chances.value.end(),
                                   [&](double p) { return p == 0.0 || std::fabs(p * bright - 1.0) < 1e-12; });
    for (int i = 0; i < 16; ++i) {
      const Spectrum w = s.weight(s.point.sample(*real(0.0, 1.0)));
      RC_ASSERT(std::fabs(sum(chances * w) - 1.0) < 1e-12);
      for (std::size_t c = 0; c < channel_count; ++c) {
        RC_ASSERT(w[c] >= 0.0);
        if (chances[c] == 0.0) continue;
        RC_ASSERT(w[c] <= (1.0 + 1e-12) / chances[c]);
        if (equal) RC_ASSERT(w[c] <= bright * (1.0 + 1e-12));
      }
    }
  });
}

/// int weight f dxi = 2 pi int p_c f dmu for every channel that has light: for f = 1 (1), mu and P_2 (the lobes' own
/// moments).
void means_are_integrals(int cases) {
  const std::vector<Law<double>> laws = all_cases(std::type_identity<Law<double>>{});
  expect_property(cases, [&] {
    const Scattering s = any_scattering(laws);
    RC_PRE(sum(s.beta * s.point.scattering()) > 0.0);
    for (int l = 0; l <= 2; ++l) {
      const Spectrum found = s.mean([&](const Deflection<double>& d) { return legendre(l, d.mu); });
      Spectrum expected;
      s.for_each_lobe([&](const Spectrum& share, const Lobe<double>& lobe) {
        expected += share * std::visit([&](const auto& each) { return each.moment(l); }, lobe);
      });
      for (std::size_t c = 0; c < channel_count; ++c) {
        // The less of the light a channel has, the more its weights magnify rounding.
        const double share = s.channel_chances()[c];
        if (share > 1e-6) RC_ASSERT(std::fabs(found[c] - expected[c]) < 1e-9);
      }
    }
  });
}

TEST(ScatterPoint, WeightsAreBounded) { weights_are_bounded(5000); }
TEST(ScatterPoint, TheMeanIsTheIntegralInEveryChannel) { means_are_integrals(40); }

TEST(ScatterPointSoak, WeightsAreBounded) { weights_are_bounded(100000); }
TEST(ScatterPointSoak, TheMeanIsTheIntegralInEveryChannel) { means_are_integrals(5000); }

/// Four mixtures a picture may hold. False alarms: 12 in a million if the numbers were drawn anew; the seeds are fixed.
void samples_follow_the_density(int count) {
  const Species air = species_of({{5.8e-6, 1.36e-5, 3.31e-5}}, Rayleigh<double>{0.0279});
  const Species fog = species_of({{2e-5, 1.5e-5, 1e-5}}, Droplet<double>{10.0});
  const Species murky = species_of({{1e-4, 0.0, 1e-6}}, MieMurky<double>{});
  const Species peaks = species_of(Spectrum::grey(1e-5), Mixture<double>{{{1.0, HenyeyGreenstein<double>{0.9999}},
                                                                          {2.0, HenyeyGreenstein<double>{-0.9946}},
                                                                          {0.5, Draine<double>{0.3, 250.0}}}});
  const Species rainbow = species_of({{1e-5, 2e-5, 5e-5}}, all_cases(std::type_identity<Law<double>>{}).back());
  unsigned seed = 3;
  for (const auto& [medium, beta] : {std::pair{Medium{{air, fog}}, Spectrum::grey(1.0)},
                                     {Medium{{air, murky, peaks}}, Spectrum{{0.01, 1.0, 0.0}}},
                                     {Medium{{rainbow}}, Spectrum{{1.0, 0.5, 0.1}}},
                                     {Medium{{rainbow, air, murky, fog}}, Spectrum::grey(1.0)}}) {
    const Scattering s(medium, beta);
    SampleHistogram found([&](const Deflection<double>& d) { return s.point.density(d); });
    std::mt19937_64 random(++seed);
    for (int i = 0; i < count; ++i) {
      const Deflection<double> d = s.point.sample((static_cast<double>(random() >> 12) + 0.5) * 0x1p-52);
      found.add(d.one_minus, d.one_plus);
    }
    SCOPED_TRACE("medium " + std::to_string(seed - 3));
    found.judge();
  }
  tests::say_cases(4, "media, " + std::to_string(count) + " samples each");
}

TEST(ScatterPoint, SamplesFollowTheDensity) { samples_follow_the_density(1000000); }
TEST(ScatterPointSoak, SamplesFollowTheDensity) { samples_follow_the_density(10000000); }

}  // namespace
}  // namespace tyndall
