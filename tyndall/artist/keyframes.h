#pragma once
// Conditions that change in time: keys, and what stands between them.
#include <algorithm>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "tyndall/artist/blended.h"

namespace tyndall {

/// The most keyframes of a medium: nearly three minutes with one for every picture.
inline constexpr std::size_t most_keyframes = 4096;

/// Complete conditions at a time, and how those of the key before turn into them.
struct Keyframe {
  static constexpr std::string_view text = "The weather at a time.";
  double time = 0.0;
  Conditions conditions;
  BlendHow transition = BlendHow::interpolate;
  static constexpr auto fields() {
    return std::tuple{
        Field{"time", &Keyframe::time, Range{-1e9, 1e9}, "s", "When the conditions are these.", Scaling::none, true},
        Field{"conditions", &Keyframe::conditions, any_number, "", "The weather then, complete, by one of the models.",
              Scaling::none, true},
        Field{"transition", &Keyframe::transition, any_number, "",
              "How the weather of the key before turns into this one; of the first key it means nothing."}};
  }
};
using Keyframes = std::vector<Keyframe>;

/// There is at least one key, not too many, and their times rise. The field is a path below a medium.
inline std::optional<Objection> objection_to_keys(const Keyframes& keys) {
  if (keys.empty()) return Objection{"keyframes", "no keyframes", "at least one"};
  if (keys.size() > most_keyframes) {
    return Objection{"keyframes", std::to_string(keys.size()) + " keyframes",
                     "at most " + std::to_string(most_keyframes)};
  }
  for (std::size_t i = 1; i < keys.size(); ++i) {
    if (keys[i].time > keys[i - 1].time) continue;
    return Objection{"keyframes/" + std::to_string(i) + "/time",
                     "the time " + short_number(keys[i].time) + " s, not after the one before, " +
                         short_number(keys[i - 1].time) + " s",
                     "times that rise from key to key"};
  }
  return std::nullopt;
}

/// Where a time [s] stands among keys, of which there is at least one: at `share` of the way from one to the next.
/// Before the first and after the last key it stands at that one: from == to, share 0.
struct KeyInterval {
  std::size_t from, to;
  double share;
};
inline KeyInterval interval_at(const Keyframes& keys, double time) {
  const auto after =
      std::upper_bound(keys.begin(), keys.end(), time, [](double t, const Keyframe& key) { return t < key.time; });
  if (after == keys.begin()) return {0, 0, 0.0};
  const auto to = static_cast<std::size_t>(after - keys.begin()), from = to - 1;
  if (after == keys.end()) return {from, from, 0.0};
  return {from, to, (time - keys[from].time) / (keys[to].time - keys[from].time)};
}

/// An objection to the conditions of a medium, as one to those of a key.
inline Objection of_key(Objection objection, std::size_t key) {
  if (objection.field.rfind("conditions", 0) == 0) {
    objection.field = "keyframes/" + std::to_string(key) + '/' + objection.field;
  }
  return objection;
}

/// The dials at a time [s]: `dials`, whose own conditions do not count, with those of `keys`, of which there is at
/// least one; everything is in units of `meters_per_unit` metres. Exactly those of a key at its time, and those of the
/// first and the last key before and after all. Objects to keys that do not blend as the later one says.
inline Blend dials_at(const MediumDials& dials, const Keyframes& keys, double time, double meters_per_unit = 1.0) {
  const auto with = [&](std::size_t key) {
    MediumDials out = dials;
    out.conditions = keys[key].conditions;
    return out;
  };
  const auto [from, to, share] = interval_at(keys, time);
  if (share == 0.0) return with(from);
  const BlendHow how = keys[to].transition;
  Blend blend = blended(with(from), with(to), share, how, meters_per_unit);
  if (auto* objection = std::get_if<Objection>(&blend)) {
    *objection = of_key(std::move(*objection), to);
    if (how == BlendHow::interpolate) {
      objection->expected = "keys made alike, or \"transition\": \"mix\" or \"morph\", which take any two";
    }
  }
  return blend;
}

}  // namespace tyndall
