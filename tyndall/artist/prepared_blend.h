#pragma once
// Blends for every frame: made ready once, then computed in place.
#include <algorithm>
#include <utility>
#include <variant>
#include <vector>

#include "tyndall/artist/blended.h"
#include "tyndall/medium/lowered_frame.h"

namespace tyndall {

/// A blend of two media (blended.h) as constants for rays: at(t) is what lower(compile(blended(a, b, t, how))) gives,
/// to rounding, at the ends too, and allocates nothing. Species that do nothing at some t stay in the list with
/// coefficients of 0, so that it has the same length always.
class PreparedBlend {
 public:
  /// Dials in SI. Objects where blended() does half way, and to ends that are no media.
  static std::variant<PreparedBlend, Objection> of(const MediumDials& a, const MediumDials& b, BlendHow how) {
    for (const MediumDials* end : {&a, &b}) {
      const auto compiled = compile(*end);
      if (const auto* objection = std::get_if<Objection>(&compiled)) return *objection;
    }
    PreparedBlend out;
    out.how_ = how;
    std::optional<Objection> objection;
    if (how == BlendHow::interpolate) objection = out.prepare_interpolation(a, b);
    if (how == BlendHow::mix) objection = out.prepare_mix(a, b);
    if (how == BlendHow::morph) objection = out.prepare_morph(a, b);
    if (objection) return *objection;
    // Everything grows to what it needs.
    for (const double t : {0.0, 0.25, 0.5, 0.75, 1.0}) out.at(t);
    return out;
  }

  /// The medium at t in [0, 1], with the wind of a time [s]. Valid until the next call.
  const LoweredMedium& at(double t, double time = 0.0) {
    if (how_ == BlendHow::interpolate) {
      set_between(now_, from_, to_, t);
      keep_in_reach();
    } else if (how_ == BlendHow::mix) {
      if (now_.background) set_between(now_.background, from_.background, to_.background, t);
      for (std::size_t i = 0; i < now_.species.size(); ++i) {
        const double share = i < begin_of_b_ ? 1.0 - t : t;
        now_.species[i].scattering = *from_.species[i].scattering * share;
        now_.species[i].absorption = *from_.species[i].absorption * share;
      }
    } else {
      pair_.set(t, now_);
    }
    compile_frame(now_, time, frame_);
    return frame_.medium();
  }

 private:
  PreparedBlend() = default;

  std::optional<Objection> prepare_interpolation(MediumDials a, MediumDials b) {
    if (auto objection = blending::align(a, b, 1.0)) return objection;
    for (MediumDials* dials : {&a, &b}) {
      // A number that keep_in_reach() can change.
      if (Simple* held = held_in(*dials)) held->thickness = PlainExtinction{extinction_of(held->thickness)};
    }
    from_ = std::move(a);
    to_ = std::move(b);
    now_ = from_;
    return std::nullopt;
  }

  std::optional<Objection> prepare_mix(const MediumDials& a, const MediumDials& b) {
    std::optional<Background> air_of_a = a.background, air_of_b = b.background;
    const bool one_air = blending::one_air(air_of_a, air_of_b);
    now_.channels = a.channels;
    if (one_air) now_.background = air_of_a;
    for (const MediumDials* dials : {&a, &b}) {
      auto species = blending::as_species(*dials, one_air);
      if (const auto* objection = std::get_if<Objection>(&species)) return *objection;
      begin_of_b_ = now_.species.size();
      for (StatedSpecies& s : *std::get_if<0>(&species)) now_.species.push_back(std::move(s));
    }
    from_ = now_;
    to_ = now_;
    if (one_air) to_.background = air_of_b;
    return std::nullopt;
  }

  std::optional<Objection> prepare_morph(const MediumDials& a, const MediumDials& b) {
    auto made = blending::morph_pair(a, b);
    if (const auto* objection = std::get_if<Objection>(&made)) return *objection;
    pair_ = std::move(*std::get_if<blending::MorphPair>(&made));
    now_ = pair_.skeleton(a.channels);
    return std::nullopt;
  }

  static Simple* held_in(MediumDials& dials) {
    Simple* const simple = dials.conditions ? std::get_if<Simple>(&*dials.conditions) : nullptr;
    return simple != nullptr && simple->hold ? simple : nullptr;
  }

  /// What blending::keep_in_reach() does, in place: the frame is filled with all but the conditions first.
  void keep_in_reach() {
    Simple* const simple = held_in(now_);
    if (simple == nullptr) return;
    auto& thickness = std::get_if<PlainExtinction>(&simple->thickness)->extinction;
    const double rest = rest_in_green(*simple, extinction_of_others()), stated = thickness[visibility_channel];
    if (rest > stated && stated > 0.0) thickness *= rest / stated;
  }
  Spectrum extinction_of_others() {
    others_.begin(0.0);
    if (now_.background) compile(*now_.background, wavelengths_of(now_.channels), others_);
    for (const StatedSpecies& s : now_.species) compile(s, others_);
    return others_.extinction_at_origin();
  }

  BlendHow how_ = BlendHow::interpolate;
  MediumDials from_, to_, now_;
  std::size_t begin_of_b_ = 0;
  blending::MorphPair pair_;
  LoweredFrame frame_, others_;
};

}  // namespace tyndall
