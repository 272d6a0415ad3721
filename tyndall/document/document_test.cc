#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <set>

#include "tyndall/artist/random_dials_test.h"
#include "tyndall/document/binding.h"
#include "tyndall/document/folder_test.h"
#include "tyndall/document/json_locator.h"
#include "tyndall/document/law_text.h"
#include "tyndall/document/medium_blend.h"
#include "tyndall/document/medium_file.h"
#include "tyndall/document/medium_summary.h"
#include "tyndall/document/reference.h"
#include "tyndall/document/whole_file.h"

namespace tyndall {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using tests::Dice;
using tests::fault_of;
using tests::Folder;

MediumFile harbour_fog() {
  return read_medium_file(fs::path(TYNDALL_SOURCE_DIR) / "examples" / "media" / "harbour_fog.medium.json");
}

void expect_same_medium(const Medium& a, const Medium& b, double relative) {
  ASSERT_EQ(a.species.size(), b.species.size());
  for (std::size_t i = 0; i < a.species.size(); ++i) {
    const Species &x = a.species[i], &y = b.species[i];
    EXPECT_EQ(x.name, y.name);
    for (std::size_t c = 0; c < channel_count; ++c) {
      ASSERT_NEAR(x.scattering[c], y.scattering[c], relative * x.extinction()[c]);
      ASSERT_NEAR(x.absorption[c], y.absorption[c], relative * x.extinction()[c]);
    }
    EXPECT_TRUE(same(x.phase, y.phase));
    EXPECT_TRUE(alike(x.profiles, y.profiles));
    const auto nx = numbers_of(x.profiles), ny = numbers_of(y.profiles);
    for (std::size_t k = 0; k < nx.size(); ++k) ASSERT_NEAR(nx[k], ny[k], relative * std::fabs(nx[k]));
  }
}

TEST(Spelling, FindsTheNearestWordAndOnlyNearOnes) {
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
  EXPECT_EQ(edit_distance("hazy", "hayz"), 1u);
  EXPECT_EQ(edit_distance("", "abc"), 3u);
  EXPECT_EQ(nearest_spelling("visibilty", {"extinction", "visibility"}), "visibility");
  EXPECT_EQ(nearest_spelling("g", {"weight"}), "");
  EXPECT_EQ(one_of("x", {}), "nothing");
}

TEST(Spelling, MakesForeignTextSafeToPrint) {
  EXPECT_EQ(in_quotes("fog \x1b[31m\n\t\x7f"), R"("fog \u001b[31m\n\t\u007f")");
  EXPECT_EQ(in_quotes("h\xc3\xa4ze \xff \xe2\x80\xae \xc2\x9b"), "\"h\xc3\xa4ze \\xff \\u202e \\u009b\"");
  EXPECT_EQ(in_quotes(std::string(100, 'x'), 5), "\"xxxxx...\"");
  EXPECT_EQ(in_quotes("\xf0\x9f\x8c\xab\xf0\x9f", 5), "\"\xf0\x9f\x8c\xab\\xf0\\x9f\"");
}

TEST(JsonLocator, FindsTheLineOfAnyValue) {
  const std::string text = "{ \"a\": [1, {\"b\": \"x\\\"}\",\n \"c~/\": 2}],\n\"\\u0064\":\n3,\n\"d\": 4 }";
  EXPECT_EQ(line_of_pointer(text, ""), 1u);
  EXPECT_EQ(line_of_pointer(text, "/a/0"), 1u);
  EXPECT_EQ(line_of_pointer(text, "/a/1/b"), 1u);
  EXPECT_EQ(line_of_pointer(text, "/a/1/c~0~1"), 2u);
  EXPECT_EQ(line_of_pointer(text, "/d"), 3u);
  EXPECT_EQ(line_of_pointer(text, "/d", 1), 5u);
  EXPECT_EQ(line_of_pointer(text, "/e"), 0u);
  EXPECT_EQ(line_of_pointer(text, "/a/7"), 0u);
  EXPECT_EQ(line_of_pointer("", "/a"), 0u);
  EXPECT_EQ(line_of_pointer("{\"a", "/a"), 0u);
}

TEST(Json, AllowsDepth64AndRefuses65) {
  const auto nested = [](int n) {
    return std::string(static_cast<std::size_t>(n), '[') + std::string(static_cast<std::size_t>(n), ']');
  };
  EXPECT_NO_THROW(parse_json(nested(64), "t"));
  EXPECT_THROW(parse_json(nested(65), "t"), Fault);
  EXPECT_THROW(parse_json(std::string(1000000, '['), "t"), Fault);
}

TEST(Json, RefusesLargeFilesWithoutReadingThemWhole) {
  EXPECT_THAT(fault_of([] { read_json("/dev/zero"); }), HasSubstr("more than"));
  EXPECT_THAT(fault_of([] { parse_json(std::string(largest_json + 1, ' '), "t"); }), HasSubstr("bytes"));
}

TEST(Json, MessagesDoNotQuoteForeignFiles) {
  const std::string message = fault_of([] { parse_json("root:$6$secret:19000:0:99999\n", "/etc/shadow"); });
  EXPECT_EQ(message.find("secret"), std::string::npos);
  EXPECT_EQ(message.find("root"), std::string::npos);
  // Nor when the file speaks like the parser, whose message ends in "last read: '..'; expected ':'".
  for (const char* const text :
       {"{\"x'; expected secret\x7f\" s", "{\"x'; expected ':' secret", "\"'; expected '['; secret \xff"}) {
    const std::string imitated = fault_of([&] { parse_json(text, "t"); });
    EXPECT_THAT(imitated, HasSubstr("not JSON"));
    EXPECT_EQ(imitated.find("secret"), std::string::npos) << imitated;
    EXPECT_EQ(imitated.find('\x7f'), std::string::npos) << imitated;
  }
}

TEST(Law, EveryLawIsReadAndWrittenFromItsFields) {
  // Walks the list: a law without usable fields cannot be added.
  for_each_alternative<Law<double>>([]<class L>(std::type_identity<L>) {
    Law<double> law = L{};
    if (auto* mixture = std::get_if<Mixture<double>>(&law)) mixture->parts.push_back({2.0, MieHazy<double>{}});
    if (auto* table = std::get_if<Tabulated<double>>(&law)) {
      *table = {{0.0, 90.0, 170.0}, {Spectrum::grey(3.0), {{1.0, 2.0, 3.0}}, {}}, {}};
    }
    for_each_number(law, {}, "", [](double& x, const FieldFacts&, const std::string&) { x += 0.125; });
    const JsonText text = parse_json(pretty(written(law)), "t");
    EXPECT_TRUE(same(read_as<Law<double>>(JsonCursor(text)), law)) << text.text;
    EXPECT_EQ(text.root.at("law"), L::name);
    for_each_field<L>([]<class M>(const Field<L, M>& field) { EXPECT_FALSE(field.text.empty()); });
  });
}

TEST(LawText, ReadsLawsFromOneWord) {
  const auto law = law_from_text("henyey_greenstein:g=0.7");
  EXPECT_EQ(std::get<HenyeyGreenstein<double>>(law).g, 0.7);
  EXPECT_EQ(std::get<Rayleigh<double>>(law_from_text("rayleigh:depolarisation=2.8e-2")).depolarisation, 0.028);
  EXPECT_TRUE(std::holds_alternative<MieMurky<double>>(law_from_text("mie_murky")));
  EXPECT_TRUE(std::holds_alternative<Mixture<double>>(
      law_from_text(R"({"law": "mixture", "parts": [{"phase": {"law": "isotropic"}}]})")));
  EXPECT_TRUE(is_law_text("isotropic"));
  EXPECT_FALSE(is_law_text("fog.medium.json"));
}

TEST(LawText, AnswersMistakesWithTheNearestSpelling) {
  const auto message = [](const std::string& text) { return fault_of([&] { law_from_text(text); }); };
  EXPECT_THAT(message("henyey_greenstien"), HasSubstr("did you mean \"henyey_greenstein\"?"));
  EXPECT_THAT(message("rayleigh:depolarization=0"), HasSubstr("did you mean \"depolarisation\"?"));
  EXPECT_THAT(message("henyey_greenstein:g=1"), HasSubstr("below 1"));
  EXPECT_THAT(message("henyey_greenstein:g=nan"), HasSubstr("\"nan\""));
  EXPECT_THAT(message("henyey_greenstein:g=0.1,g=0.2"), HasSubstr("second time"));
  for (const char* text : {"", ":", "isotropic:", "henyey_greenstein:g", "henyey_greenstein:g=0.5,", "isotropic:,",
                           "henyey_greenstein:=", "{", "{}", "isotropic:law=isotropic"}) {
    EXPECT_NE(message(text), "no fault") << text;
  }
}

TEST(MediumFile, TheExampleMeansWhatItSays) {
  const MediumFile file = harbour_fog();
  EXPECT_EQ(file.name, "Harbour fog at dawn");
  const Medium medium = compile(file);
  ASSERT_EQ(medium.species.size(), 5u);  // air, hazy, murky, veil, soot
  const double thickness = -std::log(0.05) / 600.0;
  EXPECT_NEAR(medium.species[1].scattering[1], 0.6 * thickness, 1e-16);
  EXPECT_NEAR(medium.species[2].scattering[1], 0.4 * thickness, 1e-16);
  EXPECT_EQ(medium.species[3].scattering, 1e-4 * (Spectrum{{0.95, 0.92, 0.88}}));
  EXPECT_EQ(medium.species[4].absorption, Spectrum::grey(5e-5));
  EXPECT_DOUBLE_EQ(factor(medium.species[1], {0.0, 30.0, 0.0}), std::exp(-1.0));
}

TEST(MediumFile, EveryExampleIsSound) {
  int count = 0;
  for (const auto& entry : fs::directory_iterator(fs::path(TYNDALL_SOURCE_DIR) / "examples" / "media")) {
    if (!entry.path().string().ends_with(".medium.json")) continue;
    EXPECT_NO_THROW(compile(read_medium_file(entry.path()))) << entry.path();
    ++count;
  }
  EXPECT_GE(count, 3);
}

TEST(MediumFile, WrittenAndReadAgainIsTheSameFile) {
  Dice dice(21);
  for (int i = 0; i < 3000; ++i) {
    MediumFile file;
    file.meters_per_unit = dice.magnitude(1e-3, 1e3);
    static_cast<MediumDials&>(file) = in_metres(dice.medium(), 1.0 / file.meters_per_unit);
    file.name = i % 2 == 0 ? "plain" : "quote \" newline \n */ </script> \xE9\x9C\xA7 \\ \x01";
    if (dice.coin()) file.channels = ChannelWavelengths{{611.0, 549.0, 464.0}};
    const std::string text = medium_to_json(file);
    const MediumFile again = medium_from_json(text, "t");
    ASSERT_TRUE(same(file, again)) << text;
    ASSERT_EQ(file.name, again.name);
    ASSERT_EQ(text, medium_to_json(again));
    expect_same_medium(compile(file), compile(again), 0.0);
  }
}

TEST(MediumFile, EveryModelDensityAndKindOfAirIsReadBackAsWritten) {
  // Walks the lists; a model that the random media do not make would be found here.
  Dice dice(24);
  std::set<std::size_t> models, densities, airs, kinds;
  for (int i = 0; i < 3000; ++i) {
    MediumFile file;
    static_cast<MediumDials&>(file) = dice.medium();
    if (file.conditions) models.insert(file.conditions->index());
    for (const StatedSpecies& s : file.species) {
      if (s.density) densities.insert(s.density->index());
    }
    if (file.background) airs.insert(static_cast<std::size_t>(file.background->air));
    if (const auto* m = file.conditions ? std::get_if<Measured>(&*file.conditions) : nullptr) {
      kinds.insert(static_cast<std::size_t>(m->air));
    }
    const MediumFile again = medium_from_json(medium_to_json(file), "t");
    ASSERT_TRUE(same(file, again));
    expect_same_medium(compile(file), compile(again), 0.0);
  }
  EXPECT_EQ(models.size(), std::variant_size_v<Conditions>);
  EXPECT_EQ(densities.size(), std::variant_size_v<Density>);
  EXPECT_EQ(airs.size(), words_of(Air{}).size());
  EXPECT_EQ(kinds.size(), words_of(Particles{}).size());
}

TEST(MediumFile, TheSameMediumInAnotherUnitIsTheSameMedium) {
  Dice dice(22);
  for (int i = 0; i < 1000; ++i) {
    MediumFile metres;
    static_cast<MediumDials&>(metres) = dice.medium();
    for (const double unit : {0.01, 1000.0}) {
      MediumFile other = metres;
      other.meters_per_unit = unit;
      static_cast<MediumDials&>(other) = in_metres(static_cast<const MediumDials&>(metres), 1.0 / unit);
      expect_same_medium(compile(metres), compile(medium_from_json(medium_to_json(other), "t")), 1e-13);
    }
  }
}

TEST(MediumFile, UnitsAreExplicit) {
  const std::string middle = R"("conditions": {"model": "simple", "w": 1, "thickness": )";
  const auto extinction = [&](const std::string& unit, const std::string& thickness) {
    const std::string text =
        "{\"format\": \"tyndall-medium/1\", \"meters_per_unit\": " + unit + ", " + middle + thickness + "}}";
    return compile(medium_from_json(text, "t")).species.at(0).extinction()[1];
  };
  EXPECT_DOUBLE_EQ(extinction("1", "0.002"), 0.002);
  EXPECT_DOUBLE_EQ(extinction("0.01", "0.00002"), 0.002);
  EXPECT_DOUBLE_EQ(extinction("1000", "2"), 0.002);
  EXPECT_DOUBLE_EQ(extinction("1000", R"({"mean_free_path": 0.5})"), 0.002);
  EXPECT_DOUBLE_EQ(extinction("0.01", R"({"visibility": 60000})"), -std::log(0.05) / 600.0);
  EXPECT_DOUBLE_EQ(extinction("0.01", R"({"visibility": [1, 60000, 1], "contrast": 0.02})"), -std::log(0.02) / 600.0);
}

TEST(MediumFile, ExaggerationIsNeverMixedWithTheUnit) {
  const auto air = [](const std::string& rest) {
    return compile(medium_from_json("{\"format\": \"tyndall-medium/1\"" + rest + "}", "t")).species.at(0).scattering;
  };
  EXPECT_EQ(air(R"(, "background": {"air": "note"}, "meters_per_unit": 0.01)"), note_air);
  EXPECT_EQ(air(R"(, "background": {"exaggeration": 20}, "meters_per_unit": 100)"), 20.0 * note_air);
}

TEST(MediumFile, ANumberMeansGreyAndAbsenceMeansNothing) {
  const Medium none = compile(medium_from_json(R"({"format": "tyndall-medium/1"})", "t"));
  EXPECT_TRUE(none.species.empty());
  const Medium soot = compile(medium_from_json(
      R"({"format": "tyndall-medium/1", "species": [{"absorption": 5e-5, "scattering": [0, 1, 2]}]})", "t"));
  EXPECT_EQ(soot.species[0].absorption, Spectrum::grey(5e-5));
  EXPECT_EQ(soot.species[0].scattering, (Spectrum{{0, 1, 2}}));
}

TEST(MediumFile, IsWrittenWholeOrNotAtAll) {
  const Folder folder;
  const fs::path path = folder.write("old.medium.json", "old");
  write_medium_file(path, harbour_fog());
  EXPECT_EQ(read_medium_file(path).name, "Harbour fog at dawn");
  folder.write("old.medium.json", "old");
  MediumFile impossible = harbour_fog();
  impossible.meters_per_unit = 0.0;
  EXPECT_THROW(write_medium_file(path, impossible), Fault);
  EXPECT_EQ(read_whole_text(path, 100), "old");
  EXPECT_THROW(write_medium_file(folder.path / "no" / "such" / "folder.medium.json", harbour_fog()), Fault);
  EXPECT_THROW(write_medium_file(folder.path, harbour_fog()), Fault);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path), fs::directory_iterator()), 1);  // no temporary is left
}

