#pragma once
// The next sample of a pixel, by whichever integrator.
#include <memory>
#include <string>

#include "tyndall/render/film.h"
#include "tyndall/render/render.h"

namespace tyndall {

/// What adds samples to pixels. The next sample depends on the scene, the settings (integrator, seed, max_depth; of
/// `single` spp) and the pixel's place and number of samples alone: not on who takes it when.
class Sampler {
 public:
  /// Scene and geometry must outlive it. threads: how many may call add() at a time, each with a number of its own.
  static std::unique_ptr<Sampler> make(const Scene& scene, const Geometry& geometry, const RenderSettings& settings,
                                       int threads);
  virtual ~Sampler() = default;
  virtual void add(int x, int y, Pixel& pixel, int thread) = 0;
};

/// The samples that a pixel can have: spp, or one where it needs no averaging.
int most_samples(const RenderSettings& settings);

/// What the fixed quadratures of `single` are, for the picture's notes; empty for path.
std::string quadrature_text(const RenderSettings& settings);

}  // namespace tyndall
