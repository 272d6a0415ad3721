#include <cmath>
#include <cstdio>

#include "tyndall/artist/mix.h"

// [crossfade]
#include "tyndall/medium/lowered_medium.h"

// Two media in one, lowered once; each frame sets their shares in place: (1 - t) a + t b, the blend "mix".
class Crossfade {
 public:
  Crossfade(const tyndall::Medium& a, const tyndall::Medium& b) : whole_(lower(a)), begin_of_b_(whole_.species.size()) {
    add(whole_, b);
    now_ = whole_;
  }
  const tyndall::LoweredMedium& at(double t) {
    for (std::size_t i = 0; i < now_.species.size(); ++i) {
      const tyndall::LoweredSpecies& whole = whole_.species[i];
      tyndall::LoweredSpecies& now = now_.species[i];
      const double share = i < begin_of_b_ ? 1.0 - t : t;
      now.scattering = whole.scattering * share;
      now.absorption = whole.absorption * share;
      now.extinction = whole.extinction * share;
    }
    return now_;
  }

 private:
  tyndall::LoweredMedium whole_, now_;
  std::size_t begin_of_b_;
};
// [end]

namespace {
tyndall::MediumDials simple(double w, double visibility) {
  tyndall::Simple model;
  model.w = w;
  model.thickness = tyndall::Visibility{tyndall::Spectrum::grey(visibility)};
  return {tyndall::Background{}, model, {}};
}
}  // namespace

int main() {
  using namespace tyndall;
  const MediumDials a = simple(0.5, 8000.0), b = simple(0.9, 200.0);
  const Medium morning = std::get<Medium>(compile(a)), noon = std::get<Medium>(compile(b));
  double worst = 0.0;
  // [frames]
  Crossfade weather(morning, noon);
  std::vector<Stretch> stretches;
  const Ray ray{{0.0, 2.0, 0.0}, {1.0, 0.0, 0.0}};
  for (int frame = 0; frame <= 4; ++frame) {
    const double t = frame / 4.0;
    const Spectrum through = transmittance(weather.at(t), ray, 500.0, stretches);
    std::printf("t = %.2f: transmittance over 500 m %.4f (green)\n", t, through[1]);
  }
  // [end]
  for (int frame = 0; frame <= 4; ++frame) {
    const double t = frame / 4.0;
    const Spectrum through = transmittance(weather.at(t), ray, 500.0, stretches);
    const auto mixed = compile(std::get<MediumDials>(mix(a, b, t)));
    const LoweredMedium lowered = lower(std::get<Medium>(mixed));
    worst = std::fmax(worst, std::fabs(transmittance(lowered, ray, 500.0, stretches)[1] / through[1] - 1.0));
  }
  return worst < 1e-12 ? 0 : 1;
}
