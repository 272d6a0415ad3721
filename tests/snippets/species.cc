#include <cstdio>

#include "tyndall/medium/lowered_species.h"

int main() {
  using namespace tyndall;
  // [species]
  Medium haze;
  haze.species.push_back({"air", {{5.8e-6, 1.36e-5, 3.31e-5}}, {}, Rayleigh<double>{}, {}});
  haze.species.push_back({"haze",
                          Spectrum::grey(2e-3),
                          Spectrum::grey(1e-4),
                          HenyeyGreenstein<double>{0.8},
                          {ExponentialProfile{30.0, 0.0}}});
  Medium plume;  // its density is the product of its profiles
  plume.species.push_back({"steam",
                           Spectrum::grey(0.05),
                           {},
                           MieMurky<double>{},
                           {SphereProfile{{40.0, 5.0, 0.0}, 8.0, 2.0}, NoiseProfile{4.0, 3, 0.6, 1, {1.0, 0.0, 0.0}}}});

  LoweredMedium lowered = lower(haze);
  add(lowered, plume, 2.5);  // as it is 2.5 s into the shot: media overlap by addition
  std::printf("%zu species, %zu lobes\n", lowered.species.size(), lowered.lobes.size());
  // [end]
}
