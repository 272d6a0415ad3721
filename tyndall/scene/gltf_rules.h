#pragma once
// What glTF 2.0 asks of the JSON: types, indices and what must be there, for the parts that the reader uses.
//
// tinygltf skips much of what has the wrong type as if it were not there, and gives no places for what it refuses. Half
// a scene without a word would be no help; so the JSON is checked before tinygltf sees it.
#include "tyndall/scene/gltf_model.h"

namespace tyndall {

/// Throws the Fault about the first value that breaks the rules, with its pointer and, in a .gltf, its line.
void check_gltf_rules(const GltfModel& gltf);

}  // namespace tyndall
