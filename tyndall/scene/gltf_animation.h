#pragma once
// Where glTF animations put nodes at a time.
#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "tyndall/geometry/vector.h"
#include "tyndall/scene/gltf_model.h"

namespace tyndall {

/// What animations say of a node; the rest is as the node itself says.
struct NodePose {
  std::optional<Vector> translation, scale;
  std::optional<std::array<double, 4>> rotation;  // x, y, z, w
};

/// The poses at a time [s] of all nodes that animations move, by index: glTF 2.0, section 3.11 and appendix C. All
/// animations of the file run at once, from its time 0; before its first and after its last key a node stays. Throws
/// Fault for keys that are none. Adds to `ignored` what is not followed: morph targets, a second animation of the same
/// thing, extensions.
std::map<std::size_t, NodePose> poses_at(const GltfModel& gltf, double time, std::set<std::string>& ignored);

}  // namespace tyndall
