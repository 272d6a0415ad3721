// A medium in thirty lines: a hazy morning, how far one sees in it, and a photon on its way.
//   g++ -std=c++20 -O2 -fno-exceptions -fno-rtti -I. examples/minimal.cc -o minimal && ./minimal
#include <cstdio>

#include "tyndall/medium/free_flight.h"
#include "tyndall/medium/scatter.h"
#include "tyndall/sampling/random_stream.h"

int main() {
  using namespace tyndall;
  // Two kinds of particles in the same air, with coefficients per channel [1/m]: they simply add.
  const Spectrum thick = Spectrum::grey(2e-3), soot = Spectrum::grey(1e-4);
  const Species air{"air", {{5.8e-6, 1.36e-5, 3.31e-5}}, {}, Rayleigh<double>{}, {}};
  const Species haze{"haze", thick, soot, HenyeyGreenstein<double>{0.8}, {ExponentialProfile{30.0, 0.0}}};
  const Medium medium{{air, haze}};
  const Vector here{0.0, 2.0, 0.0};
  const double extinction = (scattering_at(medium, here) + absorption_at(medium, here))[1];
  std::printf("visibility %.0f m, mean cosine %.3f\n", visibility_of(extinction), mean_cosine_at(medium, here)[1]);
  // What a ray meets, by stretches: optical depth in closed form, a collision, and a scattering there.
  const LoweredMedium lowered = lower(medium);
  std::vector<Stretch> stretches;
  stretches_along(lowered, {here, normalized({1.0, 0.1, 0.0})}, 1000.0, stretches);
  RandomStream random(1, 0, 0);
  const double channel = random.next(), depth = random.next();
  const Flight flight = sample_flight(stretches, Spectrum::grey(1.0), 1000.0, true, channel, depth);
  ScatterPoint point;
  point.set(lowered, stretches, flight.t);
  point.aim(Spectrum::grey(1.0));
  std::printf("collides after %.1f m and turns to mu = %.4f\n", flight.t, point.sample(random.next()).mu);
}
