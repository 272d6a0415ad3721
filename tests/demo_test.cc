// The example scenes, as the program renders them: sound pixels, light in the air, and halos that grow with w.
#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/program.h"
#include "tyndall/color/spectrum.h"
#include "tyndall/image/exr.h"
#include "tyndall/render/camera.h"
#include "tyndall/scene/geometry.h"
#include "tyndall/scene/scene_file.h"

namespace tyndall::tests {
namespace {

namespace fs = std::filesystem;
const fs::path examples = std::filesystem::path(TYNDALL_SOURCE_DIR) / "examples";

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

std::vector<Vector> lamp_positions(const Scene& scene) {
  std::vector<Vector> places;
  for (const PointLight& light : scene.points) places.push_back(light.position);
  for (const SpotLight& light : scene.spots) places.push_back(light.position);
  return places;
}

/// For each pixel whether it is within `margin` pixels of one that sees a lamp, the sun, or a surface that glows.
std::vector<bool> near_lights(const Scene& scene, int margin) {
  const auto& [width, height] = scene.film;
  const Geometry geometry(scene);
  const CameraRays camera(scene.camera, scene.film);
  const auto is_light = [&](double x, double y) {
    const Ray ray = camera.through(x, y);
    const double half_pixel = 0.71 * length(camera.through(x + 0.25, y).direction - ray.direction);
    const auto hit = geometry.intersect(ray);
    if (hit && hit->material != nullptr && !is_zero(hit->material->emission)) return true;
    for (const Vector& lamp : lamp_positions(scene)) {
      if (length(normalized(lamp - ray.origin) - ray.direction) < half_pixel) return true;
    }
    return !hit && std::ranges::any_of(scene.suns, [&](const SunLight& sun) {
      return length(sun.direction + ray.direction) < half_pixel + 0.5 * sun.angular_diameter * std::numbers::pi / 180.0;
    });
  };
  std::vector<bool> near(static_cast<std::size_t>(width * height), false);
  for (int k = 0; k < 16 * width * height; ++k) {  // 4 x 4 places in each pixel
    const int x = k % (4 * width), y = k / (4 * width);
    if (!is_light((x + 0.5) / 4.0, (y + 0.5) / 4.0)) continue;
    for (int v = std::max(0, y / 4 - margin); v <= std::min(height - 1, y / 4 + margin); ++v) {
      for (int u = std::max(0, x / 4 - margin); u <= std::min(width - 1, x / 4 + margin); ++u) {
        near[static_cast<std::size_t>(v * width + u)] = true;
      }
    }
  }
  return near;
}

/// How far from the middle of the picture [pixels] its scattered light has a luminance of at least `least`, by the
/// median around rings.
int halo_radius(const Image& image, double least) {
  const auto single = find_layer(image, "single"), multiple = find_layer(image, "multiple");
  std::vector<std::vector<double>> rings(static_cast<std::size_t>(image.width / 2));
  for (std::size_t i = 0; i < image.pixel_count(); ++i) {
    const int x = static_cast<int>(i) % image.width, y = static_cast<int>(i) / image.width;
    const auto r = static_cast<std::size_t>(std::hypot(x + 0.5 - 0.5 * image.width, y + 0.5 - 0.5 * image.height));
    Spectrum light;
    for (std::size_t c = 0; c < 3; ++c) light[c] = single[c]->values[i] + multiple[c]->values[i];
    if (r < rings.size()) rings[r].push_back(luminance(light));
  }
  int radius = 0;
  for (auto& ring : rings) {
    std::ranges::nth_element(ring, ring.begin() + static_cast<std::ptrdiff_t>(ring.size() / 2));
    if (ring[ring.size() / 2] < least) break;
    ++radius;
  }
  return radius;
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
    Scene seen = read_scene(examples / (std::string(scene) + ".scene.json"));
    seen.film = {image.width, image.height};
    const std::vector<bool> near = near_lights(seen, 2);
    EXPECT_LT(std::count(near.begin(), near.end(), true), 0.5 * static_cast<double>(near.size()));
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) {
        const double here = light[static_cast<std::size_t>(y * image.width + x)];
        // Not where a lamp is: there it may outshine its neighbours by any factor.
        const bool lamp = near[static_cast<std::size_t>(y * image.width + x)];
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

TEST_F(Demo, TheHaloOfAStreetLampWidensAsWGrows) {
  const Scene street = read_scene(examples / "street.scene.json");
  // The lamp on the left, which stands free of the facades, from where the camera of the street is.
  Vector lamp = lamp_positions(street).front();
  for (const Vector& place : lamp_positions(street)) {
    if (length(place - Vector{-2.8, 7.1, -19.8}) < length(lamp - Vector{-2.8, 7.1, -19.8})) lamp = place;
  }
  ASSERT_LT(length(lamp - Vector{-2.8, 7.1, -19.8}), 2.0);
  const Vector eye = street.camera.position;
  nlohmann::json scene = nlohmann::json::parse(text_of(examples / "street.scene.json"));
  scene.erase("medium");
  scene["geometry"] = {fs::absolute(examples / "geometry" / "street.glb").string()};
  scene["camera"] = {{"position", {eye.x, eye.y, eye.z}}, {"look_at", {lamp.x, lamp.y, lamp.z}}, {"vertical_fov", 16}};
  write("lamp.scene.json", scene.dump());
  std::vector<int> radii;
  for (const char* w : {"000", "050", "100"}) {
    const Outcome run =
        tyndall("render lamp.scene.json --allow-path --quiet --size 64x64 --spp 24 -o lamp.exr --medium " +
                quoted(examples / "media" / ("street_w" + std::string(w) + ".medium.json")));
    ASSERT_EQ(run.code, 0) << run.err;
    // A luminance that the picture shows as a middle grey: what the eye takes for the edge of the glow.
    radii.push_back(halo_radius(read_exr(folder_ / "lamp.exr"), 0.25));
  }
  // A quarter of a degree each. With the same thickness at w = 0.5 and 1 the step would be of a third only.
  EXPECT_LE(radii[0], 1);
  EXPECT_GE(radii[1], 4) << radii[0];
  EXPECT_GE(radii[2], 3 * radii[1] / 2 + 1) << radii[1];
  EXPECT_LT(radii[2], 31) << "it fills the picture";
  RecordProperty("radii", std::to_string(radii[0]) + " " + std::to_string(radii[1]) + " " + std::to_string(radii[2]));
}

}  // namespace
}  // namespace tyndall::tests
