#include <cstdio>

#include "tyndall/artist/medium_dials.h"

int main() {
  using namespace tyndall;
  // [models]
  TwoLobes smoke;
  smoke.r = 0.8;  // share of the second lobe
  smoke.g1 = -0.2, smoke.g2 = 0.6;
  smoke.thickness = MeanFreePath{Spectrum::grey(25.0)};
  smoke.albedo = Spectrum::grey(0.8);

  Measured radiation_fog;
  radiation_fog.air = Particles::fog;
  radiation_fog.visibility = 200.0;     // [m], at 550 nm
  radiation_fog.droplet_diameter = 10;  // [um]

  StatedSpecies soot;
  soot.name = "soot";
  soot.density = MassExtinction{Spectrum::grey(5e-6), Spectrum::grey(8.0)};  // [g/m^3], [m^2/g]
  soot.albedo = Spectrum::grey(0.2);
  soot.phase = HenyeyGreenstein<double>{0.47};

  for (const Conditions& model : {Conditions{smoke}, Conditions{radiation_fog}}) {
    const auto compiled = compile(MediumDials{Background{}, model, {soot}});
    const Medium& medium = std::get<Medium>(compiled);
    const Spectrum extinction = scattering_at(medium, {}) + absorption_at(medium, {});
    std::printf("visibility %.0f m, mean cosine %.3f (green)\n", visibility_of(extinction[1]),
                mean_cosine_at(medium, {})[1]);
  }
  // [end]
}