TEST(MediumFile, KeepsWhatWasTyped) {
  const std::string typed = R"({"format": "tyndall-medium/1", "meters_per_unit": 0.01, "conditions": {"model": "simple",
    "w": 0.3, "hold": "visibility", "thickness": {"visibility": 60000, "contrast": 0.02}}})";
  const std::string again = medium_to_json(medium_from_json(typed, "t"));
  for (const char* part : {"\"visibility\": 60000", "\"contrast\": 0.02", "\"hold\": \"visibility\"", "\"w\": 0.3",
                           "\"meters_per_unit\": 0.01"}) {
    EXPECT_THAT(again, HasSubstr(part));
  }
}

TEST(Reference, StaysBelowTheFolderThatNamesIt) {
  const Folder folder;
  const fs::path scene = folder.write("shot/a.scene.json", "{}");
  folder.write("shot/media/fog.medium.json", "{}");
  folder.write("secret.medium.json", "{}");
  fs::create_symlink(folder.path / "secret.medium.json", folder.path / "shot" / "link.medium.json");
  fs::create_directory(folder.path / "shot" / "folder");
  const auto follow = [&](const std::string& name, bool allow) { return referenced_file(scene, name, allow, "t"); };
  EXPECT_EQ(follow("media/fog.medium.json", false), fs::canonical(folder.path / "shot/media/fog.medium.json"));
  EXPECT_NO_THROW(follow("media/../media/fog.medium.json", false));
  for (const std::string& outside : {std::string("../secret.medium.json"), std::string("link.medium.json"),
                                     (folder.path / "secret.medium.json").string()}) {
    EXPECT_THAT(fault_of([&] { follow(outside, false); }), HasSubstr("--allow-path"));
    EXPECT_NO_THROW(follow(outside, true));
  }
  // Whether something exists outside is not told.
  EXPECT_THAT(fault_of([&] { follow("../absent.medium.json", false); }), HasSubstr("--allow-path"));
  EXPECT_THAT(fault_of([&] { follow("absent.medium.json", false); }), HasSubstr("does not exist"));
  EXPECT_THAT(fault_of([&] { follow("folder", false); }), HasSubstr("no regular file"));
  EXPECT_THAT(fault_of([&] { follow("/dev/zero", true); }), HasSubstr("no regular file"));
  EXPECT_THROW(follow("", true), Fault);
  EXPECT_THROW(follow(".", false), Fault);
  EXPECT_THROW(follow(std::string("fog\0.json", 9), true), Fault);
}

