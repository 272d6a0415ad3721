#include "tyndall/scene/scene_file.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <numbers>

#include "tyndall/document/base_medium.h"
#include "tyndall/document/binding.h"
#include "tyndall/document/file_kind.h"
#include "tyndall/document/named_medium.h"
#include "tyndall/document/reference.h"
#include "tyndall/image/panorama.h"
#include "tyndall/scene/gltf.h"
#include "tyndall/scene/scene_description.h"

namespace tyndall {
namespace {

namespace fs = std::filesystem;

bool is_gltf(const fs::path& file) {
  std::string extension = file.extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension == ".glb" || extension == ".gltf";
}

/// The box around all meshes; none without any.
std::optional<Box> bounds_of(const Scene& scene) {
  Vector low{infinity, infinity, infinity}, high = -low;
  for (const Mesh& mesh : scene.meshes) {
    for (const auto& p : mesh.positions) {
      low = {std::min<double>(low.x, p[0]), std::min<double>(low.y, p[1]), std::min<double>(low.z, p[2])};
      high = {std::max<double>(high.x, p[0]), std::max<double>(high.y, p[1]), std::max<double>(high.z, p[2])};
    }
  }
  return low.x <= high.x ? std::optional(Box{low, high}) : std::nullopt;
}

/// The camera that sees everything from slightly above and beside, as one would hold a thing to look at it.
Camera framing(const Scene& scene) {
  Camera camera;
  const auto bounds = bounds_of(scene);
  if (!bounds) return camera;
  const auto& [low, high] = *bounds;
  const double half_height = std::tan(0.5 * camera.vertical_fov * std::numbers::pi / 180.0);
  const double half_width = half_height * scene.film.width / scene.film.height;
  const Vector back = normalized({0.5, 0.35, 1.0});
  const Vector right = normalized(cross(camera.up, back)), up = cross(back, right);
  camera.look_at = (low + high) * 0.5;
  // Far enough for every corner of the box to be inside the picture's edges, and a little air around it.
  double distance = 1e-6;
  for (int corner = 0; corner < 8; ++corner) {
    const Vector p = Vector{(corner & 1) != 0 ? low.x : high.x, (corner & 2) != 0 ? low.y : high.y,
                            (corner & 4) != 0 ? low.z : high.z} -
                     camera.look_at;
    const double needed = std::max(std::fabs(dot(p, right)) / half_width, std::fabs(dot(p, up)) / half_height);
    distance = std::max(distance, 1.1 * (needed + dot(p, back)));
  }
  camera.position = camera.look_at + back * distance;
  return camera;
}

bool has_light_inside(const Scene& scene) {
  return !scene.points.empty() || !scene.spots.empty() || std::ranges::any_of(scene.meshes, [&](const Mesh& mesh) {
    return mesh.material >= 0 && !is_zero(scene.materials[static_cast<std::size_t>(mesh.material)].emission);
  });
}
bool has_light_outside(const Scene& scene) { return !scene.suns.empty() || scene.environment; }

/// Whether the medium goes on for ever in all directions, so that no light comes through it from outside.
bool is_endless(const Medium& medium) {
  return std::ranges::any_of(medium.species, [](const Species& s) {
    return !is_zero(s.extinction()) && std::ranges::all_of(s.profiles, [](const Profile& profile) {
      return std::holds_alternative<ConstantProfile>(profile) || std::holds_alternative<NoiseProfile>(profile);
    });
  });
}

/// Says why a picture will be black, where that is known.
void note_darkness(Scene& scene, const fs::path& file) {
  if (has_light_inside(scene)) return;
  if (!has_light_outside(scene)) {
    scene.warnings.push_back(place(file.string()) + ": no light: the picture will be black");
  } else if (is_endless(scene.medium)) {
    scene.warnings.push_back(place(file.string()) +
                             ": the medium is endless, so that no sun or environment shines through it: the picture "
                             "will be black; give the medium a height profile or a volume, or add lamps");
  }
}

/// Warns, once of each; after some hundred that more are not shown.
void warn(Scene& scene, std::string text) {
  constexpr std::size_t most = 200;
  if (scene.warnings.size() > most || std::ranges::find(scene.warnings, text) != scene.warnings.end()) return;
  if (scene.warnings.size() == most) text = "more warnings of this kind are not shown";
  scene.warnings.push_back(std::move(text));
}

/// What in a medium is outside what physics allows, once for each place; the medium is at `pointer` of the file.
void note_remarks(Scene& scene, const MediumFile& medium, const std::string& file, const std::string& pointer) {
  for (const Remark& remark : remarks_on(medium)) {
    warn(scene, remark_text(remark, file, pointer));
  }
}

/// Light for a scene that has none: all around it, or where the medium lets nothing through, a lamp beside the camera
/// that is as bright on what the camera looks at.
void stand_in_for_light(Scene& scene, const SceneMedia& media, const fs::path& file) {
  std::string what = "an environment of radiance 1 W/(m^2 sr)";
  const auto times = key_times(media);
  if (is_endless(scene.medium) ||
      std::ranges::any_of(times, [&](double time) { return is_endless(medium_at(media, time)); })) {
    const Camera& camera = scene.camera;
    const Vector forward = normalized(camera.look_at - camera.position);
    const Vector right = normalized(cross(forward, camera.up)), up = cross(right, forward);
    const auto bounds = bounds_of(scene);
    const double distance = bounds ? std::max(length((bounds->low + bounds->high) * 0.5 - camera.position),
                                              0.1 * length(bounds->high - bounds->low))
                                   : length(camera.look_at - camera.position);
    scene.points.push_back(
        {camera.position + (up - right) * (0.2 * distance), Spectrum::grey(std::numbers::pi * distance * distance)});
    what = "a lamp beside the camera";
  } else {
    scene.environment.emplace().radiance = Spectrum::grey(1.0);
  }
  scene.warnings.push_back(place(file.string()) + ": no light: " + what + " stands in");
}

/// Camera and film, where the scene file does not state them: from the glTF file, else so that all is seen.
void complete_view(SceneInTime& whole, const std::optional<GltfCamera>& found, bool has_camera, bool has_film) {
  Scene& scene = whole.scene;
  if (!has_film && !has_camera && found && found->aspect) {
    const double width = std::round(scene.film.height * *found->aspect);
    scene.film.width = static_cast<int>(std::clamp(width, 1.0, 16384.0));
  }
  whole.framed = !has_camera && !found;
  if (!has_camera) scene.camera = found ? found->camera : framing(scene);
}

double time_of(const Scene& scene, const SceneOptions& options) {
  return options.frame ? time_of(scene, *options.frame) : options.time;
}

void set_media_time(SceneInTime& whole, double time) {
  whole.scene.time = time;
  whole.scene.medium = medium_at(whole.media, time);
}

SceneInTime scene_of_gltf(const fs::path& file, const SceneOptions& options) {
  SceneInTime out;
  Scene& scene = out.scene;
  const double time = time_of(scene, options);
  const GltfContent content = add_gltf(scene, file, {1.0, options.allow_path, time});
  out.moves = content.moves;
  complete_view(out, content.camera, false, false);
  if (!options.medium.empty()) {
    const auto [medium, name] = read_named_medium(options.medium.string(), options.allow_path);
    note_remarks(scene, medium, name, "");
    out.media.push_back({medium, name, {}});
  }
  set_media_time(out, time);
  if (!has_light_inside(scene) && !has_light_outside(scene)) stand_in_for_light(scene, out.media, file);
  note_darkness(scene, file);
  return out;
}

/// Turns a description into a scene. `root` is the description's JSON, for the places of faults.
class Assembly {
 public:
  Assembly(const JsonCursor& root, const fs::path& file, const SceneOptions& options)
      : root_(root), file_(file), options_(options) {}

