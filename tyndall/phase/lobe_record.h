#pragma once
// A lobe as plain numbers: what crosses from the program to a kernel, whose object shares no types with it.
#include "tyndall/phase/lobe_sum.h"

namespace tyndall {

/// `kind` is the lobe's index in the Lobe list; parameters in the order of its members.
struct LobeRecord {
  int kind;
  float weight;
  float parameters[4];
};

static_assert(std::variant_size_v<Lobe<float>> == 4, "a new lobe needs a line in both directions below");

template <class T>
LobeRecord lobe_record(const WeightedLobe<T>& part) {
  LobeRecord record{static_cast<int>(part.lobe.index()), static_cast<float>(part.weight), {}};
  if (const auto* rayleigh = std::get_if<RayleighLobe<T>>(&part.lobe)) {
    record.parameters[0] = static_cast<float>(rayleigh->gamma);
  } else if (const auto* hg = std::get_if<HenyeyGreensteinLobe<T>>(&part.lobe)) {
    record.parameters[0] = static_cast<float>(hg->g);
    record.parameters[1] = static_cast<float>(hg->complement);
  } else if (const auto* power = std::get_if<PowerLobe<T>>(&part.lobe)) {
    record.parameters[0] = static_cast<float>(power->n);
  }
  return record;
}

/// The lobe in another number, its parameters the same in every lane.
template <class T>
Lobe<T> lobe_of(const LobeRecord& record) {
  const T a(record.parameters[0]), b(record.parameters[1]);
  switch (record.kind) {
    case 1:
      return RayleighLobe<T>{a};
    case 2:
      return HenyeyGreensteinLobe<T>{a, b};
    case 3:
      return PowerLobe<T>{static_cast<int>(record.parameters[0])};
    default:
      return IsotropicLobe<T>{};
  }
}

}  // namespace tyndall
