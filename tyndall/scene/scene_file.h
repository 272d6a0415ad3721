#pragma once
// Reading scenes: *.scene.json, or a .glb / .gltf alone.
#include <filesystem>
#include <optional>

#include "tyndall/document/fault.h"
#include "tyndall/scene/scene.h"
#include "tyndall/scene/scene_media.h"

namespace tyndall {

struct SceneOptions {
  std::filesystem::path medium;             // replaces the scene's medium when not empty
  bool allow_path = false;                  // follow references out of the folder of the file that names them
  double time = 0.0;                        // [s]
  std::optional<int> frame = std::nullopt;  // the time is that of this picture: frame / the scene's fps
};

/// Loads a scene with everything it refers to. Throws Fault for anything wrong with the files; .gltf, .hdr, .exr and
/// textures are first parsed in a child process with limits, so that a library's crash becomes a Fault too.
Scene read_scene(const std::filesystem::path& file, const SceneOptions& options = {});

/// A scene, and what makes it one at another time.
struct SceneInTime {
  Scene scene;
  SceneMedia media;
  bool moves = false;   // geometry, lights or camera: it has animated nodes
  bool framed = false;  // nobody states a camera: it sees all that is there at the time of reading
  std::filesystem::path file;
  SceneOptions options;
};
SceneInTime read_scene_in_time(const std::filesystem::path& file, const SceneOptions& options = {});
/// Time [s] of a picture of an animation.
inline double time_of(const Scene& scene, int frame) { return frame / scene.fps; }
/// Makes it the scene of another time. What moves is read anew from the files; film, a camera that nobody states and
/// warnings stay. Throws Fault where a medium is none then, or a file is no longer what it was. True where geometry,
/// lights or camera may be others than before.
bool set_time(SceneInTime& scene, double time);

}  // namespace tyndall
