#include <cmath>
#include <cstdio>

// [prepared]
#include "tyndall/artist/prepared_blend.h"

// Made once, between shots: haze that becomes thick fog, as the eye judges it.
std::variant<tyndall::PreparedBlend, tyndall::Objection> fog_rolls_in() {
  using namespace tyndall;
  Simple haze, fog;
  haze.w = 0.5, fog.w = 0.9;
  haze.thickness = Visibility{Spectrum::grey(8000.0)};
  fog.thickness = Visibility{Spectrum::grey(200.0)};
  haze.profile = ExponentialProfile{200.0, 0.0}, fog.profile = ExponentialProfile{30.0, 0.0};
  return PreparedBlend::of({Background{}, haze, {}}, {Background{}, fog, {}}, BlendHow::morph);
}
// [end]

int main() {
  using namespace tyndall;
  // [frames]
  auto made = fog_rolls_in();
  auto* weather = std::get_if<PreparedBlend>(&made);
  if (weather == nullptr) return std::puts(std::get_if<Objection>(&made)->found.c_str());

  std::vector<Stretch> stretches;  // kept, as everywhere
  const Ray ray{{0.0, 2.0, 0.0}, {1.0, 0.0, 0.0}};
  for (int frame = 0; frame <= 4; ++frame) {
    const double t = frame / 4.0, seconds = frame / 24.0;  // the time is for noise in the wind
    const LoweredMedium& now = weather->at(t, seconds);    // no allocation; until the next call
    const Spectrum through = transmittance(now, ray, 500.0, stretches);
    std::printf("t = %.2f: transmittance over 500 m %.4f (green)\n", t, through[1]);
  }
  // [end]
}
