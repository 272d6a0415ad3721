#include "tyndall/render/film.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tyndall {
namespace {

/// What a float cannot hold (a lamp in the camera, the variance of something very bright) is its largest value.
float as_float(double x) {
  constexpr float largest = std::numeric_limits<float>::max();
  return x > largest ? largest : static_cast<float>(x);
}

}  // namespace

std::pair<std::uint32_t, std::uint32_t> SampleFilm::samples_taken() const {
  const auto [least, most] = std::minmax_element(pixels_.begin(), pixels_.end(),
                                                 [](const Pixel& a, const Pixel& b) { return a.samples < b.samples; });
  return {least->samples, most->samples};
}

double SampleFilm::noise() const {
  double mean = 0.0;
  for (const Pixel& p : pixels_) mean += luminance(mean_beauty(p)) / static_cast<double>(pixels_.size());
  if (!(mean > 0.0)) return 0.0;
  double noise = 0.0;
  for (const Pixel& p : pixels_) {
    const double error = luminance(map(variance_of_mean(p), [](double x) { return std::sqrt(x); }));
    noise += error / (luminance(mean_beauty(p)) + 0.02 * mean);
  }
  return noise / static_cast<double>(pixels_.size());
}

Image SampleFilm::develop() const {
  Image image{width_, height_, {}, {}};
  const std::size_t beauty = add_layer(image, ""), single = add_layer(image, "single"),
                    surface = add_layer(image, "surface"), multiple = add_layer(image, "multiple"),
                    once = add_layer(image, "order1"), twice = add_layer(image, "order2"),
                    more = add_layer(image, "order3"), transmittance = add_layer(image, "transmittance"),
                    variance = add_layer(image, "variance"), depth = add_plane(image, "depth", "Z");
  for (std::size_t i = 0; i < pixels_.size(); ++i) {
    const Pixel& p = pixels_[i];
    const double n = std::max(1u, p.samples);
    const auto put = [&](std::size_t layer, const Spectrum& x) {
      for (std::size_t c = 0; c < 3; ++c) image.planes[layer + c].values[i] = as_float(x[c]);
    };
    put(beauty, mean_beauty(p));
    put(single, p.light.single / n);
    put(surface, p.light.surface / n);
    put(multiple, p.light.multiple() / n);
    put(once, p.light.once() / n);
    put(twice, p.light.twice / n);
    put(more, p.light.more / n);
    put(transmittance, p.transmittance / n);
    put(variance, variance_of_mean(p));
    image.planes[depth].values[i] = p.depth == infinity ? std::numeric_limits<float>::infinity() : as_float(p.depth);
  }
  return image;
}

}  // namespace tyndall