TEST(Summary, IsAtTheOriginInSiWithUndefinedAsNull) {
  const MediumSummary vacuum = summary_of(Medium{});
  const OrderedJson json = written(vacuum);
  EXPECT_TRUE(json["mean_free_path"][0].is_null());
  EXPECT_TRUE(json["mean_cosine"][2].is_null());
  EXPECT_TRUE(json["albedo"][1].is_null());
  EXPECT_EQ(json["extinction"], OrderedJson::parse("[0,0,0]"));
  EXPECT_TRUE(json["species"].is_array());
  const MediumSummary fog = summary_of(compile(harbour_fog()));
  for (std::size_t c = 0; c < channel_count; ++c) {
    EXPECT_NEAR(fog.visibility_5[c] * fog.extinction[c], 2.995732273553991, 1e-14);
    EXPECT_NEAR(fog.visibility_2[c] * fog.extinction[c], 3.912023005428146, 1e-14);
    EXPECT_NEAR(fog.albedo[c] * fog.extinction[c], fog.scattering[c], 1e-17);
    EXPECT_NEAR(fog.mean_free_path[c] * fog.extinction[c], 1.0, 1e-15);
  }
}

TEST(Blended, EndsAreTheFilesThemselves) {
  MediumFile a = harbour_fog(), b = a;
  b.name = "other";
  b.meters_per_unit = 0.01;
  for (const BlendHow how : {BlendHow::interpolate, BlendHow::mix, BlendHow::morph}) {
    EXPECT_EQ(medium_to_json(blended(a, b, 0.0, how)), medium_to_json(a));
    EXPECT_EQ(medium_to_json(blended(a, b, 1.0, how)), medium_to_json(b));
  }
  EXPECT_THROW(blended(a, b, 1.5, BlendHow::mix), Fault);
  EXPECT_THROW(blended(a, b, std::nan(""), BlendHow::mix), Fault);
}

