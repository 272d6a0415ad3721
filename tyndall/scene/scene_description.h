#pragma once
// What a scene file says, as it says it: names of files not followed yet, lengths in the file's own units.
#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <variant>
#include <vector>

#include "tyndall/artist/stated_species.h"
#include "tyndall/document/medium_file.h"
#include "tyndall/document/spelling.h"
#include "tyndall/number/demand.h"
#include "tyndall/number/described.h"
#include "tyndall/scene/scene.h"

namespace tyndall {

enum class SceneFormat { version_1 };
constexpr std::array<std::string_view, 1> words_of(SceneFormat) { return {"tyndall-scene/1"}; }

/// A medium by the name of its file, or written out in place. In place, `format` may be left out, and lengths are in
/// the scene's unit unless it says meters_per_unit.
struct MediumName {
  static constexpr bool bare = true;
  std::string file;
  static constexpr auto fields() {
    return std::tuple{Field{"file", &MediumName::file, any_number, "", "A medium file.", Scaling::none, true}};
  }
};
using MediumReference = std::variant<MediumName, MediumFile>;

/// A glTF file by its name, or with a unit where it is not in metres as glTF demands.
struct GeometryName {
  static constexpr bool bare = true;
  std::string file;
  static constexpr auto fields() {
    return std::tuple{
        Field{"file", &GeometryName::file, any_number, "", "A .gltf or .glb file in metres.", Scaling::none, true}};
  }
};
struct GeometryFile {
  std::string file;
  double meters_per_unit = 1.0;
  static constexpr auto fields() {
    return std::tuple{
        Field{"file", &GeometryFile::file, any_number, "", "A .gltf or .glb file.", Scaling::none, true},
        Field{"meters_per_unit", &GeometryFile::meters_per_unit, positive, "m", "The length that the file calls 1."}};
  }
};
using GeometryReference = std::variant<GeometryName, GeometryFile>;

/// Light from all around: one radiance, or a panorama from a file.
struct EnvironmentDescription {
  static constexpr std::string_view name = "environment";
  static constexpr std::string_view text = "Light from all around: one radiance, or a panorama.";
  std::optional<std::string> file;
  std::optional<Spectrum> radiance;
  Spectrum scale = Spectrum::grey(1.0);
  double rotation = 0.0;
  static constexpr auto fields() {
    return std::tuple{
        Field{"file", &EnvironmentDescription::file, any_number, "", "A latitude-longitude picture, .hdr or .exr."},
        Field{"radiance", &EnvironmentDescription::radiance, light_range, "W/(m^2 sr)",
              "The same radiance from everywhere, per channel."},
        Field{"scale", &EnvironmentDescription::scale, light_range, "1", "Makes it brighter or darker."},
        Field{"rotation", &EnvironmentDescription::rotation, any_number, "degrees",
              "Turns the panorama about the vertical, counter-clockwise seen from above."}};
  }
};

/// The closed list of lights. In files the key "type" names them.
using LightDescription = std::variant<PointLight, SpotLight, SunLight, EnvironmentDescription>;
template <>
inline constexpr std::string_view choice_key<LightDescription> = "type";

/// More medium where a profile is: it adds to what else is there.
struct VolumeDescription {
  MediumReference medium;
  Profiles profile;
  static constexpr auto fields() {
    return std::tuple{
        Field{"medium", &VolumeDescription::medium, any_number, "", "The medium that fills it.", Scaling::none, true},
        Field{"profile", &VolumeDescription::profile, any_number, "",
              "Where it is; a list multiplies, and so do profiles of the medium's own.", Scaling::none, true}};
  }
};

struct SceneDescription {
  std::optional<std::string> schema;  // for editors; not read
  SceneFormat format = SceneFormat::version_1;
  std::string name;
  double meters_per_unit = 1.0;
  std::optional<MediumReference> medium;
  std::vector<GeometryReference> geometry;
  std::vector<LightDescription> lights;
  std::vector<VolumeDescription> volumes;
  std::optional<Camera> camera;
  std::optional<Film> film;
  double fps = 24.0;
  IntegratorSettings integrator;
  static constexpr auto fields() {
    using S = SceneDescription;
    return std::tuple{
        Field{"$schema", &S::schema, any_number, "", "Where editors find the format's schema."},
        Field{"format", &S::format, any_number, "", "The format of this file.", Scaling::none, true},
        Field{"name", &S::name, any_number, "", "What to call the scene."},
        Field{"meters_per_unit", &S::meters_per_unit, positive, "m",
              "The file's unit of length: 1 for metres, 0.01 for centimetres."},
        Field{"medium", &S::medium, any_number, "", "The air everywhere: a medium file, or a medium in place."},
        Field{"geometry", &S::geometry, any_number, "", "glTF files with surfaces, lights and cameras."},
        Field{"lights", &S::lights, any_number, "", "Lights besides those of the glTF files."},
        Field{"volumes", &S::volumes, any_number, "", "More media in boxes, spheres and layers."},
        Field{"camera", &S::camera, any_number, "", Camera::text},
        Field{"film", &S::film, any_number, "", Film::text},
        Field{"fps", &S::fps, positive, "1/s", "Pictures per second of an animation."},
        Field{"integrator", &S::integrator, any_number, "", IntegratorSettings::text}};
  }
};

inline std::optional<Objection> objection_to_direction(const Vector& direction) {
  if (length_squared(direction) > 0.0 && std::isfinite(length_squared(direction))) return std::nullopt;
  return Objection{"direction", "a direction of no usable length", "three numbers that are not all 0"};
}
inline std::optional<Objection> objection_to(const SunLight& sun) { return objection_to_direction(sun.direction); }
constexpr auto demands_of(const SunLight&) { return std::array{not_all_zero("direction")}; }
inline std::optional<Objection> objection_to(const SpotLight& spot) {
  if (spot.inner_angle > spot.outer_angle) {
    return Objection{"inner_angle", "an inner angle above the outer angle", "inner_angle <= outer_angle"};
  }
  return objection_to_direction(spot.direction);
}
constexpr auto demands_of(const SpotLight&) { return std::array{not_all_zero("direction")}; }
inline std::optional<Objection> objection_to(const EnvironmentDescription& e) {
  if (e.file && e.radiance) return Objection{"radiance", "both file and radiance", "one of file, radiance"};
  if (!e.file && !e.radiance) return Objection{"", "neither file nor radiance", "one of file, radiance"};
  return std::nullopt;
}
constexpr auto demands_of(const EnvironmentDescription&) {
  return std::array{some_of("file", "radiance"), not_both("file", "radiance")};
}
inline std::optional<Objection> objection_to(const Camera& camera) {
  const Vector forward = camera.look_at - camera.position;
  const double distance = length(forward), up = length(camera.up);
  if (!(distance > 0.0 && std::isfinite(distance))) {
    return Objection{"look_at", "a point that leaves no direction to look", "a point apart from position"};
  }
  // 1e-9: closer than that to the line of sight, rounding would decide which way is up.
  if (!(up > 0.0 && std::isfinite(up) && length(cross(forward / distance, camera.up / up)) > 1e-9)) {
    return Objection{"up", "an up that is 0 or along the line of sight", "a direction beside the line of sight"};
  }
  return std::nullopt;
}
constexpr auto demands_of(const Camera&) { return std::array{not_all_zero("up")}; }
inline std::optional<Objection> objection_to(const Film& film) {
  constexpr long long most = 1LL << 27;
  if (static_cast<long long>(film.width) * film.height <= most) return std::nullopt;
  return Objection{"", "more than 134217728 pixels", "a smaller picture"};
}
inline std::optional<Objection> objection_to(const IntegratorSettings& integrator) {
  if (std::ranges::find(integrator_names, integrator.name) != integrator_names.end()) return std::nullopt;
  return Objection{"name", "the integrator " + in_quotes(integrator.name),
                   one_of(integrator.name, {integrator_names.begin(), integrator_names.end()})};
}

constexpr auto demands_of(const IntegratorSettings&) { return std::array{one_word_of("name", integrator_names)}; }

}  // namespace tyndall
