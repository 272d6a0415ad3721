#include <cmath>
#include <cstdio>
#include <vector>

// [walk]
#include "tyndall/medium/free_flight.h"
#include "tyndall/medium/scatter.h"
#include "tyndall/sampling/direction.h"
#include "tyndall/sampling/random_stream.h"

// What a thread keeps: the lists are filled anew for each ray, and after the first ones nothing allocates.
struct Scratch {
  std::vector<tyndall::Stretch> stretches;
  tyndall::ScatterPoint point;
};

// The throughput with which a walk that enters at `ray` leaves the medium within 2 km, or {} when it does not.
tyndall::Spectrum walk(const tyndall::LoweredMedium& medium, tyndall::Ray ray, tyndall::RandomStream& random,
                       Scratch& scratch) {
  using namespace tyndall;
  Spectrum throughput = Spectrum::grey(1.0);
  for (int order = 0; order < 200; ++order) {
    stretches_along(medium, ray, 2000.0, scratch.stretches);
    const double xi_channel = random.next();
    const Flight flight = sample_flight(scratch.stretches, throughput, 2000.0, false, xi_channel, random.next());
    throughput *= flight.weight;
    if (!(flight.t < infinity)) return throughput;

    scratch.point.set(medium, scratch.stretches, flight.t);
    scratch.point.aim(throughput);
    const Deflection<double> turn = scratch.point.sample(random.next());
    throughput *= scratch.point.scattered(turn) / scratch.point.density(turn);
    if (!(sum(throughput) > 0.0)) break;
    ray = {ray.at(flight.t), around(Frame::around(ray.direction), turn.mu, turn.sine(), random.next())};
    ray.direction = normalized(ray.direction);
  }
  return {};
}
// [end]

int main() {
  using namespace tyndall;
  // [ray]
  Medium medium;
  medium.species.push_back({"air", {{5.8e-6, 1.36e-5, 3.31e-5}}, {}, Rayleigh<double>{}, {}});
  medium.species.push_back(
      {"cloud", Spectrum::grey(0.02), Spectrum::grey(1e-4), HenyeyGreenstein<double>{0.85}, {LayerProfile{0.0, 50.0}}});
  const LoweredMedium lowered = lower(medium);
  Scratch scratch;

  const Ray up{{0.0, 0.0, 0.0}, normalized({0.3, 1.0, 0.0})};
  stretches_along(lowered, up, 2000.0, scratch.stretches);
  const Spectrum through = transmittance(scratch.stretches, 2000.0);
  std::printf("transmittance %.4f %.4f %.4f\n", through[0], through[1], through[2]);

  Spectrum total;
  for (std::uint32_t sample = 0; sample < 2000; ++sample) {
    RandomStream random(1, 0, sample);  // seed, pixel, sample
    total += walk(lowered, up, random, scratch);
  }
  const Spectrum leaves = total / 2000.0;
  std::printf("light that leaves %.2f %.2f %.2f\n", leaves[0], leaves[1], leaves[2]);
  // [end]
  return leaves[1] > through[1] && leaves[1] < 1.05 ? 0 : 1;
}
