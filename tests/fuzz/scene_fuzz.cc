// Any bytes as a scene file, alone in its folder: read or refused with a message.
#include "tests/fuzz/folder.h"
#include "tyndall/scene/scene_file.h"

using namespace tyndall;
using fuzz::must;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::Folder folder;
  const auto file = folder.write("fuzz.scene.json", {reinterpret_cast<const char*>(data), size});
  try {
    const Scene scene = read_scene(file);
    must(is_finite(scene.camera.position) && is_finite(scene.camera.look_at), "the camera is somewhere");
    must(scene.film.width >= 1 && scene.film.height >= 1, "the film has pixels");
    for (const Species& s : scene.medium.species) {
      must(is_finite(s.extinction()) && smallest(s.scattering) >= 0.0 && smallest(s.absorption) >= 0.0, "admissible");
    }
    for (const SpotLight& s : scene.spots) must(std::fabs(length(s.direction) - 1.0) < 1e-9, "a unit direction");
    for (const SunLight& s : scene.suns) must(std::fabs(length(s.direction) - 1.0) < 1e-9, "a unit direction");
  } catch (const Fault& fault) {
    fuzz::must_be_a_message(fault);
  }
  return 0;
}
