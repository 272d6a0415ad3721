// Bad scene files: each is answered with its place, what was found and what was possible.
#include "tests/bad_file.h"
#include "tyndall/scene/scene_file.h"

namespace tyndall {
namespace {

const tests::BadFile bad_scenes[] = {
    {"byte_order_mark", 3, "/fsp", "\"fsp\"", "did you mean \"fps\"?"},
    {"camera_fov_flat", 4, "/camera/vertical_fov", "number 180", "below 180 [degrees]"},
    {"camera_looks_nowhere", 4, "/camera/look_at", "no direction to look", "apart from position"},
    {"camera_up_along_view", 4, "/camera/up", "along the line of sight", "beside the line of sight"},
    {"camera_up_zero", 4, "/camera/up", "an up that is 0", "beside the line of sight"},
    {"camera_without_look_at", 3, "/camera", "no key \"look_at\"", "a list of 3: a number [m]"},
    {"crlf", 5, "/lights/0/irradiance", "number -1", "from 0 to 1e+30"},
    {"depth_negative", 3, "/integrator/max_depth", "number -1", "from 0 to"},
    {"direction_zero", 6, "/lights/1/direction", "no usable length", "not all 0"},
    {"duplicate_key", 4, "/film/width", "\"width\" a second time", "each key once"},
    {"empty", 0, "", "an empty file", "tyndall-scene/1"},
    {"environment_of_both", 6, "/lights/1/radiance", "both file and radiance", "one of file, radiance"},
    {"environment_of_neither", 5, "/lights/1", "neither file nor radiance", "one of file, radiance"},
    {"film_half_a_pixel", 4, "/film/height", "number 360.5", "a whole number"},
    {"film_too_large", 3, "/film", "134217728 pixels", "smaller"},
    {"film_too_wide", 3, "/film/width", "number 20000", "from 1 to 16384"},
    {"film_without_pixels", 3, "/film/width", "number 0", "from 1 to 16384"},
    {"fps_negative", 3, "/fps", "number -24", "above 0"},
    {"geometry_a_text", 3, "/geometry", "\"street.glb\"", "a list"},
    {"geometry_absent", 4, "/geometry/0", "does not exist", "an existing file"},
    {"geometry_is_a_folder", 4, "/geometry/0/file", "\".\"", "under the folder"},
    {"geometry_unit_negative", 5, "/geometry/0/meters_per_unit", "number -1", "above 0"},
    {"geometry_without_file", 4, "/geometry/0", "no key \"file\"", "A .gltf or .glb file"},
    {"inner_above_outer", 6, "/lights/1/inner_angle", "above the outer", "inner_angle <= outer_angle"},
    {"integrator_a_text", 3, "/integrator", "the text \"path\"", "an object with one of name, spp"},
    {"intensity_beyond_reason", 5, "/lights/1/intensity", "number 1e+31", "from 0 to 1e+30 [W/sr]"},
    {"intensity_two_channels", 5, "/lights/1/intensity", "a list of 2", "or a list of 3"},
    {"later_format", 2, "/format", "tyndall-scene/2", "tyndall-scene/1"},
    {"light_as_text", 5, "/lights/1", "the text \"sun\"", "whose \"type\" is one of point"},
    {"light_without_intensity", 5, "/lights/1", "no key \"intensity\"", "[W/sr]"},
    {"light_without_type", 5, "/lights/1", "no key \"type\"", "one of point, spot, sun"},
    {"lights_an_object", 3, "/lights", "an object", "a list"},
    {"medium_a_number", 3, "/medium", "number 5", "a text, or an object"},
    {"medium_absent", 3, "/medium", "does not exist", "an existing file"},
    {"medium_format", 2, "/format", "tyndall-medium/1", "tyndall-scene/1"},
    {"medium_in_place_both_pairs", 6, "/medium/species/0/density", "density beside", "either"},
    {"medium_in_place_format", 4, "/medium/format", "tyndall-medium/3", "tyndall-medium/1"},
    {"medium_in_place_unknown_law", 5, "/medium/species/0/phase/law", "mie_murki", "did you mean \"mie_murky\"?"},
    {"medium_name_empty", 3, "/medium", "the file name \"\"", "the name of a file"},
    {"medium_outside", 3, "/medium", "../media", "under the folder"},
    {"negative_intensity", 5, "/lights/1/intensity/1", "number -2", "from 0 to"},
    {"no_format", 1, "", "no key \"format\"", "tyndall-scene/1"},
    {"no_unit", 3, "/meters_per_unit", "number 0", "above 0 [m]"},
    {"outer_angle_obtuse", 6, "/lights/1/outer_angle", "number 91", "at most 90 [degrees]"},
    {"position_a_number", 5, "/lights/1/position", "number 3", "a list of 3"},
    {"position_two_numbers", 5, "/lights/1/position", "a list of 2", "a list of 3"},
    {"position_with_text", 7, "/lights/1/position/2", "the text \"2\"", "a number [m]"},
    {"root_list", 1, "", "an empty list", "an object with one of"},
    {"rotation_as_text", 5, "/lights/1/rotation", "the text \"90\"", "[degrees]"},
    {"samples_zero", 4, "/integrator/spp", "number 0", "from 1 to"},
    {"second_environment", 6, "/lights/2", "a second environment", "one environment"},
    {"sun_too_large", 5, "/lights/1/angular_diameter", "number 180", "from 0 to 90"},
    {"sun_with_position", 6, "/lights/1/position", "unknown key \"position\"", "direction, irradiance"},
    {"trailing_comma", 4, "", "not JSON", "no comma after the last"},
    {"unknown_integrator", 4, "/integrator/name", "\"sinlge\"", "did you mean \"single\"?"},
    {"unknown_key", 3, "/geometri", "\"geometri\"", "did you mean \"geometry\"?"},
    {"unknown_light", 5, "/lights/1/type", "\"pont\"", "did you mean \"point\"?"},
    {"volume_box_inside_out", 6, "/volumes/0/profile/max", "not above min", "min < max"},
    {"volume_grid_absent", 5, "/volumes/0/profile/file", "does not exist", "an existing file"},
    {"volume_grid_is_no_vdb", 0, "", "OpenVDB cannot read", "an OpenVDB file"},
    {"volume_radius_negative", 5, "/volumes/0/profile/radius", "number -1", "above 0 [m]"},
    {"volume_without_medium", 4, "/volumes/0", "no key \"medium\"", "a text, or an object"},
    {"volume_without_profile", 4, "/volumes/0", "no key \"profile\"", "whose \"law\" is"},
};

TEST(BadScene, IsAnsweredWithPlaceFoundAndPossible) {
  check_bad_files(bad_scenes, std::filesystem::path(TYNDALL_SOURCE_DIR) / "tests" / "bad" / "scenes", ".scene.json",
                  [](const auto& path) { read_scene(path); });
}

}  // namespace
}  // namespace tyndall
