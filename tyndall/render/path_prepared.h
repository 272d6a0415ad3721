#pragma once
// What a PathContext holds; for path*.cc only.
#include "tyndall/render/path.h"
#include "tyndall/render/path_lights.h"

namespace tyndall {

struct PathContext::Prepared {
  const Scene& scene;
  const Geometry& geometry;
  LoweredMedium medium;
  PathLights lights;
  int max_depth;
  double follow_through;
};

}  // namespace tyndall
