#include <cstdio>
#include <variant>

// [dials]
#include "tyndall/artist/medium_dials.h"

// Sea fog at dawn: half a kilometre of visibility, between hazy and murky, thinning with height.
std::variant<tyndall::Medium, tyndall::Objection> harbour_fog(double visibility) {
  tyndall::Simple fog;
  fog.w = 0.7;
  fog.thickness = tyndall::Visibility{tyndall::Spectrum::grey(visibility)};
  fog.hold = tyndall::Hold::visibility;  // of the finished medium: air and veil are taken off
  fog.veil = tyndall::Veil{tyndall::PlainExtinction{tyndall::Spectrum::grey(1e-4)}};
  fog.profile = tyndall::ExponentialProfile{30.0, 0.0};  // scale height, base [m]

  tyndall::MediumDials dials;
  dials.background = tyndall::Background{};  // the note's air
  dials.conditions = fog;
  return tyndall::compile(dials);
}
// [end]

int main() {
  using tyndall::Medium, tyndall::Objection;
  // [answers]
  const auto fog = harbour_fog(500.0);
  if (const Medium* medium = std::get_if<Medium>(&fog)) {
    for (const tyndall::Species& s : medium->species) {
      std::printf("%-6s scatters %.3e 1/m, mean cosine %.3f\n", s.name.c_str(), s.scattering[1],
                  tyndall::mean_cosine(s.phase));
    }
  }
  const auto impossible = harbour_fog(300e3);
  if (const Objection* why = std::get_if<Objection>(&impossible)) {
    std::printf("%s: %s;\n  possible: %s\n", why->field.c_str(), why->found.c_str(), why->expected.c_str());
  }
  // [end]
}
