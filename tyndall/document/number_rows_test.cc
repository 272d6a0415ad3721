// Files of numbers, and the tables that come from them: what is read, what is refused and how, where references lead.
#include "tyndall/document/number_rows.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <clocale>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <random>

#include "tyndall/document/folder_test.h"
#include "tyndall/document/law_text.h"
#include "tyndall/document/medium_blend.h"
#include "tyndall/document/medium_file.h"
#include "tyndall/document/medium_summary.h"
#include "tyndall/document/whole_file.h"
#include "tyndall/medium/lowered_medium.h"

namespace tyndall {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using tests::fault_of;
using tests::Folder;

const std::string two_columns = "0,10\n90,1\n180,2\n";
const std::string four_columns = "angle red green blue\n0 9 4 1\n60 1 2 1\n180 .5 1 1\n";

std::string medium_text(const std::string& phase) {
  return R"({"format": "tyndall-medium/1", "species": [{"name": "drops", "scattering": [1, 2, 4], "absorption": 0.5,
             "phase": )" +
         phase + "}]}";
}

TEST(NumberRows, ReadEverySeparatorAndLineEnd) {
  for (const char* text : {"1,2.5\n3,-4e1\n", "1;2.5\r\n3;-4e1", "1 2.5\n3\t \t-4e1\n\n",
                           "\xef\xbb\xbf"
                           "1,2.5\n3,-40",
                           "angle, value\n# 7,7\n 1 , 2.5 \n\n+3,-40", "# a\nangle;value;\r\n1;2.5\n3;-40.0"}) {
    const NumberRows rows = parse_number_rows(text, "t");
    EXPECT_EQ(rows.columns, 2U) << text;
    EXPECT_THAT(rows.values, ElementsAre(1.0, 2.5, 3.0, -40.0)) << text;
  }
  EXPECT_THAT(parse_number_rows("x\n+1\n\n2", "t").line, ElementsAre(2U, 4U));
}

// A machine that writes 2,5 for 2.5 reads the same numbers.
TEST(NumberRows, DoNotDependOnTheLocale) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  for (const char* name : {"de_DE.UTF-8", "fr_FR.UTF-8", "de_DE"}) std::setlocale(LC_ALL, name);
  EXPECT_THAT(parse_number_rows("1.5 2.5", "t").values, ElementsAre(1.5, 2.5));
  std::setlocale(LC_ALL, before.c_str());
}

TEST(NumberRows, AreRefusedWithLineAndColumnAndWithoutTheirContents) {
  const auto message = [](const std::string& text) { return fault_of([&] { parse_number_rows(text, "t.csv"); }); };
  EXPECT_THAT(message(""), HasSubstr("no rows"));
  EXPECT_THAT(message("angle,value\n#1,2\n"), HasSubstr("no rows"));
  EXPECT_THAT(message("0,1\n1,nan\n"), HasSubstr("t.csv:2: found a number that is not finite"));
  EXPECT_THAT(message("0,inf"), HasSubstr("t.csv:1:"));
  EXPECT_THAT(message("0,1\n1,1e999\n"), HasSubstr("column 2"));
  EXPECT_THAT(message("0,1\nsecret,1\n"), HasSubstr("t.csv:2: found no number in column 1"));
  EXPECT_THAT(message("0,1\nsecret,1\n"), Not(HasSubstr("secret")));
  EXPECT_THAT(message("0,1\n1,\n"), HasSubstr("no number in column 2"));
  EXPECT_THAT(message("0,1\n1\n"), HasSubstr("1 columns, expected 2"));
  EXPECT_THAT(message("0,1\n1;2\n"), HasSubstr("separated otherwise"));
  EXPECT_THAT(message("0;1\n1;1,5\n"), HasSubstr("t.csv:2: found no number in column 2"));
  EXPECT_THAT(message(std::string("\0\1\2,\n\0,", 7)), HasSubstr("no number"));
  std::string wide = "1";
  for (int i = 0; i < 100; ++i) wide += ",1";
  EXPECT_THAT(message(wide), HasSubstr("more than 64 columns"));
  std::string tall;
  for (int i = 0; i <= 100000; ++i) tall += "1\n";
  EXPECT_THAT(message(tall), HasSubstr("t.csv:100001: found more than 100000 rows"));
}

