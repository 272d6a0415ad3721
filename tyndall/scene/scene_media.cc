#include "tyndall/scene/scene_media.h"

namespace tyndall {

Medium medium_at(const SceneMedia& media, double time, Grids grids) {
  Medium out;
  for (const PlacedMedium& placed : media) {
    MediumFile now = at_time(placed.file, time, placed.name_for_messages);
    set_grid_time(now, time, grids);
    std::vector<Profile> profiles = placed.profiles;
    set_grid_time(profiles, time, grids);
    for (Species& species : compile(now, placed.name_for_messages).species) {
      species.profiles.insert(species.profiles.end(), profiles.begin(), profiles.end());
      out.species.push_back(std::move(species));
    }
  }
  return out;
}

std::vector<double> key_times(const SceneMedia& media) {
  std::vector<double> out;
  for (const PlacedMedium& placed : media) {
    if (!placed.file.keyframes) continue;
    for (const Keyframe& key : *placed.file.keyframes) out.push_back(key.time);
  }
  return out;
}

}  // namespace tyndall
