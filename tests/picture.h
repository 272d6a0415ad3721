#pragma once
// What every picture that the program writes must be, for tests.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "tyndall/image/exr.h"

namespace tyndall::tests {

/// Checks that a picture can be read and has no value that is negative or not finite (where nothing is hit, depth is
/// infinite). Returns the mean of its beauty over pixels and channels.
inline double check_picture(const std::filesystem::path& file) {
  const Image image = read_exr(file);
  double light = 0.0;
  for (const Plane& plane : image.planes) {
    std::size_t bad = 0;
    for (const float x : plane.values) {
      const bool open_sky = plane.name == "depth.Z" && x > 0.0F && std::isinf(x);
      if (!(x >= 0.0F && std::isfinite(x)) && !open_sky) ++bad;
    }
    EXPECT_EQ(bad, 0u) << "in " << plane.name << " of " << file;
    if (plane.name.size() == 1) {
      for (const float x : plane.values) light += x;
    }
  }
  return light / (3.0 * static_cast<double>(image.pixel_count()));
}

}  // namespace tyndall::tests
