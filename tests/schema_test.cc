// The schemas against the readers: what one takes the other takes.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "tests/program.h"
#include "tyndall/artist/random_dials_test.h"
#include "tyndall/document/binding.h"
#include "tyndall/document/medium_file.h"
#include "tyndall/document/random_described_test.h"
#include "tyndall/scene/scene_description.h"

namespace tyndall {
namespace {

namespace fs = std::filesystem;
using tests::Chosen;

/// What the reader says of a text: "read"; "parts" where a part of it is wrong by itself; "whole" where the parts do
/// not go together.
struct Verdict {
  std::string verdict, said;
};

template <class Read>
Verdict verdict_of(const std::string& text, Read read) {
  try {
    const JsonText json = parse_json(text, "t");
    read(JsonCursor(json));
    return {"read", ""};
  } catch (const DemandFault& fault) {
    return {"whole", fault.what()};
  } catch (const Fault& fault) {
    // Whether a file is there is nothing that a schema could know.
    return {fault.found.find("the file name ") == 0 ? "whole" : "parts", fault.what()};
  }
}

/// Picks a value somewhere in the tree.
Json& somewhere(Json& root, Chosen& chosen) {
  Json* at = &root;
  while (at->is_structured() && !at->empty() && !chosen.one_in(5)) {
    auto member = at->begin();
    std::advance(member, static_cast<std::ptrdiff_t>(chosen.below(at->size())));
    at = &*member;
  }
  return *at;
}

/// One small mistake, or change for something as good.
void damage(Json& root, Chosen& chosen) {
  Json& at = somewhere(root, chosen);
  if (at.is_object() && !at.empty() && !chosen.one_in(4)) {
    auto member = at.begin();
    std::advance(member, static_cast<std::ptrdiff_t>(chosen.below(at.size())));
    const std::string key = member.key();
    const Json value = member.value();
    switch (chosen.below(4)) {
      case 0:
        at.erase(key);
        return;
      case 1:
        at.erase(key);
        at[key + "s"] = value;
        return;
      case 2:
        at["g"] = 0.5;
        return;
      default:
        at["visibility"] = 100;
        return;
    }
  }
  if (at.is_array() && chosen.one_in(2)) {
    if (at.empty() || chosen.one_in(2)) {
      at.push_back(at.empty() ? Json(1) : at.back());
    } else {
      at.erase(at.size() - 1);
    }
    return;
  }
  if (at.is_string() && chosen.one_in(2)) {
    at = at.get<std::string>() + "x";
    return;
  }
  const Json others[] = {0,
                         1,
                         -1,
                         0.5,
                         -0.5,
                         1.5,
                         1e9,
                         1e31,
                         180,
                         91,
                         true,
                         nullptr,
                         "no",
                         "fog",
                         Json::array(),
                         Json::object(),
                         {1, 2},
                         {0, 0, 0},
                         {1, 2, 3},
                         {{"visibility", 5}},
                         -1e-300,
                         1e-300,
                         16384.5,
                         {1, 2, 3, 4},
                         {{"law", "isotropic"}},
                         {{"law", "constant"}},
                         1e300};
  at = others[chosen.below(std::size(others))];
}

class Schema : public tests::ProgramTest {
 protected:
  /// Random files, as they are and damaged, each with the reader's verdict, go to the validator.
  void agree(int cases, std::uint64_t seed) const {
    const fs::path verdicts = folder_ / "verdicts";
    std::ofstream out(verdicts);
    for (int i = 0; i < cases; ++i) {
      Chosen chosen = Chosen::of_seed(seed + static_cast<std::uint64_t>(i));
      const bool scene = i % 4 == 0, from_dice = i % 4 == 1;
      Json json;
      if (scene) {
        json = Json::parse(pretty(written(chosen.value<SceneDescription>())));
      } else if (from_dice) {  // media as people make them, all sound
        MediumFile file;
        static_cast<MediumDials&>(file) = tests::Dice(seed + static_cast<std::uint64_t>(i)).medium();
        json = Json::parse(medium_to_json(file));
      } else {
        json = Json::parse(medium_to_json(chosen.value<MediumFile>()));
      }
      const std::size_t mistakes = chosen.below(3);
      for (std::size_t n = 0; n < mistakes; ++n) damage(json, chosen);
      const std::string text = json.dump();
      const Verdict verdict = verdict_of(text, [&](const JsonCursor& at) {
        if (scene) {
          const auto read = read_as<SceneDescription>(at);
          const JsonText again = parse_json(pretty(written(read)), "again");
          EXPECT_TRUE(same(read, read_as<SceneDescription>(JsonCursor(again)))) << text;
        } else {
          medium_file_at(at);
        }
      });
      EXPECT_TRUE(!from_dice || mistakes > 0 || verdict.verdict == "read") << verdict.said;
      out << Json{{"kind", scene ? "scene" : "medium"},
                  {"text", text},
                  {"verdict", verdict.verdict},
                  {"said", verdict.said}}
                 .dump()
          << '\n';
    }
    out.close();
    check("'" + verdicts.string() + "'");
  }
  void check(const std::string& arguments) const {
    const fs::path said = folder_ / "said";
    const std::string command = std::string("'") + TYNDALL_PYTHON + "' '" + TYNDALL_SOURCE_DIR +
                                "/tests/schema_check.py' " + arguments + " >'" + said.string() + "' 2>&1";
    const int status = std::system(command.c_str());
    EXPECT_EQ(status, 0) << tests::text_of(said);
    if (status == 0) std::cout << tests::text_of(said);
  }
};
class SchemaSoak : public Schema {};

TEST_F(Schema, TakesGoodFilesAndRefusesBadOnes) { check(""); }
TEST_F(Schema, AgreesWithTheReaders) { agree(3000, 1000); }
TEST_F(SchemaSoak, AgreesWithTheReaders) { agree(200000, 1000000); }

TEST_F(Schema, IsPrintedForAskedFilesOnly) {
  EXPECT_EQ(tyndall("schema").out, tyndall("schema medium").out);
  EXPECT_EQ(Json::parse(tyndall("schema scene").out)["properties"]["format"]["enum"][0], "tyndall-scene/1");
  const tests::Outcome run = tyndall("schema meduim");
  EXPECT_EQ(run.code, 2);
  EXPECT_NE(run.err.find("did you mean \"medium\"?"), std::string::npos) << run.err;
}

}  // namespace
}  // namespace tyndall