  SceneInTime run(const SceneDescription& description) {
    unit_ = description.meters_per_unit;
    scene_.meters_per_unit = unit_;
    scene_.fps = description.fps;
    scene_.integrator = description.integrator;
    if (description.film) scene_.film = *description.film;
    if (!options_.medium.empty()) {
      const auto [medium, name] = read_named_medium(options_.medium.string(), options_.allow_path);
      add_medium(medium, name, "", {});
    } else if (description.medium) {
      add_medium(*description.medium, root_.at("medium"), {});
    }
    for (std::size_t i = 0; i < description.volumes.size(); ++i) {
      const JsonCursor at = root_.at("volumes").at(i);
      add_medium(description.volumes[i].medium, at.at("medium"),
                 metres(description.volumes[i].profile, at.at("profile")).all);
    }
    std::optional<GltfCamera> camera;
    for (std::size_t i = 0; i < description.geometry.size(); ++i) {
      const auto found = add_geometry(description.geometry[i], root_.at("geometry").at(i));
      if (!camera) camera = found;
    }
    for (std::size_t i = 0; i < description.lights.size(); ++i) {
      const JsonCursor at = root_.at("lights").at(i);
      std::visit([&](const auto& light) { add_light(metres(light, at), at); }, description.lights[i]);
    }
    if (description.camera) {
      scene_.camera = metres(*description.camera, root_.at("camera"));
      if (auto objection = objection_to(scene_.camera)) throw root_.at("camera").fault_below(*objection);
    }
    complete_view(whole_, camera, description.camera.has_value(), description.film.has_value());
    set_media_time(whole_, time_of(scene_, options_));
    note_darkness(scene_, file_);
    return std::move(whole_);
  }

