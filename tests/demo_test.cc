// The example scenes, as the program renders them: sound pixels, light in the air, and halos that grow with w.
#include <cmath>

#include "tests/program.h"
#include "tyndall/color/spectrum.h"
#include "tyndall/image/exr.h"

namespace tyndall::tests {
namespace {

const std::filesystem::path examples = std::filesystem::path(TYNDALL_SOURCE_DIR) / "examples";

class Demo : public ProgramTest {
 protected:
  Image picture(const std::string& scene, const std::string& options) const {
    const Outcome run =
        tyndall("render " + quoted(examples / (scene + ".scene.json")) + " --quiet -o picture.exr " + options);
    EXPECT_EQ(run.code, 0) << run.err;
    return read_exr(folder_ / "picture.exr");
  }
};

const std::vector<float>& plane(const Image& image, const char* name) { return find_plane(image, name)->values; }

/// Luminance of the beauty.
std::vector<double> luminances(const Image& image) {
  const auto rgb = find_layer(image, "");
  std::vector<double> out;
  for (std::size_t i = 0; i < image.pixel_count(); ++i) {
    out.push_back(luminance({{rgb[0]->values[i], rgb[1]->values[i], rgb[2]->values[i]}}));
  }
  return out;
}

double median_around(const std::vector<double>& values, int width, int height, int x, int y) {
  std::vector<double> near;
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      const int u = std::clamp(x + dx, 0, width - 1), v = std::clamp(y + dy, 0, height - 1);
      near.push_back(values[static_cast<std::size_t>(v * width + u)]);
    }
  }
  std::nth_element(near.begin(), near.begin() + 4, near.end());
  return near[4];
}

TEST_F(Demo, EveryScenesPixelsAreSoundAndItsAirIsSeen) {
  for (const char* scene : {"street", "room", "landscape"}) {
    SCOPED_TRACE(scene);
    const Image image = picture(scene, "--size 96x54 --spp 64");
    double scattered = 0.0, all = 0.0;
    for (const Plane& p : image.planes) {
      for (const float x : p.values) {
        ASSERT_TRUE(p.name == "depth.Z" || (std::isfinite(x) && x >= 0.0F)) << p.name << " " << x;
      }
    }
    const std::vector<double> light = luminances(image);
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) {
        const double here = light[static_cast<std::size_t>(y * image.width + x)];
        // Not where the pixel looks at a lamp: there it may outshine its neighbours by any factor.
        const bool lamp = plane(image, "surface.G")[static_cast<std::size_t>(y * image.width + x)] > 0.5 * here;
        EXPECT_TRUE(lamp || here <= 1000.0 * median_around(light, image.width, image.height, x, y)) << x << " " << y;
      }
    }
    for (std::size_t i = 0; i < image.pixel_count(); ++i) {
      scattered += plane(image, "single.G")[i] + plane(image, "multiple.G")[i];
      all += plane(image, "G")[i];
    }
    EXPECT_GT(scattered, 0.2 * all);
  }
}

TEST_F(Demo, TheStreetsAirGathersMoreLightAsWGrows) {
  double before = -1.0;
  for (const char* w : {"000", "050", "100"}) {
    const Image image =
        picture("street", "--size 96x54 --spp 8 --medium " +
                              quoted(examples / "media" / ("street_w" + std::string(w) + ".medium.json")));
    double scattered = 0.0;
    for (const float x : plane(image, "single.G")) scattered += x;
    EXPECT_GT(scattered, before) << "w = " << w;
    before = scattered;
  }
}

}  // namespace
}  // namespace tyndall::tests
