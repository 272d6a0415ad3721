// The presets: each reads, compiles without a warning, and has a source for every number.
#include "tyndall/document/preset.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>

#include "tyndall/document/law_text.h"
#include "tyndall/document/medium_file.h"
#include "tyndall/document/named_medium.h"

namespace tyndall {
namespace {

namespace fs = std::filesystem;
const fs::path folder = fs::path(TYNDALL_SOURCE_DIR) / "presets";

MediumFile file_of(const Preset& preset) { return medium_from_json(std::string(preset.text), title_of(preset)); }

/// Whether one pointer names a part of what the other names.
bool is_within(const std::string& pointer, const std::string& part) {
  return pointer == part || pointer.starts_with(part + '/');
}

/// Pointers to all numbers and choices of a kind of air, but for those that are no statement about nature.
void collect(const Json& value, const std::string& pointer, std::set<std::string>& out) {
  if (value.is_number()) out.insert(pointer);
  if (value.is_array() && !value.empty() && value[0].is_number()) {
    out.insert(pointer);
    return;
  }
  if (value.is_object()) {
    for (const auto& [key, member] : value.items()) {
      if (pointer.empty() && (key == "sources" || key == "meters_per_unit")) continue;
      if (key == "air") out.insert(joined(pointer, key));
      collect(member, joined(pointer, key), out);
    }
  } else if (value.is_array()) {
    for (std::size_t i = 0; i < value.size(); ++i) collect(value[i], joined(pointer, std::to_string(i)), out);
  }
}

double extinction_in_green(const MediumFile& file) {
  const Medium medium = compile(file);
  return (scattering_at(medium, {}) + absorption_at(medium, {}))[visibility_channel];
}

TEST(Presets, AreTheFilesOfTheirFolder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    std::ifstream in(entry.path(), std::ios::binary);
    const std::string name = entry.path().filename().string();
    ASSERT_TRUE(name.ends_with(".medium.json")) << name;
    files[name.substr(0, name.find('.'))] = {std::istreambuf_iterator<char>(in), {}};
  }
  EXPECT_GE(files.size(), 20U);
  ASSERT_EQ(files.size(), presets().size());
  for (const Preset& preset : presets()) EXPECT_EQ(files.at(std::string(preset.name)), preset.text) << preset.name;
}

TEST(Presets, HaveNamesThatAreNothingElse) {
  for (const Preset& preset : presets()) {
    EXPECT_EQ(preset.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_"), std::string_view::npos);
    for (const std::string_view law : law_names()) EXPECT_NE(preset.name, law);
  }
}

TEST(Presets, AreMediaThatNatureCouldHave) {
  for (const Preset& preset : presets()) {
    SCOPED_TRACE(preset.name);
    const MediumFile file = file_of(preset);
    EXPECT_FALSE(file.name.empty());
    EXPECT_TRUE(file.description && !file.description->empty());
    EXPECT_GT(extinction_in_green(file), 0.0);
    for (const Remark& remark : remarks_on(dials_in_metres(file))) ADD_FAILURE() << remark_text(remark, "");
  }
}

TEST(Presets, HaveASourceForEveryNumber) {
  for (const Preset& preset : presets()) {
    SCOPED_TRACE(preset.name);
    const JsonText text = parse_json(std::string(preset.text), "t");
    std::set<std::string> numbers;
    collect(text.root, "", numbers);
    EXPECT_FALSE(numbers.empty());
    const MediumFile file = file_of(preset);
    for (const std::string& number : numbers) {
      const bool has = std::any_of(file.sources.begin(), file.sources.end(),
                                   [&](const Source& source) { return is_within(number, source.of); });
      EXPECT_TRUE(has) << number;
    }
    for (const Source& source : file.sources) {
      EXPECT_TRUE(text.root.contains(Json::json_pointer(source.of))) << source.of;
      // Author, year and where; or that it is our own choice.
      const bool own = source.source.find("our own choice") != std::string::npos;
      const bool cited = source.source.find_first_of("0123456789") != std::string::npos && source.source.size() > 20;
      EXPECT_TRUE(own || cited || source.source.starts_with("the same") || source.source.starts_with("pure water"))
          << source.source;
      EXPECT_EQ(source.value.has_value(), !source.unit.empty()) << source.of;
    }
  }
}

TEST(Presets, SayWhatTheirSourcesSay) {
  // Of a number in the file's own unit, the source's value is the file's. 1/km and km are the file's 1e-3 / m and 1e3
  // m; a number at one wavelength may have been spread over the channels.
  std::size_t compared = 0;
  for (const Preset& preset : presets()) {
    const JsonText text = parse_json(std::string(preset.text), "t");
    for (const Source& source : file_of(preset).sources) {
      const Json& number = text.root.at(Json::json_pointer(source.of));
      if (!source.value || !(number.is_number() || number.is_array())) continue;
      const double unit = source.unit == "1/km" ? 1e-3 : source.unit == "km" ? 1e3 : 1.0;
      const bool spread =
          number.is_array() && source.wavelength_nm && (*source.wavelength_nm)[0] == (*source.wavelength_nm)[2];
      if (spread) continue;
      for (std::size_t c = 0; c < channel_count; ++c) {
        const double stated = number.is_array() ? number[c].get<double>() : number.get<double>();
        EXPECT_NEAR(stated, (*source.value)[c] * unit, 1e-12) << preset.name << source.of;
      }
      ++compared;
    }
  }
  EXPECT_GT(compared, 40U);
}

TEST(Presets, HaveTheVisibilityThatTheirSourcesSay) {
  const auto visibility = [](const char* name) {
    return -std::log(0.05) / extinction_in_green(read_named_medium(name).file);
  };
  EXPECT_NEAR(visibility("light_haze"), 16120.0, 30.0);  // OPAC prints 16.12 km, with 3.0 for -ln(0.05)
  EXPECT_NEAR(visibility("haze"), 4000.0, 1e-6);
  EXPECT_NEAR(visibility("mist"), 2000.0, 1e-6);
  EXPECT_NEAR(visibility("dust"), 3000.0, 1e-6);
  EXPECT_NEAR(visibility("smog"), 2000.0, 1e-6);
  EXPECT_NEAR(visibility("sea_haze"), 10000.0, 1e-6);
  EXPECT_NEAR(visibility("sand"), 500.0, 1e-6);
  for (const char* fog : {"advection_fog", "moderate_advection_fog", "radiation_fog", "moderate_radiation_fog"}) {
    EXPECT_LT(visibility(fog), 1000.0) << fog;  // WMO's definition of fog
  }
  // Mie's theory for Shettle & Fenn's four fogs: 28.7, 18.5, 16.6, 8.6 per km at 550 nm.
  const double mie[] = {28.7e-3, 18.5e-3, 16.6e-3, 8.6e-3};
  const char* const fogs[] = {"advection_fog", "moderate_advection_fog", "radiation_fog", "moderate_radiation_fog"};
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(visibility(fogs[i]) * mie[i] / -std::log(0.05), 1.0, 0.015) << fogs[i];
  EXPECT_NEAR(visibility("standard_air"), farthest_visibility(0.05), 1.0);
  EXPECT_GT(visibility("mountain_air"), visibility("standard_air"));
  // Petzold's beam attenuation 2.190 per m at 514 nm, carried to 550: absorption falls by 0.112.
  EXPECT_NEAR(-std::log(0.05) / visibility("murky_water"), 2.190 - 0.112, 2e-3);
}

TEST(NamedMedium, PresetsWinOverBareFilesAndPathsAreFiles) {
  std::string name = (fs::temp_directory_path() / "tyndall-test-XXXXXX").string();
  const fs::path here = ::mkdtemp(name.data());
  std::ofstream(here / "haze") << R"({"format": "tyndall-medium/1", "name": "mine"})";
  std::ofstream(here / "mine") << R"({"format": "tyndall-medium/1", "name": "mine"})";
  const fs::path naming = here / "s.scene.json";
  EXPECT_EQ(read_named_medium(naming, "haze", false, "w").file.name, "Haze");
  EXPECT_EQ(read_named_medium(naming, "./haze", false, "w").file.name, "mine");
  EXPECT_EQ(read_named_medium(naming, "mine", false, "w").file.name, "mine");
  EXPECT_EQ(read_named_medium((here / "haze").string()).file.name, "mine");
  EXPECT_EQ(read_named_medium("haze").name, "preset haze");
  try {
    read_named_medium("radiaton_fog");
    ADD_FAILURE();
  } catch (const Fault& fault) {
    EXPECT_THAT(fault.expected, testing::HasSubstr("did you mean \"radiation_fog\"?"));
  }
  fs::remove_all(here);
}

}  // namespace
}  // namespace tyndall
