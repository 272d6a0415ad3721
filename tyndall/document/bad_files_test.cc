// Bad medium files: each is answered with its place, what was found and what was possible.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>

#include "tyndall/document/medium_file.h"

namespace tyndall {
namespace {

struct BadFile {
  const char* name;
  int line;
  const char *pointer, *found, *expected;  // found and expected: a part of what is said
};

const BadFile bad_files[] = {
    {"albedo_above_one", 7, "/conditions/veil/albedo/1", "number 1.2", "from 0 to 1"},
    {"albedo_without_density", 5, "/species/0/albedo", "albedo without density", "density and albedo"},
    {"base_out_of_range", 1, "", "too dense", "less of it"},
    {"box_flat_corner", 7, "/conditions/profile/min", "a list of 2", "a list of 3"},
    {"box_inside_out", 8, "/conditions/profile/max", "corner that is not above min", "min < max"},
    {"comment", 3, "", "not JSON", "JSON"},
    {"contrast_one", 7, "/conditions/thickness/contrast", "number 1", "above 0 and below 1"},
    {"duplicate_key", 5, "/name", "\"name\" a second time", "each key once"},
    {"duplicate_key_below", 7, "/species/1/scattering", "\"scattering\" a second time", "each key once"},
    {"empty", 1, "", "not JSON", "JSON"},
    {"g_one", 5, "/species/0/phase/g", "number 1", "above -1 and below 1"},
    {"held_visibility_out_of_reach", 6, "/conditions/thickness", "600 m", "shorter visibility"},
    {"key_with_escape", 3, "/\\u001b[31mred\\n", "\"\\u001b[31mred\\n\"", "conditions"},
    {"key_with_slashes", 3, "/a~1b~0c", "\"a/b~c\"", "conditions"},
    {"later_format", 2, "/format", "tyndall-medium/2", "tyndall-medium/1"},
    {"law_as_text", 4, "/species/0/phase", "\"mie_hazy\"", "an object whose \"law\" is"},
    {"lone_surrogate", 3, "", "surrogate", "JSON"},
    {"long_key", 3, "/xxxx", "xxx...\"", "conditions"},
    {"mixture_without_parts", 4, "/species/0/phase/parts", "no parts", "at least one part"},
    {"mixture_without_weight", 5, "/species/0/phase/parts", "weights without", "weight above 0"},
    {"negative_exaggeration", 4, "/background/exaggeration", "number -1", "at least 0"},
    {"negative_unit", 3, "/meters_per_unit", "number -1", "above 0"},
    {"no_format", 1, "", "no key \"format\"", "tyndall-medium/1"},
    {"no_model", 3, "/conditions", "no key \"model\"", "simple, two_lobes"},
    {"no_scale_height", 7, "/conditions/profile", "no key \"scale_height\"", "above 0 [m]"},
    {"no_thickness", 3, "/conditions", "no key \"thickness\"", "visibility"},
    {"no_unit", 3, "/meters_per_unit", "number 0", "above 0"},
    {"not_a_number", 5, "/conditions", "not JSON", "JSON"},
    {"not_utf8", 3, "", "ill-formed UTF-8", "JSON"},
    {"null_name", 3, "/name", "null", "a text"},
    {"number_as_name", 3, "/name", "number 5", "a text"},
    {"number_overflow", 5, "/conditions/w", "too large", "finite"},
    {"parameter_of_another_law", 4, "/species/0/phase/g", "unknown key \"g\"", "no key besides \"law\""},
    {"root_list", 1, "", "an empty list", "an object"},
    {"scene_format", 2, "/format", "tyndall-scene/1", "tyndall-medium/1"},
    {"species_object", 3, "/species", "an object", "a list"},
    {"species_with_both_pairs", 5, "/species/0/density", "beside scattering", "either"},
    {"species_without_coefficients", 5, "/species/1", "without coefficients", "either"},
    {"thickness_negative", 6, "/conditions/thickness", "number -1", "at least 0 [1/m]"},
    {"thickness_no_form", 6, "/conditions/thickness", "an object", "extinction, mean_free_path, visibility"},
    {"thickness_two_channels", 6, "/conditions/thickness", "a list of 2", "a list of 3"},
    {"thickness_two_forms", 6, "/conditions/thickness", "two forms", "one of"},
    {"thickness_unknown_form", 6, "/conditions/thickness/visibilty", "visibilty", "did you mean \"visibility\"?"},
    {"too_deep", 4, "/species/0/0", "more than 64 levels", "at most 64"},
    {"trailing_comma", 4, "", "not JSON", "JSON"},
    {"truncated", 3, "", "missing closing quote", "JSON"},
    {"two_documents", 5, "", "unexpected '{'", "JSON"},
    {"two_wavelengths", 3, "/channels/wavelengths_nm", "a list of 2", "a list of 3"},
    {"unit_too_small", 5, "/conditions/thickness", "inf", "within range"},
    {"unknown_air", 4, "/background/air", "\"notes\"", "did you mean \"note\"?"},
    {"unknown_hold", 7, "/conditions/hold", "visability", "did you mean \"visibility\"?"},
    {"unknown_key", 3, "/conditons", "conditons", "did you mean \"conditions\"?"},
    {"unknown_law", 4, "/species/0/phase/law", "henyey_greenstien", "did you mean \"henyey_greenstein\"?"},
    {"unknown_model", 4, "/conditions/model", "simpel", "did you mean \"simple\"?"},
    {"unknown_profile", 7, "/conditions/profile/law", "exponental", "did you mean \"exponential\"?"},
    {"unknown_space", 3, "/channels/space", "\"srgb\"", "linear-srgb"},
    {"veil_without_density", 7, "/conditions/veil", "no key \"density\"", "mean_free_path"},
    {"visibility_zero", 6, "/conditions/thickness/visibility/1", "number 0", "above 0 [m]"},
    {"w_above_one", 5, "/conditions/w", "number 1.5", "from 0 to 1"},
    {"w_text", 5, "/conditions/w", "text \"0.5\"", "from 0 to 1"},
    {"w_true", 5, "/conditions/w", "true", "from 0 to 1"},
};

const std::filesystem::path folder = std::filesystem::path(TYNDALL_SOURCE_DIR) / "tests" / "bad" / "media";

TEST(BadFile, IsAnsweredWithPlaceFoundAndPossible) {
  for (const BadFile& bad : bad_files) {
    const auto path = folder / (std::string(bad.name) + ".medium.json");
    SCOPED_TRACE(bad.name);
    try {
      read_medium_file(path);
      ADD_FAILURE() << "accepted";
    } catch (const Fault& fault) {
      std::string where = path.string() + ":" + std::to_string(bad.line);
      if (*bad.pointer != '\0') where += std::string(": at ") + bad.pointer;
      EXPECT_THAT(fault.where, testing::StartsWith(where));
      // Deep and long pointers are given from their beginning only.
      const std::string name = bad.name;
      if (name != "too_deep" && name != "long_key") {
        EXPECT_EQ(fault.where, where);
      }
      EXPECT_THAT(fault.found, testing::HasSubstr(bad.found));
      EXPECT_THAT(fault.expected, testing::HasSubstr(bad.expected));
      EXPECT_LT(std::string(fault.what()).size(), path.string().size() + 700);
      for (const char c : std::string(fault.what())) EXPECT_GE(static_cast<unsigned char>(c), 0x20);
    }
  }
}

TEST(BadFile, EveryFileOfTheFolderIsInTheTable) {
  std::set<std::string> listed, present;
  for (const BadFile& bad : bad_files) listed.insert(std::string(bad.name) + ".medium.json");
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    present.insert(entry.path().filename().string());
  EXPECT_EQ(listed, present);
}

}  // namespace
}  // namespace tyndall
