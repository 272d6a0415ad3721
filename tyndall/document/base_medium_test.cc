// Media that build on others: what is merged, where messages point, what is refused.
#include "tyndall/document/base_medium.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>

#include "tyndall/artist/random_dials_test.h"
#include "tyndall/document/medium_file.h"
#include "tyndall/document/named_medium.h"
#include "tyndall/document/preset.h"

namespace tyndall {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class BaseMedium : public testing::Test {
 protected:
  BaseMedium() {
    std::string name = (fs::temp_directory_path() / "tyndall-test-XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
  }
  ~BaseMedium() override { fs::remove_all(folder_); }

  fs::path write(const std::string& name, const std::string& text) const {
    fs::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }
  /// A file with this base and these members.
  fs::path variant(const std::string& name, const std::string& base, const std::string& members = "") const {
    return write(name, R"({"format": "tyndall-medium/1", "base": ")" + base + "\"" +
                           (members.empty() ? "" : ",\n" + members) + "}");
  }
  std::string fault_of(const fs::path& file, bool allow_path = false) const {
    try {
      read_medium_file(file, allow_path);
    } catch (const Fault& fault) {
      return fault.what();
    }
    return "no fault";
  }
  /// What a medium is, but for its name.
  static std::string text_of(MediumFile file) { return medium_to_json(file); }

  fs::path folder_;
};

constexpr const char* fog = R"({"format": "tyndall-medium/1", "name": "Fog", "description": "A fog.",
  "sources": [{"of": "/conditions/w", "source": "a"}, {"of": "/conditions/thickness", "source": "b"}],
  "background": {"air": "note", "exaggeration": 2},
  "conditions": {"model": "simple", "w": 0.7, "thickness": {"visibility": 600, "contrast": 0.02},
    "veil": {"density": 1e-4, "albedo": 0.9}, "profile": {"law": "exponential", "scale_height": 30}},
  "species": [{"name": "soot", "density": 1e-5, "phase": {"law": "henyey_greenstein", "g": 0.5}}, {"density": 2e-5}]})";

TEST_F(BaseMedium, OverridingNothingIsTheBase) {
  for (int seed = 0; seed < 200; ++seed) {
    MediumFile file;
    static_cast<MediumDials&>(file) = tests::Dice(static_cast<std::uint64_t>(seed)).medium();
    file.name = "m";
    const std::string text = medium_to_json(file);
    write("base.medium.json", text);
    const MediumFile again = read_medium_file(variant("v.medium.json", "base.medium.json"));
    EXPECT_EQ(text_of(again), text_of(read_medium_file(folder_ / "base.medium.json"))) << text;
  }
  for (const Preset& preset : presets()) {
    const MediumFile again = read_medium_file(variant("v.medium.json", std::string(preset.name)));
    EXPECT_EQ(text_of(again), text_of(read_named_medium(std::string(preset.name)).file)) << preset.name;
  }
}

TEST_F(BaseMedium, OverridingEverythingIsTheFileItself) {
  for (int seed = 0; seed < 200; ++seed) {
    MediumFile file;
    static_cast<MediumDials&>(file) = tests::Dice(static_cast<std::uint64_t>(seed)).medium();
    MediumFile other;
    static_cast<MediumDials&>(other) = tests::Dice(static_cast<std::uint64_t>(seed) + 1000).medium();
    write("base.medium.json", medium_to_json(other));
    Json upper = Json::parse(medium_to_json(file));
    // What the base alone has is taken away by name.
    const std::function<void(const Json&, Json&)> take_away = [&](const Json& below, Json& above) {
      for (const auto& [key, value] : below.items()) {
        if (!above.contains(key)) {
          above[key] = nullptr;
        } else if (value.is_object() && above[key].is_object()) {
          take_away(value, above[key]);
        }
      }
    };
    take_away(Json::parse(medium_to_json(other)), upper);
    upper["base"] = "base.medium.json";
    EXPECT_EQ(text_of(read_medium_file(write("v.medium.json", upper.dump()))), medium_to_json(file)) << upper;
  }
}