 private:
  /// A described value in metres; Fault where that makes a number useless.
  template <class T>
  T metres(const T& value, const JsonCursor& at) const {
    T scaled = in_metres(value, unit_);
    if (auto objection = unusable_number(scaled)) throw at.fault_below(*objection);
    return scaled;
  }

  /// What `act` returns; its fault without a place is at `at`. Places take a walk through the text: lists of a hundred
  /// thousand names are looked up without.
  template <class Act>
  static auto placed(const JsonCursor& at, Act act) {
    try {
      return act();
    } catch (const Fault& fault) {
      if (!fault.where.empty()) throw;
      throw at.fault(fault.found, fault.expected);
    }
  }

  /// The medium of this name, read once.
  const NamedMedium& named_medium(const std::string& name, const JsonCursor& at) {
    auto found = named_media_.find(name);
    if (found == named_media_.end()) {
      found = named_media_
                  .emplace(name, placed(at, [&] { return read_named_medium(file_, name, options_.allow_path, ""); }))
                  .first;
    }
    return found->second;
  }

  /// The file that a text of this scene names.
  fs::path named(const std::string& name, const JsonCursor& at) const {
    return placed(at, [&] { return referenced_file(file_, name, options_.allow_path, ""); });
  }

  void add_medium(const MediumReference& reference, const JsonCursor& at, const std::vector<Profile>& profiles) {
    if (const auto* text = std::get_if<MediumName>(&reference)) {
      const NamedMedium& named = named_medium(text->file, at);
      add_medium(named.file, named.name, "", profiles);
    } else {
      add_medium(medium_file_at(at), at.file(), at.pointer(), profiles);
    }
  }

  /// A medium of the file `name`, where it stands at `pointer`.
  void add_medium(const MediumFile& file, const std::string& name, const std::string& pointer,
                  const std::vector<Profile>& profiles) {
    const ChannelTag channels = channels_of(file);
    if (channels_ && *channels_ != channels) {
      warn(scene_, place(name, 0, pointer) +
                       ": its channels mean something else than those of the first medium; they are added one by one");
    }
    if (!channels_) channels_ = channels;
    note_remarks(scene_, file, name, pointer);
    whole_.media.push_back({file, pointer.empty() ? name : place(name, 0, pointer), profiles});
  }

  std::optional<GltfCamera> add_geometry(const GeometryReference& reference, const JsonCursor& at) {
    const auto* file = std::get_if<GeometryFile>(&reference);
    const fs::path path =
        file != nullptr ? named(file->file, at.at("file")) : named(std::get<GeometryName>(reference).file, at);
    const GltfContent content = add_gltf(
        scene_, path, {file != nullptr ? file->meters_per_unit : 1.0, options_.allow_path, time_of(scene_, options_)});
    whole_.moves = whole_.moves || content.moves;
    return content.camera;
  }

