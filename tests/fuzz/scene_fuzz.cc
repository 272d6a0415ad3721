// Any bytes as a scene file, alone in its folder: read or refused with a message.
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "tests/fuzz/must.h"
#include "tyndall/scene/scene_file.h"

using namespace tyndall;
using fuzz::must;
namespace fs = std::filesystem;

namespace {

/// A folder in memory where there is one.
struct Folder {
  fs::path path;
  Folder() {
    std::string name = (fs::exists("/dev/shm") ? fs::path("/dev/shm") : fs::temp_directory_path()) / "tyndall-XXXXXX";
    must(::mkdtemp(name.data()) != nullptr, "a folder can be made");
    path = name;
  }
  ~Folder() { fs::remove_all(path); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Folder folder;
  const fs::path file = folder.path / "fuzz.scene.json";
  std::ofstream(file, std::ios::binary).write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
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
