// Media that change in time: where a time stands, what is between keys, and what else a file says.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "tyndall/document/medium_blend.h"
#include "tyndall/document/medium_summary.h"

namespace tyndall {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// Two hours of a morning, in kilometres: fog, then the same fog thinner, then haze of another kind.
constexpr const char* morning = R"({"format": "tyndall-medium/1", "name": "Morning", "meters_per_unit": 1000,
  "sources": [{"of": "/keyframes/0/conditions/thickness", "source": "a"}, {"of": "/background", "source": "b"}],
  "background": {"air": "note"},
  "keyframes": [
    {"time": 10, "conditions": {"model": "simple", "w": 0.9, "thickness": {"visibility": 0.2}}},
    {"time": 20, "conditions": {"model": "simple", "w": 0.7, "thickness": {"visibility": 0.8}}},
    {"time": 60, "conditions": {"model": "measured", "air": "continental", "visibility": 20}, "transition": "morph"}]})";

double green_of(const MediumFile& file) { return summary_of(compile(file)).extinction[1]; }
MediumFile at(double time) { return at_time(medium_from_json(morning, "t"), time); }

TEST(Keyframes, AreHeldOutsideAndExactAtTheirTimes) {
  const MediumFile file = medium_from_json(morning, "t");
  for (const auto& [time, key] : {std::pair{-1e9, 0}, {10.0, 0}, {20.0, 1}, {60.0, 2}, {60.0 + 1e-9, 2}, {1e9, 2}}) {
    const MediumFile there = at_time(file, time);
    EXPECT_FALSE(there.keyframes);
    EXPECT_TRUE(same(*there.conditions, (*file.keyframes)[static_cast<std::size_t>(key)].conditions)) << time;
    EXPECT_TRUE(same(there.background, file.background)) << time;
  }
}

TEST(Keyframes, InterpolateWhereNothingElseIsSaid) {
  const MediumFile there = at(12.5);
  const auto& simple = std::get<Simple>(*there.conditions);
  EXPECT_DOUBLE_EQ(simple.w, 0.85);
  const double thick = -std::log(0.05) / 0.2, thin = -std::log(0.05) / 0.8;  // [1/km]
  EXPECT_DOUBLE_EQ(extinction_of(simple.thickness, 1000.0)[1], thick + 0.25 * (thin - thick));
  EXPECT_EQ(there.meters_per_unit, 1000.0);
  EXPECT_EQ(there.name, "Morning");
}

TEST(Keyframes, BlendAsTheLaterKeySays) {
  const MediumFile file = medium_from_json(morning, "t");
  const double from = green_of(at(20.0)), to = green_of(at(60.0));
  EXPECT_NEAR(green_of(at(30.0)), std::pow(from, 0.75) * std::pow(to, 0.25), 1e-12 * from);
  MediumFile mixing = file;
  (*mixing.keyframes)[2].transition = BlendHow::mix;
  EXPECT_NEAR(green_of(at_time(mixing, 30.0)), 0.75 * from + 0.25 * to, 1e-12 * from);
}

TEST(Keyframes, AreTheBlendsOfTheirConditions) {
  const MediumFile file = medium_from_json(morning, "t");
  for (const double share : {0.1, 0.5, 0.9}) {
    const MediumFile between = blended(at_time(file, 20.0), at_time(file, 60.0), share, BlendHow::morph);
    const MediumFile there = at_time(file, 20.0 + 40.0 * share);
    EXPECT_TRUE(same(static_cast<const MediumDials&>(there), static_cast<const MediumDials&>(between))) << share;
  }
}

TEST(Keyframes, AreWrittenAsRead) {
  const MediumFile file = medium_from_json(morning, "t");
  const Json typed = Json::parse(morning), kept = Json::parse(medium_to_json(file));
  EXPECT_EQ(kept["keyframes"].size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(kept["keyframes"][i]["time"], typed["keyframes"][i]["time"]);
    EXPECT_EQ(kept["keyframes"][i]["transition"], i == 2 ? "morph" : "interpolate");
    EXPECT_EQ(kept["keyframes"][i]["conditions"]["model"], typed["keyframes"][i]["conditions"]["model"]);
  }
  EXPECT_FALSE(kept.contains("conditions"));
}

TEST(Keyframes, SourcesOfKeysAreNotThoseOfWhatIsBetween) {
  const MediumFile there = at(15.0);
  ASSERT_EQ(there.sources.size(), 1U);
  EXPECT_EQ(there.sources[0].of, "/background");
}

TEST(Keyframes, AreRemarkedOnOneByOne) {
  MediumFile file = medium_from_json(morning, "t");
  std::get<Simple>((*file.keyframes)[1].conditions).albedo = Spectrum::grey(0.5);
  const auto remarks = remarks_on(file);
  ASSERT_EQ(remarks.size(), 1U);
  EXPECT_EQ(remarks[0].field, "keyframes/1/conditions/albedo");
}