TEST_F(BaseMedium, ObjectsMergeListsAreReplacedNullTakesAway) {
  write("fog.medium.json", fog);
  const MediumFile file = read_medium_file(variant("v.medium.json", "fog.medium.json", R"("name": "Variant",
    "background": {"altitude": 100},
    "conditions": {"w": 0.9, "thickness": {"visibility": 300}, "veil": null, "profile": {"law": "layer", "bottom": 0, "top": 5}},
    "species": [{"density": 3e-5}])"));
  EXPECT_EQ(file.name, "Variant");
  EXPECT_EQ(file.description, "A fog.");
  EXPECT_EQ(file.background->altitude, 100.0);
  EXPECT_EQ(file.background->exaggeration, 2.0);
  const auto& simple = std::get<Simple>(*file.conditions);
  EXPECT_EQ(simple.w, 0.9);
  EXPECT_FALSE(simple.veil);
  EXPECT_NEAR(extinction_of(simple.thickness)[1], -std::log(0.02) / 300.0, 1e-15);  // its contrast is the base's
  EXPECT_TRUE(
      std::holds_alternative<LayerProfile>(simple.profile->all.at(0)));  // another law replaces the whole profile
  ASSERT_EQ(file.species.size(), 1U);
  // Sources of numbers that the variant states are no longer true.
  EXPECT_TRUE(file.sources.empty());
  const MediumFile whiter = read_medium_file(variant("w.medium.json", "fog.medium.json", R"("conditions": {"w": 1})"));
  ASSERT_EQ(whiter.sources.size(), 1U);
  EXPECT_EQ(whiter.sources[0].of, "/conditions/thickness");
}

TEST_F(BaseMedium, AListOfProfilesIsReplacedWhole) {
  write("fog.medium.json", fog);
  write("patchy.medium.json", R"({"format": "tyndall-medium/1", "base": "fog.medium.json", "conditions": {"profile": [
    {"law": "exponential", "scale_height": 20}, {"law": "noise", "scale": 5}]}})");
  const auto profiles_of = [&](const char* base, const std::string& profile) {
    const MediumFile file =
        read_medium_file(variant("v.medium.json", base, R"("conditions": {"profile": )" + profile + '}'));
    return *std::get<Simple>(*file.conditions).profile;
  };
  const Profile exponential = ExponentialProfile{20.0, 0.0}, sphere = SphereProfile{{}, 3.0};
  EXPECT_EQ(profiles_of("patchy.medium.json", R"([{"law": "sphere", "center": [0, 0, 0], "radius": 3}])"),
            Profiles(sphere));
  EXPECT_EQ(profiles_of("patchy.medium.json", R"({"law": "sphere", "center": [0, 0, 0], "radius": 3})"),
            Profiles(sphere));
  // One profile is merged with one only: which of several a number is for could not be told.
  EXPECT_EQ(profiles_of("fog.medium.json", R"({"scale_height": 20})"), Profiles(exponential));
  EXPECT_THROW(profiles_of("patchy.medium.json", R"({"scale_height": 30})"), Fault);
}

TEST_F(BaseMedium, AnotherModelAnotherFormAndAnotherDialReplace) {
  write("fog.medium.json", fog);
  EXPECT_TRUE(std::holds_alternative<Measured>(
      *read_medium_file(variant("a.medium.json", "fog.medium.json",
                                R"("conditions": {"model": "measured", "air": "fog", "visibility": 500})"))
           .conditions));
  const MediumFile other = read_medium_file(
      variant("b.medium.json", "fog.medium.json", R"("conditions": {"thickness": {"mean_free_path": 10}})"));
  EXPECT_NEAR(extinction_of(std::get<Simple>(*other.conditions).thickness)[1], 0.1, 1e-15);
  // Dials that exclude each other: haze states a visibility.
  const auto measured = std::get<Measured>(
      *read_medium_file(variant("c.medium.json", "haze", R"("conditions": {"turbidity": 3})")).conditions);
  EXPECT_FALSE(measured.visibility);
  EXPECT_EQ(measured.turbidity, 3.0);
}

TEST_F(BaseMedium, LevelsBuildOnEachOther) {
  write("deep/fog.medium.json", fog);
  variant("deep/a.medium.json", "fog.medium.json", R"("conditions": {"w": 0.1, "thickness": 5})");
  const MediumFile file =
      read_medium_file(variant("b.medium.json", "deep/a.medium.json", R"("conditions": {"w": 0.2})"));
  const auto& simple = std::get<Simple>(*file.conditions);
  EXPECT_EQ(simple.w, 0.2);
  EXPECT_EQ(extinction_of(simple.thickness)[1], 5.0);
  EXPECT_EQ(simple.veil->albedo[0], 0.9);
}

TEST_F(BaseMedium, LengthsKeepTheirMeaningInAnotherUnit) {
  write("fog.medium.json", fog);
  const MediumFile file =
      read_medium_file(variant("cm.medium.json", "fog.medium.json",
                               R"("meters_per_unit": 0.01, "conditions": {"thickness": {"visibility": 30000}})"));
  EXPECT_EQ(file.meters_per_unit, 0.01);
  const Medium here = compile(file),
               there = compile(read_medium_file(
                   variant("m.medium.json", "fog.medium.json", R"("conditions": {"thickness": {"visibility": 300}})")));
  ASSERT_EQ(here.species.size(), there.species.size());
  for (const Vector p : {Vector{}, Vector{0, 20, 0}}) {
    for (std::size_t c = 0; c < channel_count; ++c) {
      EXPECT_NEAR(scattering_at(here, p)[c] / scattering_at(there, p)[c], 1.0, 1e-12);
    }
  }
}

