#pragma once
// What a PathContext holds; for path*.cc only.
#include "tyndall/render/dense_air.h"
#include "tyndall/render/path.h"
#include "tyndall/render/path_lights.h"
#include "tyndall/render/sun_beams.h"

namespace tyndall {

struct PathContext::Prepared {
  const Scene& scene;
  const Geometry& geometry;
  LoweredMedium medium;
  PathLights lights;
  int max_depth;
  double follow_through;
  std::vector<SunBeams> beams;  // one for each sun, or none: before PathContext::learn, and where they are of no use
  bool winding;                 // whether following a ray through the medium may take many pieces
  DenseAir dense_air;
};

}  // namespace tyndall
