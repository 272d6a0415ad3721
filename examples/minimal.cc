// A medium in thirty lines: a hazy morning, how far one sees in it, and a photon on its way.
//   g++ -std=c++20 -O2 -fno-exceptions -fno-rtti -I. examples/minimal.cc -o minimal && ./minimal
#include <cstdio>

#include "tyndall/medium/free_flight.h"
#include "tyndall/medium/scatter.h"
#include "tyndall/sampling/random_stream.h"

int main() {
  using namespace tyndall;
  // Two kinds of particles in the same air, with coefficients per channel [1/m]: they simply add.
  Medium medium;
  medium.species.push_back({"air", {{5.8e-6, 1.36e-5, 3.31e-5}}, {}, Rayleigh<double>{}, {}});
  medium.species.push_back({"haze",
                            Spectrum::grey(2e-3),
                            Spectrum::grey(1e-4),
                            HenyeyGreenstein<double>{0.8},
                            {ExponentialProfile{30.0, 0.0}}});
  const Vector here{0.0, 2.0, 0.0};
  const Spectrum extinction = scattering_at(medium, here) + absorption_at(medium, here);
  std::printf("visibility %.0f m, mean cosine %.3f (green)\n", visibility_of(extinction[1]),
              mean_cosine_at(medium, here)[1]);

  // What a ray meets: optical depth in closed form, a collision, and a scattering there.
  const LoweredMedium lowered = lower(medium);
  const Ray ray{here, normalized({1.0, 0.1, 0.0})};
  std::vector<Stretch> stretches;
  stretches_along(lowered, ray, 1000.0, stretches);
  std::printf("transmittance over 1 km %.4f (green)\n", transmittance(stretches, 1000.0)[1]);
  RandomStream random(1, 0, 0);
  const double xi = random.next();
  const Flight flight = sample_flight(stretches, Spectrum::grey(1.0), 1000.0, true, xi, random.next());
  ScatterPoint point;
  point.set(lowered, stretches, flight.t);
  point.aim(Spectrum::grey(1.0));
  const Deflection<double> deflection = point.sample(random.next());
  std::printf("collides after %.1f m, turns to mu = %.4f, p = %.4f 1/sr\n", flight.t, deflection.mu,
              point.density(deflection));
}
