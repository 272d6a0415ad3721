#pragma once
// Where samples are gathered: per pixel, in double, in the order of their numbers.
#include <utility>
#include <vector>

#include "tyndall/image/image.h"
#include "tyndall/render/path.h"
#include "tyndall/render/single.h"

namespace tyndall {

/// Sums over the samples of one pixel.
struct Pixel {
  LightByOrder light;
  Spectrum beauty_squared, transmittance;
  double depth = infinity;  // [m], through the pixel's centre
  std::uint32_t samples = 0;
};

/// A pixel's mean beauty, and the variance of that mean per channel (unbiased; 0 for fewer than two samples).
inline Spectrum mean_beauty(const Pixel& p) { return p.light.sum() / static_cast<double>(std::max(1u, p.samples)); }
inline Spectrum variance_of_mean(const Pixel& p) {
  if (p.samples < 2) return {};
  const double n = p.samples;
  const Spectrum mean = mean_beauty(p);
  return map((p.beauty_squared / n - mean * mean) / (n - 1.0), [](double x) { return std::max(0.0, x); });
}

class SampleFilm {
 public:
  SampleFilm(int width, int height)
      : width_(width), height_(height), pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {}
  int width() const { return width_; }
  int height() const { return height_; }
  Pixel& at(int x, int y) {
    return pixels_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)];
  }

  std::vector<Pixel>& pixels() { return pixels_; }  // row by row
  const std::vector<Pixel>& pixels() const { return pixels_; }

  /// Adds the next sample of a pixel.
  static void add(Pixel& pixel, const PathSample& sample) {
    const Spectrum beauty = sample.light.sum();
    pixel.light += sample.light;
    pixel.beauty_squared += beauty * beauty;
    pixel.transmittance += sample.transmittance;
    ++pixel.samples;
  }
  /// Sets a pixel to a value that needs no averaging.
  static void set(Pixel& pixel, const PixelLayers& layers) {
    pixel = {{layers.surface, layers.single, {}, {}, {}}, {}, layers.transmittance, layers.depth, 1};
    pixel.beauty_squared = mean_beauty(pixel) * mean_beauty(pixel);
  }

  /// Least and most samples of any pixel.
  std::pair<std::uint32_t, std::uint32_t> samples_taken() const;

  /// Mean over the pixels of standard error / (value + 2 % of the picture's mean), in luminance: how noisy it looks, at
  /// most: even samples (RandomStream) do better than the independent ones that this supposes.
  double noise() const;

  /// The layers of an image file: beauty, single, surface, multiple, order1, order2, order3, transmittance, depth.Z,
  /// variance. Pixels without samples are black; what a float cannot hold is its largest value.
  Image develop() const;

 private:
  int width_, height_;
  std::vector<Pixel> pixels_;
};

}  // namespace tyndall