TEST(MediumFile, ASchemaBesideItIsFoundFromItsNewPlace) {
  const auto moved = [](const std::string& schema, const fs::path& from, const fs::path& to) {
    MediumFile file;
    file.schema = schema;
    move_schema(file, from, to);
    return *file.schema;
  };
  EXPECT_EQ(moved("../schema/m.json", "/a/media/x.medium.json", "/a/media/y.medium.json"), "../schema/m.json");
  EXPECT_EQ(moved("../schema/m.json", "/a/media/x.medium.json", "/a/out/deep/y.medium.json"), "../../schema/m.json");
  EXPECT_EQ(moved("m.json", "media/x.medium.json", "y.medium.json"), "media/m.json");
  for (const char* fixed : {"https://example.org/m.json", "/usr/share/m.json", "urn:x", ""}) {
    EXPECT_EQ(moved(fixed, "/a/x.medium.json", "/b/y.medium.json"), fixed);
  }
  MediumFile without;
  move_schema(without, "a/x", "y");
  EXPECT_FALSE(without.schema);
}

TEST(MediumFile, SeveralProfilesAreAListAndOneIsItself) {
  const auto read = [](const std::string& profile) {
    return medium_from_json(R"({"format": "tyndall-medium/1", "meters_per_unit": 0.01,
      "species": [{"scattering": 1, "profile": )" +
                                profile + "}]}",
                            "t");
  };
  const std::string height = R"({ "law": "exponential", "scale_height": 250, "base": 0 })";
  const std::string noise =
      R"({ "law": "noise", "scale": 50, "octaves": 4, "contrast": 0.5, "seed": 0, "wind": [1, 0, 0] })";
  const MediumFile both = read("[" + height + ", " + noise + "]");
  EXPECT_EQ(compile(both).species.at(0).profiles,
            (std::vector<Profile>{ExponentialProfile{2.5, 0.0}, NoiseProfile{0.5, 4, 0.5, 0, {0.01, 0.0, 0.0}}}));
  EXPECT_THAT(medium_to_json(both), HasSubstr("\"profile\": [\n"));
  EXPECT_EQ(medium_to_json(medium_from_json(medium_to_json(both), "again")), medium_to_json(both));
  // A list of one means the same as the one, and is written as that.
  const MediumFile one = read(height), listed = read("[" + height + "]");
  EXPECT_TRUE(same(one, listed));
  EXPECT_THAT(medium_to_json(listed), HasSubstr("\"profile\": " + height));
}

TEST(Blended, TakesEachFileInItsOwnUnit) {
  const MediumFile a = harbour_fog();
  MediumFile b = a, b_in_cm = a;
  std::get<Simple>(*b.conditions).thickness = MeanFreePath{Spectrum::grey(50.0)};
  std::get<Simple>(*b.conditions).profile = ExponentialProfile{90.0, 10.0};
  static_cast<MediumDials&>(b_in_cm) = in_metres(static_cast<const MediumDials&>(b), 100.0);
  b_in_cm.meters_per_unit = 0.01;
  for (const BlendHow how : {BlendHow::interpolate, BlendHow::mix, BlendHow::morph}) {
    expect_same_medium(compile(blended(a, b, 0.3, how)), compile(blended(a, b_in_cm, 0.3, how)), 1e-13);
    const MediumFile other_way = blended(b_in_cm, a, 0.7, how);
    EXPECT_EQ(other_way.meters_per_unit, 0.01);
    const auto x = summary_of(compile(blended(a, b, 0.3, how))), y = summary_of(compile(other_way));
    for (std::size_t c = 0; c < channel_count; ++c)
      EXPECT_NEAR(x.extinction[c], y.extinction[c], 1e-12 * x.extinction[c]);
  }
}

TEST(Blended, ResultsCanBeWrittenAndRead) {
  Dice dice(23);
  for (int i = 0; i < 500; ++i) {
    MediumFile a, b;
    static_cast<MediumDials&>(a) = dice.medium();
    b.meters_per_unit = dice.magnitude(0.1, 10.0);
    static_cast<MediumDials&>(b) = in_metres(dice.medium(), 1.0 / b.meters_per_unit);
    for (const BlendHow how : {BlendHow::mix, BlendHow::morph}) {
      const MediumFile between = blended(a, b, dice.between(0.0, 1.0), how);
      EXPECT_TRUE(same(between, medium_from_json(medium_to_json(between), "t")));
    }
  }
}

}  // namespace
}  // namespace tyndall
