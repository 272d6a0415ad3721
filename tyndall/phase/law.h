#pragma once
// The list of laws (phase functions), and what every law offers.
#include <algorithm>
#include <array>
#include <variant>

#include "tyndall/phase/cornette_shanks.h"
#include "tyndall/phase/draine.h"
#include "tyndall/phase/droplet.h"
#include "tyndall/phase/fournier_forand.h"
#include "tyndall/phase/henyey_greenstein.h"
#include "tyndall/phase/isotropic.h"
#include "tyndall/phase/lambert_sphere.h"
#include "tyndall/phase/mie_hazy.h"
#include "tyndall/phase/mie_murky.h"
#include "tyndall/phase/mixture.h"
#include "tyndall/phase/nishita_murky.h"
#include "tyndall/phase/rayleigh.h"
#include "tyndall/phase/schlick.h"
#include "tyndall/phase/sum_inverse.h"
#include "tyndall/phase/tabulated.h"

namespace tyndall {

/// The closed list. A new law is a header and a line here; files, command line, dials, shaders and tests follow.
template <class T>
using Law = std::variant<Isotropic<T>,         //
                         Rayleigh<T>,          //
                         HenyeyGreenstein<T>,  //
                         MieHazy<T>,           //
                         MieMurky<T>,          //
                         NishitaMurky<T>,      //
                         Schlick<T>,           //
                         CornetteShanks<T>,    //
                         Draine<T>,            //
                         Droplet<T>,           //
                         LambertSphere<T>,     //
                         FournierForand<T>,    //
                         Tabulated<T>,         //
                         Mixture<T>>;

template <class T>
struct MixturePart {
  T weight = T(1.0);
  Law<T> phase;
  static constexpr auto fields() {
    return std::tuple{
        Field{"weight", &MixturePart::weight, not_negative, "1", "Share of this part, relative to the others."},
        Field{"phase", &MixturePart::phase, any_number, "", "The part's law.", Scaling::none, true}};
  }
};

/// The lobes a law stands for.
template <class T>
LobeSum<T> lower(const Law<T>& law) {
  return std::visit([](const auto& l) { return l.lower(); }, law);
}

template <class T>
LobeSum<T> Mixture<T>::lower() const {
  T total(0.0);
  for (const auto& part : parts) total = total + part.weight;
  total = named("total", total);
  LobeSum<T> out;
  for (const auto& part : parts) {
    const T share = named("share", part.weight / total);
    for (const auto& inner : tyndall::lower<T>(part.phase))
      out.push_back({named("weight", inner.weight * share), inner.lobe});
  }
  return out;
}

/// Samples a law exactly and monotonically: the law's own inverse where it has one, else that of its sum of lobes.
template <class T>
Deflection<T> sample(const Law<T>& law, const T& xi) {
  return std::visit(
      [&](const auto& l) {
        if constexpr (requires { l.sample(xi); }) {
          return l.sample(xi);
        } else {
          return sample(l.lower(), xi);
        }
      },
      law);
}

/// Whether a law differs from channel to channel (tables can).
template <class T>
bool is_chromatic(const Law<T>& law) {
  if (const auto* mixture = std::get_if<Mixture<T>>(&law)) {
    return std::any_of(mixture->parts.begin(), mixture->parts.end(),
                       [](const MixturePart<T>& part) { return is_chromatic<T>(part.phase); });
  }
  const auto* const table = std::get_if<Tabulated<T>>(&law);
  return table != nullptr && table->is_chromatic();
}

/// The law of one channel.
template <class T>
Law<T> in_channel(const Law<T>& law, std::size_t channel) {
  if (const auto* table = std::get_if<Tabulated<T>>(&law); table != nullptr && table->is_chromatic())
    return table->in_channel(channel);
  Law<T> out = law;
  if (auto* mixture = std::get_if<Mixture<T>>(&out)) {
    for (MixturePart<T>& part : mixture->parts) part.phase = in_channel<T>(part.phase, channel);
  }
  return out;
}

/// Sums of lobes per channel.
template <class T>
std::array<LobeSum<T>, channel_count> lower_channels(const Law<T>& law) {
  std::array<LobeSum<T>, channel_count> out;
  const bool chromatic = is_chromatic(law);
  if (!chromatic) out.fill(lower(law));
  for (std::size_t c = 0; chromatic && c < channel_count; ++c) out[c] = lower(in_channel(law, c));
  return out;
}

template <class T>
T density(const Law<T>& law, const Deflection<T>& d) {
  return density(lower(law), d);
}
template <class T>
T cdf(const Law<T>& law, const Deflection<T>& d) {
  return cdf(lower(law), d);
}
template <class T>
T survival(const Law<T>& law, const Deflection<T>& d) {
  return survival(lower(law), d);
}
template <class T>
T moment(const Law<T>& law, int l) {
  return moment(lower(law), l);
}
template <class T>
T mean_cosine(const Law<T>& law) {
  return moment(law, 1);
}

}  // namespace tyndall
