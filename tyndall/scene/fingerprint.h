#pragma once
// A number that tells scenes apart: what stands beside samples on disk, so that they are never joined with another
// scene's.
#include <cstdint>

#include "tyndall/scene/scene.h"

namespace tyndall {

/// 64 bits of all that a picture of the scene depends on (geometry, materials, textures, lights, media with their
/// tables, camera, film, time), whatever files it came from. Not of names, warnings and Scene::integrator. The same
/// scene gives the same number in every run; two scenes that differ give different ones but for chance (2^-64).
std::uint64_t fingerprint(const Scene& scene);

}  // namespace tyndall
