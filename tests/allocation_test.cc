// "No allocation after lowering": counted at operator new. What is reused must first have grown, so everything is run
// twice and counted the second time.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>
#include <string>
#include <vector>

#include "tyndall/artist/prepared_blend.h"
#include "tyndall/medium/free_flight.h"
#include "tyndall/medium/scatter.h"
#include "tyndall/phase/law_as.h"
#include "tyndall/phase/law_cases_test.h"
#include "tyndall/sampling/random_stream.h"

namespace {
std::atomic<std::size_t> allocations{0};
}  // namespace

// Not inlined: g++ 12 would see malloc and delete, or new and free, meet.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++allocations;
  if (void* p = std::malloc(size)) return p;
  std::abort();
}
[[gnu::noinline]] void operator delete(void* p) noexcept { std::free(p); }
[[gnu::noinline]] void operator delete(void* p, std::size_t) noexcept { std::free(p); }

namespace tyndall {
namespace {

/// Allocations of the second of two runs.
template <class Run>
std::size_t allocations_of(Run run) {
  run();
  const std::size_t before = allocations;
  run();
  return allocations - before;
}

TEST(Allocation, IsSeenByThisTest) {
  EXPECT_GE(allocations_of([] { EXPECT_EQ(std::vector<double>(100, 1.0).back(), 1.0); }), 1u);
}

template <class T>
void expect_none_in_lobes() {
  const auto deflections = test_deflections();
  const auto numbers = test_xi();
  const auto of_law = [&]<class L>(std::type_identity<L>) {
    for (const Law<double>& described : law_cases<L>()) {
      const LobeSum<T> lobes = lower(law_as<T>(described));
      T sum(0.0);
      const std::size_t count = allocations_of([&] {
        for (const Deflection<double>& d : deflections) {
          const Deflection<T> at{static_cast<T>(d.mu), static_cast<T>(d.one_minus), static_cast<T>(d.one_plus)};
          sum += density(lobes, at) + cdf(lobes, at) + survival(lobes, at);
        }
        for (const double xi : numbers) sum += sample(lobes, static_cast<T>(xi)).mu;
      });
      EXPECT_EQ(count, 0u) << words(described);
      EXPECT_TRUE(std::isfinite(sum)) << words(described);
    }
  };
  [&]<class... L>(std::type_identity<std::variant<L...>>) {
    (of_law(std::type_identity<L>{}), ...);
  }(std::type_identity<Law<double>>{});
}

TEST(Allocation, ThereIsNoneInTheLobesOfAnyLaw) {
  expect_none_in_lobes<double>();
  expect_none_in_lobes<float>();
}

/// Species of every kind of profile.
LoweredMedium everything() {
  Medium medium;
  const auto add = [&](Law<double> law, std::vector<Profile> profiles) {
    medium.species.push_back({"", Spectrum::grey(0.01), Spectrum::grey(0.001), std::move(law), std::move(profiles)});
  };
  add(Rayleigh<double>{}, {});
  add(MieHazy<double>{}, {ExponentialProfile{30.0, 0.0}});
  add(MieMurky<double>{}, {LayerProfile{0.0, 20.0}});
  add(HenyeyGreenstein<double>{0.9}, {TentProfile{5.0, 20.0}});
  add(Isotropic<double>{}, {BoxProfile{{-50.0, -10.0, -50.0}, {50.0, 30.0, 50.0}, 4.0}});
  add(HenyeyGreenstein<double>{-0.3}, {SphereProfile{{10.0, 0.0, 0.0}, 20.0, 5.0}, ExponentialProfile{10.0, 0.0}});
  add(HenyeyGreenstein<double>{0.5}, {NoiseProfile{6.0, 4, 0.7, 3, {1.0, 0.0, 0.0}}, LayerProfile{-5.0, 15.0}});
  return lower(medium, 2.0);
}

TEST(Allocation, ThereIsNoneOnRaysThroughALoweredMedium) {
  const LoweredMedium medium = everything();
  ASSERT_EQ(medium.species.size(), 7u);
  std::vector<Stretch> stretches;
  ScatterPoint point;
  int collisions = 0;
  const std::size_t count = allocations_of([&] {
    for (std::uint32_t sample = 0; sample < 300; ++sample) {
      RandomStream random(1, 0, sample);
      const Vector direction = normalized({random.next() - 0.5, random.next() - 0.5, random.next() - 0.5});
      stretches_along(medium, {{0.0, 3.0, 0.0}, direction}, 200.0, stretches);
      const Spectrum through = transmittance(stretches, 200.0);
      EXPECT_LE(through[0], 1.0);
      const double xi_channel = random.next();
      const Flight flight =
          sample_flight(stretches, {{0.2, 0.3, 0.5}}, 200.0, sample % 2 == 0, xi_channel, random.next());
      if (!(flight.t < infinity)) continue;
      ++collisions;
      point.set(medium, stretches, flight.t);
      point.aim(flight.weight);
      const Deflection<double> turn = point.sample(random.next());
      EXPECT_GT(point.density(turn), 0.0);
      EXPECT_GT(sum(point.scattered(turn)), 0.0);
    }
  });
  EXPECT_EQ(count, 0u);
  EXPECT_GT(collisions, 300);  // of both runs
}

TEST(Allocation, ThereIsNoneWhenCoefficientsChangeFromFrameToFrame) {
  const LoweredMedium whole = everything();
  LoweredMedium now = whole;
  std::vector<Stretch> stretches;
  double before = 1.0;
  const std::size_t count = allocations_of([&] {
    for (int frame = 0; frame <= 10; ++frame) {
      for (std::size_t i = 0; i < now.species.size(); ++i) {
        now.species[i].extinction = whole.species[i].extinction * (frame / 10.0);
      }
      const Ray ray{{-60.0, 3.0, 0.0}, {1.0, 0.0, 0.0}};
      const double through = transmittance(now, ray, 120.0, stretches)[1];
      EXPECT_TRUE(frame == 0 ? through == 1.0 : through < before) << frame;
      before = through;
    }
  });
  EXPECT_EQ(count, 0u);
}

/// Pairs that exercise every model, law with numbers, form of profile and table.
std::vector<std::pair<MediumDials, MediumDials>> pairs_to_blend() {
  Tabulated<double> table;
  table.angles = {0.0, 60.0, 180.0};
  table.values = {{{10.0, 9.0, 8.0}}, {{1.0, 1.0, 2.0}}, Spectrum::grey(0.5)};
  const auto species = [&](double x) {
    std::vector<StatedSpecies> out;
    const auto add = [&](Law<double> law, std::optional<Profile> profile) {
      StatedSpecies s;
      s.name = "a species with a name too long for any short string " + std::to_string(out.size());
      s.density = Visibility{Spectrum::grey(1000.0 * (1.0 + x))};
      s.albedo = Spectrum::grey(0.5 + 0.4 * x);
      s.phase = std::move(law);
      s.profile = std::move(profile);
      out.push_back(std::move(s));
    };
    add(Mixture<double>{{{1.0 + x, table},
                         {2.0, Mixture<double>{{{1.0, MieHazy<double>{}}, {x, Schlick<double>{x}}}}}}},
        LayerProfile{-1.0 - x, 2.0});
    add(Droplet<double>{1.4 + 2.0 * x}, NoiseProfile{6.0, 4, x, 3, {1.0, 0.0, 0.0}});
    add(table, BoxProfile{{-5.0, -5.0, -5.0}, {5.0 + x, 5.0, 5.0}, x});
    add(Draine<double>{0.5 + 0.1 * x, 1.0}, SphereProfile{{x, 0.0, 0.0}, 9.0, 4.0 * x});
    add(FournierForand<double>{1.1 + 0.1 * x, 3.5}, TentProfile{x, 10.0});
    add(CornetteShanks<double>{x - 0.5}, std::nullopt);
    return out;
  };
  const Background air{Air::standard, 1.0, ExponentialProfile{8000.0, 0.0}, 0.0, 300.0};
  Background more_air = air;
  more_air.exaggeration = 3.0;
  std::vector<std::pair<MediumDials, MediumDials>> out;
  const auto add = [&](const Conditions& a, const Conditions& b) {
    out.push_back({{air, a, species(0.0)}, {more_air, b, species(0.9)}});
  };
  Simple haze{0.2, Visibility{Spectrum::grey(3000.0)}, Spectrum::grey(1.0), {}, ExponentialProfile{30.0, 0.0}, {}};
  Simple fog{0.9, Visibility{Spectrum::grey(50.0)}, Spectrum::grey(0.9), Veil{}, ExponentialProfile{90.0, 1.0}, {}};
  add(haze, fog);
  fog.hold = Hold::visibility;
  add(haze, fog);
  TwoLobes lobes{0.3, 0.8, -0.2, MeanFreePath{Spectrum::grey(90.0)}, Spectrum::grey(1.0), {}, {}}, other = lobes;
  other.r = 0.6, other.g1 = 0.1;
  add(lobes, other);
  const ExplicitLobe ahead{0.8, PlainExtinction{Spectrum::grey(1e-3)}, Spectrum::grey(1.0)};
  add(TwoLobesExplicit{ahead, {}, {}, {}}, TwoLobesExplicit{{}, ahead, Veil{}, {}});
  Measured drops;
  drops.air = Particles::fog;
  drops.visibility = 80.0;
  Measured larger = drops;
  larger.droplet_diameter = 30.0;
  add(drops, larger);
  return out;
}

TEST(Allocation, ThereIsNoneInPreparedBlends) {
  std::vector<Stretch> stretches;
  const Ray ray{{-60.0, 3.0, 0.0}, {1.0, 0.0, 0.0}};
  for (const auto& [a, b] : pairs_to_blend()) {
    for (const BlendHow how : {BlendHow::interpolate, BlendHow::mix, BlendHow::morph}) {
      auto made = PreparedBlend::of(a, b, how);
      ASSERT_TRUE(std::holds_alternative<PreparedBlend>(made));
      PreparedBlend& blend = std::get<PreparedBlend>(made);
      double before = -1.0;
      const std::size_t count = allocations_of([&] {
        for (int frame = 0; frame <= 24; ++frame) {
          const double through = transmittance(blend.at(frame / 24.0, 0.1 * frame), ray, 120.0, stretches)[1];
          EXPECT_TRUE(through > 0.0 && through < 1.0 && through != before) << frame;
          before = through;
        }
      });
      EXPECT_EQ(count, 0u) << static_cast<int>(how);
    }
  }
}

}  // namespace
}  // namespace tyndall