TEST(Keyframes, ABlendOfThemIsOfTheirStateAtTimeZero) {
  const MediumFile file = medium_from_json(morning, "t"), clear = at(60.0);
  for (const double t : {0.0, 0.5}) {
    EXPECT_EQ(medium_to_json(blended(file, clear, t, BlendHow::mix)),
              medium_to_json(blended(at(0.0), clear, t, BlendHow::mix)));
  }
}

/// Two keys, at 0 and 1 s, that differ in these members of a simple model.
MediumFile between_keys(const std::string& a, const std::string& b) {
  const std::string begin = R"("conditions": {"model": "simple", "w": 1, )";
  return medium_from_json(R"({"format": "tyndall-medium/1", "keyframes": [{"time": 0, )" + begin + a +
                              R"(}}, {"time": 1, )" + begin + b + "}}]}",
                          "t");
}
std::string exponential(const std::string& base) {
  return R"(, "profile": {"law": "exponential", "scale_height": 1, "base": )" + base + "}";
}

TEST(Keyframes, HoldWhatTheRestLeavesWhereAVisibilityIsOutOfReachOnTheWay) {
  // Half way the veil and its profile together are thicker than what is held.
  const std::string held = R"("hold": "visibility", "thickness": 1, "veil": {"density": )";
  const MediumFile file = between_keys(held + "10}" + exponential("-2.4"), held + "0.9}" + exponential("0"));
  EXPECT_NEAR(green_of(at_time(file, 0.01)), 1.0, 1e-12);
  EXPECT_NEAR(green_of(at_time(file, 0.5)), 5.45 * std::exp(-1.2), 1e-12);
  EXPECT_GT(green_of(at_time(file, 0.5)), 1.0);
}

TEST(Keyframes, WhatIsNoMediumOnTheWayIsAFaultThatSaysWhen) {
  const MediumFile file =
      between_keys(R"("thickness": 1e30)" + exponential("-60"), R"("thickness": 1)" + exponential("60"));
  for (const double time : {0.0, 0.5, 1.0}) EXPECT_NO_THROW(at_time(file, time));
  try {
    at_time(file, 0.75, "f");
    ADD_FAILURE() << "accepted";
  } catch (const Fault& fault) {
    EXPECT_THAT(fault.found, HasSubstr("too dense"));
    EXPECT_THAT(fault.found, HasSubstr("0.75 s, on the way"));
  }
}

class KeyframesOfVariants : public testing::Test {
 protected:
  KeyframesOfVariants() {
    std::string name = (fs::temp_directory_path() / "tyndall-test-XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
    std::ofstream(folder_ / "morning.medium.json") << morning;
  }
  ~KeyframesOfVariants() override { fs::remove_all(folder_); }
  MediumFile variant(const std::string& members, const std::string& base = "morning.medium.json") const {
    const fs::path file = folder_ / "v.medium.json";
    std::ofstream(file) << R"({"format": "tyndall-medium/1", "base": ")" << base << "\"" << members << "}";
    return read_medium_file(file);
  }
  fs::path folder_;
};

TEST_F(KeyframesOfVariants, AreThoseOfTheBase) {
  const MediumFile file = variant(R"(, "background": {"exaggeration": 2})");
  EXPECT_TRUE(same(file.keyframes, medium_from_json(morning, "t").keyframes));
  EXPECT_EQ(file.background->exaggeration, 2.0);
  ASSERT_EQ(file.sources.size(), 1U);  // that of the background is no longer true
  EXPECT_EQ(file.sources[0].of, "/keyframes/0/conditions/thickness");
}

TEST_F(KeyframesOfVariants, TakeThePlaceOfTheBasesConditionsAndConditionsThatOfKeyframes) {
  const MediumFile still = variant(R"(, "conditions": {"model": "simple", "w": 0.5, "thickness": 1})");
  EXPECT_FALSE(still.keyframes);
  EXPECT_TRUE(still.conditions);
  ASSERT_EQ(still.sources.size(), 1U);  // not of keys that are no longer there
  EXPECT_EQ(still.sources[0].of, "/background");
  const MediumFile moving =
      variant(R"(, "keyframes": [{"time": 0, "conditions": {"model": "simple", "w": 0.5, "thickness": 1}}])", "haze");
  EXPECT_FALSE(moving.conditions);
  EXPECT_EQ(moving.keyframes->size(), 1U);
  for (const Source& source : moving.sources) EXPECT_NE(source.of.rfind("/conditions", 0), 0U) << source.of;
  EXPECT_FALSE(variant(R"(, "keyframes": null)").keyframes);
}

TEST_F(KeyframesOfVariants, KeepTheirLengthsInAnotherUnit) {
  const MediumFile metres = variant(R"(, "meters_per_unit": 1)"), base = medium_from_json(morning, "t");
  EXPECT_EQ(metres.meters_per_unit, 1.0);
  for (const double time : {10.0, 17.0, 40.0, 60.0}) {
    const double expected = green_of(at_time(base, time));
    EXPECT_NEAR(green_of(at_time(metres, time)), expected, 1e-12 * expected) << time;
  }
}

}  // namespace
}  // namespace tyndall
