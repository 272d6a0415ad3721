#include "tyndall/document/preset.h"

#include <algorithm>

namespace tyndall {
namespace {

constexpr Preset all[] = {
#include "preset_list.inc"
};

}  // namespace

std::span<const Preset> presets() { return all; }

std::vector<std::string_view> preset_names() {
  std::vector<std::string_view> names;
  for (const Preset& preset : all) names.push_back(preset.name);
  return names;
}

const Preset* preset_named(std::string_view name) {
  const auto* const found =
      std::find_if(std::begin(all), std::end(all), [&](const Preset& p) { return p.name == name; });
  return found == std::end(all) ? nullptr : found;
}

std::string title_of(const Preset& preset) { return "preset " + std::string(preset.name); }

}  // namespace tyndall