// Damaged files end in numbers or in a Fault.
TEST(NumberRows, SurviveAnyBytes) {
  std::mt19937 random(5);
  const std::string good = four_columns + "170 1 1 1\n";
  int read = 0;
  for (int i = 0; i < 20000; ++i) {
    std::string text = good;
    for (std::size_t changes = 1 + random() % 4; changes > 0; --changes)
      text[random() % text.size()] =
          static_cast<char>(random() % 8 == 0 ? random() % 256 : "0123456789.0,;- \ne#"[random() % 18]);
    try {
      const NumberRows rows = parse_number_rows(text, "t");
      EXPECT_EQ(rows.values.size(), rows.rows() * rows.columns);
      ++read;
    } catch (const Fault&) {
    }
  }
  EXPECT_GT(read, 100);
}

TEST(TableFile, MeansWhatTheSameNumbersInlineMean) {
  const Folder folder;
  folder.write("t/two.csv", two_columns);
  folder.write("t/four.csv", four_columns);
  const auto law = [&](const std::string& phase) {
    return compile(read_medium_file(folder.write("m.medium.json", medium_text(phase)))).species.at(0).phase;
  };
  const auto d = Deflection<double>::from_angle(0.8);
  const Law<double> two = law(R"({"law": "tabulated", "file": "t/two.csv"})");
  EXPECT_FALSE(is_chromatic(two));
  EXPECT_EQ(density(two, d), density(law(R"({"law": "tabulated", "angles": [0, 90, 180], "values": [10, 1, 2]})"), d));
  const Law<double> four = law(R"({"law": "tabulated", "file": "./t/four.csv"})");
  EXPECT_TRUE(is_chromatic(four));
  const Law<double> inside =
      law(R"({"law": "tabulated", "angles": [0, 60, 180], "values": [[9, 4, 1], [1, 2, 1], [0.5, 1, 1]]})");
  for (std::size_t c = 0; c < channel_count; ++c)
    EXPECT_EQ(density(in_channel(four, c), d), density(in_channel(inside, c), d));
  EXPECT_NEAR(density(in_channel(four, 2), d), 1.0 / (4.0 * std::acos(-1.0)), 1e-15);
}

TEST(TableFile, IsReadOnceAndNamedSoOftenOnly) {
  const Folder folder;
  std::string rows;
  for (int i = 0; i <= 90000; ++i) rows += std::to_string(i / 500.0) + ",1\n";
  folder.write("t.csv", rows);
  const auto named = [&](int times) {
    std::string species;
    for (int i = 0; i < times; ++i) {
      species += std::string(i > 0 ? "," : "") + R"({"scattering": 1, "phase": {"law": "tabulated", "file": "t.csv"}})";
    }
    return read_medium_file(
        folder.write("m.medium.json", R"({"format": "tyndall-medium/1", "species": [)" + species + "]}"));
  };
  const MediumFile two = named(2);
  EXPECT_EQ(std::get<Tabulated<double>>(two.species[0].phase).file->rows,
            std::get<Tabulated<double>>(two.species[1].phase).file->rows);
  EXPECT_THAT(fault_of([&] { named(45); }), HasSubstr("/species/44/phase/file: found one file of numbers too many"));
}

