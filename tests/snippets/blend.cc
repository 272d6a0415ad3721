#include <cstdio>

// [blend]
#include "tyndall/artist/morph.h"
#include "tyndall/medium/lowered_medium.h"

int main() {
  using namespace tyndall;
  Simple haze, fog;
  haze.w = 0.5, fog.w = 0.9;
  haze.thickness = Visibility{Spectrum::grey(8000.0)};
  fog.thickness = Visibility{Spectrum::grey(200.0)};
  const MediumDials morning{Background{}, haze, {}}, noon{Background{}, fog, {}};

  for (const double t : {0.0, 0.25, 0.5, 0.75, 1.0}) {
    const Blend between = morph(morning, noon, t);  // or interpolate, or mix
    if (const Objection* why = std::get_if<Objection>(&between)) return std::puts(why->found.c_str());
    const auto compiled = compile(std::get<MediumDials>(between));
    const LoweredMedium lowered = lower(std::get<Medium>(compiled));
    std::vector<Stretch> scratch;
    std::printf("t = %.2f: transmittance over 500 m %.4f (green)\n", t,
                transmittance(lowered, Ray{{0.0, 2.0, 0.0}, {1.0, 0.0, 0.0}}, 500.0, scratch)[1]);
  }
}
// [end]
