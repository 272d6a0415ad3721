#pragma once
// Making a picture of a scene.
#include <atomic>
#include <functional>
#include <string>

#include "tyndall/image/image.h"
#include "tyndall/scene/geometry.h"
#include "tyndall/scene/scene.h"

namespace tyndall {

struct RenderSettings {
  std::string integrator = "path";  // one of integrator_names
  int spp = 64;                     // samples per pixel, > 0
  int max_depth = 0;                // 0: no limit (path only)
  int threads = 0;                  // 0: all; the picture does not depend on it
  std::uint64_t seed = 1;
  std::uint32_t tile_order = 0;  // 0: by rows; otherwise shuffled by this number, with the same picture
};

struct RenderProgress {
  double fraction, seconds, noise;  // noise: SampleFilm::noise (film.h), 0 when unknown
  int spp;                          // samples that every pixel has
};

/// Renders scene.film with scene.camera. `report` is called now and then from the calling thread; when `stop` becomes
/// true the picture is returned as it is, every pixel with the samples it has. The picture's notes say how it was made.
Image render(const Scene& scene, const Geometry& geometry, const RenderSettings& settings,
             const std::function<void(const RenderProgress&)>& report = {}, const std::atomic<bool>* stop = nullptr);

}  // namespace tyndall