TEST(TableFile, IsRefusedAtItsPlace) {
  const Folder folder;
  const auto message = [&](const std::string& phase) {
    return fault_of([&] { read_medium_file(folder.write("m.medium.json", medium_text(phase))); });
  };
  const auto file_message = [&](const std::string& text) {
    folder.write("t.csv", text);
    return message(R"({"law": "tabulated", "file": "t.csv"})");
  };
  EXPECT_THAT(file_message("angle,value\n0,1\n50,1\n\n40,1\n"), HasSubstr("(line 5, column 1 of the file)"));
  folder.write("good.csv", two_columns);
  EXPECT_THAT(message(R"({"law": "tabulated", "angles": [], "file": "good.csv"})"),
              HasSubstr("/species/0/phase/file: found file beside angles, expected one or the other"));
  EXPECT_THAT(file_message("0,1\n50,1\n50,1\n"), HasSubstr("/species/0/phase/file"));
  EXPECT_THAT(file_message("0,1,1,1\n50,1,-1,1\n"), HasSubstr("(line 2, column 3 of the file)"));
  EXPECT_THAT(file_message("0,1\n181,1\n"), HasSubstr("line 2, column 1"));
  EXPECT_THAT(file_message("0,1\n"), HasSubstr("fewer than 2"));
  EXPECT_THAT(file_message("0,1,2\n9,1,2\n"), HasSubstr("3 columns"));
  EXPECT_THAT(file_message("0,0,1,1\n9,0,2,2\n"), HasSubstr("all 0"));
  EXPECT_THAT(file_message("0 1\n1 nan\n"), HasSubstr("t.csv:2: "));
  folder.write("t.csv", two_columns);
  const auto inline_message = [&](const std::string& rest) { return message(R"({"law": "tabulated")" + rest + "}"); };
  EXPECT_THAT(inline_message(""), HasSubstr("angles and values, or a file"));
  EXPECT_THAT(inline_message(R"(, "angles": [0, 1], "values": [1])"), HasSubstr("as many as there are angles, 2"));
  EXPECT_THAT(inline_message(R"(, "angles": [0, 7, 5], "values": [1, 1, 1])"), HasSubstr("/angles/2"));
  EXPECT_THAT(inline_message(R"(, "angles": [0, 7], "values": [1, [1, 2]])"), HasSubstr("/values/1"));
  EXPECT_THAT(inline_message(R"(, "angles": [0, 7], "values": [1, -1])"), HasSubstr("/values/1"));
  EXPECT_THAT(inline_message(R"(, "angles": [0, 190], "values": [1, 1])"), HasSubstr("/angles/1"));
  EXPECT_THAT(inline_message(R"(, "angles": [0, 9], "values": [1, 1], "file": "t.csv")"),
              HasSubstr("one or the other"));
  EXPECT_THAT(inline_message(R"(, "file": 3)"), HasSubstr("the name of a file"));
}

TEST(TableFile, IsFollowedOnlyBelowTheFolderThatNamesIt) {
  const Folder folder;
  const fs::path outside = folder.write("t.csv", two_columns);
  const auto read = [&](const std::string& name, bool allow) {
    const auto file =
        folder.write("below/m.medium.json", medium_text(R"({"law": "tabulated", "file": ")" + name + "\"}"));
    return fault_of([&] { read_medium_file(file, allow); });
  };
  EXPECT_THAT(read("../t.csv", false), HasSubstr("under the folder"));
  EXPECT_THAT(read(outside.string(), false), HasSubstr("under the folder"));
  EXPECT_EQ(read("../t.csv", true), "no fault");
  fs::create_symlink(outside, folder.path / "below" / "link.csv");
  EXPECT_THAT(read("link.csv", false), HasSubstr("under the folder"));
  EXPECT_THAT(read("", false), HasSubstr("the name of a file"));
  fs::create_directory(folder.path / "below" / "folder.csv");
  EXPECT_THAT(read("folder.csv", false), HasSubstr("no regular file"));
  ASSERT_EQ(::mkfifo((folder.path / "below" / "pipe.csv").c_str(), 0600), 0);
  EXPECT_THAT(read("pipe.csv", false), HasSubstr("no regular file"));
  EXPECT_THAT(read("none.csv", false), HasSubstr("does not exist"));
  std::ofstream(folder.path / "below" / "large.csv");
  fs::resize_file(folder.path / "below" / "large.csv", largest_number_file + 1);
  EXPECT_THAT(read("large.csv", false), HasSubstr("at most 17 MB"));
  // A text without a folder names no files.
  const std::string text = medium_text(R"({"law": "tabulated", "file": "/etc/passwd"})");
  EXPECT_THAT(fault_of([&] { medium_from_json(text, "text"); }), HasSubstr("stands in no folder"));
}