TEST_F(BaseMedium, FaultsPointToTheFileThatStatesIt) {
  write("fog.medium.json", fog);
  const std::string own = fault_of(variant("v.medium.json", "fog.medium.json", R"("conditions": {"w": 1.5})"));
  EXPECT_THAT(own, HasSubstr("v.medium.json:2: at /conditions/w: found the number 1.5"));
  // What the variant asks for cannot be had with the base's number.
  const std::string base =
      fault_of(variant("h.medium.json", "fog.medium.json",
                       R"("background": {"exaggeration": 1e6}, "conditions": {"hold": "visibility"})"));
  EXPECT_THAT(base, HasSubstr("fog.medium.json:4: at /conditions/thickness"));
  // A base is a medium in itself.
  write("bad.medium.json", "{\"format\": \"tyndall-medium/1\",\n \"conditions\": {\"model\": \"simple\", \"w\": 1}}");
  const std::string bad = fault_of(variant("b.medium.json", "bad.medium.json", R"("conditions": {"thickness": 1})"));
  EXPECT_THAT(bad, HasSubstr("bad.medium.json:2: at /conditions: found no key \"thickness\""));
  const std::string type = fault_of(write("t.medium.json", "{\"format\": \"tyndall-medium/1\",\n\"base\": 5}"));
  EXPECT_THAT(type, HasSubstr("t.medium.json:2: at /base: found the number 5"));
}

TEST_F(BaseMedium, BasesOutsideTheFolderAreRefused) {
  write("fog.medium.json", fog);
  const fs::path file = variant("deep/v.medium.json", "../fog.medium.json");
  EXPECT_THAT(fault_of(file), HasSubstr("under the folder"));
  EXPECT_EQ(fault_of(file, true), "no fault");
  EXPECT_THAT(fault_of(variant("deep/w.medium.json", (folder_ / "fog.medium.json").string())),
              HasSubstr("under the folder"));
  EXPECT_THAT(fault_of(variant("x.medium.json", "fgo.medium.json")), HasSubstr("does not exist"));
  EXPECT_THAT(fault_of(variant("y.medium.json", "")), HasSubstr("the name of a file"));
  EXPECT_THAT(fault_of(variant("z.medium.json", "haize")), HasSubstr("did you mean \"haze\"?"));
  // Text without a folder can have a preset as its base and nothing else.
  EXPECT_NO_THROW(medium_from_json(R"({"format": "tyndall-medium/1", "base": "haze"})", "t"));
  EXPECT_THROW(medium_from_json(R"({"format": "tyndall-medium/1", "base": "fog.medium.json"})", "t"), Fault);
}

TEST_F(BaseMedium, CirclesAndLongChainsAreRefused) {
  variant("a.medium.json", "b.medium.json");
  const fs::path b = variant("b.medium.json", "a.medium.json");
  EXPECT_THAT(fault_of(b), HasSubstr("a.medium.json:1: at /base: found the base \"b.medium.json\", which leads back"));
  EXPECT_THAT(fault_of(variant("self.medium.json", "./self.medium.json")), HasSubstr("leads back to itself"));
  fs::create_symlink("self.medium.json", folder_ / "link.medium.json");
  EXPECT_THAT(fault_of(variant("self.medium.json", "link.medium.json")), HasSubstr("leads back to itself"));
  write("0.medium.json", fog);
  const auto chain = [&](std::size_t length) {
    for (std::size_t i = 1; i <= length; ++i) {
      variant(std::to_string(i) + ".medium.json", std::to_string(i - 1) + ".medium.json");
    }
    return fault_of(folder_ / (std::to_string(length) + ".medium.json"));
  };
  EXPECT_EQ(chain(most_bases), "no fault");
  EXPECT_THAT(chain(most_bases + 1), HasSubstr("more than 16 media"));
}

TEST_F(BaseMedium, TablesOfTheBaseAreFoundBesideTheBase) {
  write("deep/t.csv", "0, 2\n90, 1\n180, 1\n");
  write("deep/base.medium.json", R"({"format": "tyndall-medium/1",
    "species": [{"density": 1, "phase": {"law": "tabulated", "file": "t.csv"}}]})");
  const MediumFile file = read_medium_file(variant("v.medium.json", "deep/base.medium.json", R"("name": "v")"));
  write_medium_file(folder_ / "written.medium.json", file);
  const MediumFile again = read_medium_file(folder_ / "written.medium.json");
  EXPECT_EQ(std::get<Tabulated<double>>(again.species.at(0).phase).file->name, "deep/t.csv");
}

}  // namespace
}  // namespace tyndall