  void add_light(const PointLight& light, const JsonCursor&) { scene_.points.push_back(light); }
  void add_light(SpotLight light, const JsonCursor&) {
    light.direction = normalized(light.direction);
    scene_.spots.push_back(light);
  }
  void add_light(SunLight light, const JsonCursor&) {
    light.direction = normalized(light.direction);
    scene_.suns.push_back(light);
  }
  void add_light(const EnvironmentDescription& from, const JsonCursor& at) {
    if (scene_.environment) throw at.fault("a second environment", "one environment");
    EnvironmentLight light;
    light.radiance = from.radiance.value_or(Spectrum{});
    light.scale = from.scale;
    light.rotation = from.rotation;
    if (from.file) {
      const fs::path file = named(*from.file, at.at("file"));
      light.panorama = std::make_shared<const Panorama>(read_panorama(file));
      if (light.panorama->width != 2 * light.panorama->height) {
        scene_.warnings.push_back(place(file.string()) +
                                  ": not twice as wide as high, but taken as a latitude-longitude picture");
      }
    }
    scene_.environment = std::move(light);
  }

  JsonCursor root_;
  const fs::path& file_;
  const SceneOptions& options_;
  double unit_ = 1.0;
  SceneInTime whole_;
  Scene& scene_ = whole_.scene;
  std::optional<ChannelTag> channels_;
  std::map<std::string, NamedMedium> named_media_;
};

/// A medium written in place need not repeat what the scene file says already.
void complete_medium(Json& owner, const Json& meters_per_unit) {
  if (!owner.is_object() || !owner.contains("medium") || !owner["medium"].is_object()) return;
  Json& medium = owner["medium"];
  if (!medium.contains("format")) medium["format"] = "tyndall-medium/1";
  if (!medium.contains("meters_per_unit") && !meters_per_unit.is_null()) medium["meters_per_unit"] = meters_per_unit;
}

}  // namespace

bool set_time(SceneInTime& scene, double time) {
  if (!scene.moves) {
    set_media_time(scene, time);
    return false;
  }
  if (scene.scene.time == time) return false;
  SceneOptions then = scene.options;
  then.frame.reset();
  then.time = time;
  SceneInTime next = read_scene_in_time(scene.file, then);
  next.scene.film = scene.scene.film;
  next.scene.warnings = scene.scene.warnings;
  if (scene.framed) next.scene.camera = scene.scene.camera;
  scene = std::move(next);
  return true;
}

Scene read_scene(const fs::path& file, const SceneOptions& options) { return read_scene_in_time(file, options).scene; }

namespace {

SceneInTime scene_of_file(const fs::path& file, const SceneOptions& options) {
  if (is_gltf(file)) return scene_of_gltf(file, options);
  refuse_other_kinds(file, FileKind::scene);
  JsonText json = read_json(file, options.allow_path);
  refuse_other_kinds(json, FileKind::scene);
  if (json.root.is_object()) {
    const Json unit = json.root.value("meters_per_unit", Json{});
    complete_medium(json.root, unit);
    if (json.root.contains("volumes") && json.root["volumes"].is_array()) {
      for (Json& volume : json.root["volumes"]) complete_medium(volume, unit);
    }
  }
  resolve_base(json, "/medium");
  if (json.root.is_object() && json.root.contains("volumes") && json.root["volumes"].is_array()) {
    for (std::size_t i = 0; i < json.root["volumes"].size(); ++i) {
      resolve_base(json, "/volumes/" + std::to_string(i) + "/medium");
    }
  }
  const JsonCursor root(json);
  return Assembly(root, file, options).run(read_as<SceneDescription>(root));
}

}  // namespace

SceneInTime read_scene_in_time(const fs::path& file, const SceneOptions& options) {
  SceneInTime out = scene_of_file(file, options);
  out.file = file;
  out.options = options;
  return out;
}

}  // namespace tyndall