TEST(TableFile, StaysAReferenceWhereTheNewFileCanMakeOne) {
  const Folder folder;
  folder.write("a/t/four.csv", four_columns);
  const MediumFile medium =
      read_medium_file(folder.write("a/m.medium.json", medium_text(R"({"law": "tabulated", "file": "t/four.csv"})")));
  const auto written_to = [&](const std::string& name) {
    fs::create_directories((folder.path / name).parent_path());
    write_medium_file(folder.path / name, medium);
    const MediumFile again = read_medium_file(folder.path / name);
    const auto d = Deflection<double>::from_angle(1.0);
    for (std::size_t c = 0; c < channel_count; ++c)
      EXPECT_EQ(density(in_channel(again.species[0].phase, c), d), density(in_channel(medium.species[0].phase, c), d));
    return std::get<Tabulated<double>>(again.species[0].phase);
  };
  EXPECT_EQ(written_to("a/n.medium.json").file->name, "t/four.csv");
  EXPECT_EQ(written_to("n.medium.json").file->name, "a/t/four.csv");
  EXPECT_EQ(written_to("a/t/n.medium.json").file->name, "four.csv");
  EXPECT_FALSE(written_to("b/n.medium.json").file);
  EXPECT_EQ(written_to("b/n.medium.json").angles.size(), 3U);
  folder.write("a/t/four.csv", two_columns);  // changed since it was read: the numbers that were read count
  EXPECT_FALSE(written_to("a/n.medium.json").file);
}

TEST(TableFile, SpeciesWithDifferentTablesFadeIntoEachOther) {
  const Folder folder;
  folder.write("two.csv", two_columns);
  folder.write("four.csv", four_columns);
  const auto read = [&](const std::string& file) {
    return read_medium_file(
        folder.write("m.medium.json", medium_text(R"({"law": "tabulated", "file": ")" + file + "\"}")));
  };
  const MediumFile a = read("two.csv"), b = read("four.csv");
  EXPECT_THAT(fault_of([&] { blended(a, b, 0.5, BlendHow::interpolate, "t"); }), HasSubstr("different laws"));
  EXPECT_EQ(blended(a, a, 0.5, BlendHow::interpolate, "t").species.size(), 1U);
  for (const BlendHow how : {BlendHow::mix, BlendHow::morph}) {
    const Medium between = compile(blended(a, b, 0.5, how, "t"));
    ASSERT_EQ(between.species.size(), 2U);
    const auto mixture = mixture_at(between);
    const auto d = Deflection<double>::from_angle(0.3);
    for (std::size_t c = 0; c < channel_count; ++c) {
      const double mean =
          0.5 * (density(in_channel(a.species[0].phase, c), d) + density(in_channel(b.species[0].phase, c), d));
      EXPECT_NEAR(density(mixture[c], d), mean, 1e-14);
    }
    EXPECT_EQ(blended(a, a, 0.5, how, "t").species.size(), 1U);
  }
}

TEST(ChromaticTable, IsOneSpeciesToPeopleAndOnePerChannelToLight) {
  const Medium medium = compile(medium_from_json(
      medium_text(R"({"law": "tabulated", "angles": [0, 60, 180], "values": [[9, 4, 1], [1, 2, 1], [0.5, 1, 1]]})"),
      "t"));
  ASSERT_EQ(medium.species.size(), 1U);
  const MediumSummary summary = summary_of(medium);
  ASSERT_EQ(summary.species.size(), 1U);
  EXPECT_EQ(written(summary).at("species").at(0).at("mean_cosine").size(), 3U);
  EXPECT_EQ(summary.species[0].mean_cosine.value, summary.mean_cosine);
  const LoweredMedium lowered = lower(medium);
  ASSERT_EQ(lowered.species.size(), 3U);
  Spectrum scattering, absorption;
  for (std::size_t c = 0; c < channel_count; ++c) {
    const LoweredSpecies& s = lowered.species[c];
    scattering += s.scattering;
    absorption += s.absorption;
    EXPECT_EQ(sum(s.extinction), s.extinction[c]);
    EXPECT_EQ(s.extinction, s.scattering + s.absorption);
    ASSERT_EQ(s.lobe_count, 1U);
    const Law<double> law = in_channel(medium.species[0].phase, c);
    const auto d = Deflection<double>::from_angle(0.5);
    EXPECT_EQ(std::get<TableLobe<double>>(lowered.lobes[s.first_lobe].lobe).density(d), density(law, d));
    EXPECT_EQ(mixture_at(medium)[c].size(), 1U);
    EXPECT_EQ(density(mixture_at(medium)[c], d), density(law, d));
  }
  EXPECT_EQ(scattering, (Spectrum{{1.0, 2.0, 4.0}}));
  EXPECT_EQ(absorption, Spectrum::grey(0.5));
}

}  // namespace
}  // namespace tyndall
