// The schemas against the readers: what one takes the other takes.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <vector>

#include "tests/program.h"
#include "tyndall/artist/random_dials_test.h"
#include "tyndall/document/base_medium.h"
#include "tyndall/document/binding.h"
#include "tyndall/document/medium_file.h"
#include "tyndall/document/preset.h"
#include "tyndall/document/random_described_test.h"
#include "tyndall/scene/scene_description.h"

namespace tyndall {
namespace {

namespace fs = std::filesystem;
using tests::Chosen;
using tests::quoted;

/// What the reader says of a text: "read"; "parts" where a part of it is wrong by itself; "whole" where the parts do
/// not go together.
struct Verdict {
  std::string verdict, said;
};

template <class Read>
Verdict verdict_of(const std::string& text, Read read) {
  try {
    JsonText json = parse_json(text, "t");
    if (json.root.is_object() && json.root.contains("base")) resolve_base(json);
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

/// Every single mistake that a value can be replaced by, given what it is.
std::vector<Json> mistakes_for(const Json& value, bool in_list) {
  if (value.is_number() && in_list) return {"no", nullptr, -1, 0, 1.5, 91, 1e31};
  if (value.is_number()) {
    return {"no",        true,        nullptr,   Json::array(), Json::object(),
            -1,          -1e-300,     0,         1e-300,        0.5,
            1,           1.5,         91,        181,           16385,
            1e31,        {1, 2},      {1, 2, 3}, {0, 0, 0},     {-1, 2, 3},
            {1, 2, "x"}, {1, 2, 3, 4}};
  }
  if (value.is_string()) return {value.get<std::string>() + "x", "", 5, true, nullptr, Json::array(), Json::object()};
  if (value.is_array()) {
    std::vector<Json> out{Json::array(), 5, -1, "no", nullptr, Json::object(), {1, 2, 3, 4}, {0, 0, 0}, {{1, 2}}};
    out.push_back(value);
    out.back().push_back(value.empty() ? Json(1) : value.back());
    if (!value.empty()) (out.push_back(value), out.back().erase(value.size() - 1));
    return out;
  }
  if (value.is_object()) {
    std::vector<Json> out{Json::object(), 5, "no", nullptr, Json::array(), {1, 2, 3}};
    for (const char* const more : {"zzz", "g", "visibility", "w"}) {
      out.push_back(value);
      out.back()[more] = 0.5;
    }
    for (const auto& member : value.items()) {
      for (const bool renamed : {false, true}) {
        out.push_back(value);
        out.back().erase(member.key());
        if (renamed) out.back()[member.key() + "s"] = member.value();
      }
    }
    return out;
  }
  return {5, "no", nullptr};
}

/// Calls visit(damaged root, what was done where) for every single mistake in the tree. The "where" is the same for
/// places that are described alike: the last two keys, with the words that name alternatives.
template <class Visit>
void for_each_mistake(Json& root, Json& at, const std::string& where, bool in_list, Visit&& visit) {
  const Json whole = at;
  std::string here = where.substr(where.find('/', where.find('/') + 1) == where.npos ? 0 : where.find('/') + 1);
  for (const char* const key : {"law", "model", "type"}) {
    if (whole.is_object() && whole.contains(key) && whole[key].is_string()) here += '=' + whole[key].get<std::string>();
  }
  std::size_t n = 0;
  for (const Json& mistake : mistakes_for(whole, in_list)) {
    // A member that is missing or renamed is another mistake than that of its neighbour.
    std::string what = here + " #" + std::to_string(n++);
    if (whole.is_object()) {
      for (const auto& member : whole.items()) {
        if (mistake.is_object() && !mistake.contains(member.key())) what += " -" + member.key();
      }
    }
    at = mistake;
    visit(what);
  }
  at = whole;
  if (!at.is_structured()) return;
  if (at.is_array()) {
    for (Json& element : at) for_each_mistake(root, element, here + "/[]", true, visit);
    return;
  }
  for (auto member = at.begin(); member != at.end(); ++member) {
    for_each_mistake(root, member.value(), here + '/' + member.key(), false, visit);
  }
}

class Schema : public tests::ProgramTest {
 protected:
  /// Random files, as they are and damaged at random, each with the reader's verdict, go to the validator.
  void agree(int cases, std::uint64_t seed) const {
    std::ofstream out(folder_ / "verdicts");
    for (int i = 0; i < cases; ++i) {
      Chosen chosen = Chosen::of_seed(seed + static_cast<std::uint64_t>(i));
      const bool scene = i % 4 == 0, from_dice = i % 4 == 1;
      Json json = drawn(scene, chosen);
      if (from_dice) {  // media as people make them, all sound
        MediumFile file;
        static_cast<MediumDials&>(file) = tests::Dice(seed + static_cast<std::uint64_t>(i)).medium();
        json = Json::parse(medium_to_json(file));
      }
      const bool variant = !scene && chosen.one_in(4);
      if (variant) make_variant(json, chosen);
      const std::size_t mistakes = chosen.below(3);
      for (std::size_t n = 0; n < mistakes; ++n) damage(json, chosen);
      const std::string verdict = judge(json, scene, out);
      EXPECT_TRUE(!from_dice || variant || mistakes > 0 || verdict == "read") << json;
    }
    out.close();
    check(quoted(folder_ / "verdicts"));
  }
  /// Every single mistake in `files` random files, but each only `times` times where places are described alike.
  void agree_on_single_mistakes(int files, int times) const {
    std::ofstream out(folder_ / "verdicts");
    std::map<std::string, int> done;
    for (int i = 0; i < files; ++i) {
      Chosen chosen = Chosen::of_seed(static_cast<std::uint64_t>(i));
      const bool scene = i % 2 == 0;
      Json json = drawn(scene, chosen);
      std::ofstream nowhere;
      if (judge(json, scene, nowhere) != "read") continue;  // its own fault would hide the others
      for_each_mistake(json, json, scene ? "scene" : "medium", false, [&](const std::string& what) {
        if (done[(scene ? "s " : "m ") + what]++ < times) judge(json, scene, out);
      });
    }
    out.close();
    check(quoted(folder_ / "verdicts"));
  }

  static Json drawn(bool scene, Chosen& chosen) {
    return Json::parse(scene ? pretty(written(chosen.value<SceneDescription>()))
                             : medium_to_json(chosen.value<MediumFile>()));
  }
  /// Some of a medium's dials, over a preset.
  static void make_variant(Json& medium, Chosen& chosen) {
    for (const char* const part : {"background", "conditions", "species", "channels", "meters_per_unit", "sources"}) {
      if (chosen.one_in(2)) medium.erase(part);
    }
    for (const char* const key : {"", "conditions", "background"}) {
      if (*key != '\0' && !(medium.contains(key) && medium[key].is_object())) continue;
      Json* const part = *key == '\0' ? &medium : &medium[key];
      for (std::size_t n = chosen.below(3); n > 0 && part->size() > 2; --n) {
        auto member = part->begin();
        std::advance(member, static_cast<std::ptrdiff_t>(chosen.below(part->size())));
        if (member.key() == "format") continue;
        if (chosen.one_in(2)) {
          member.value() = nullptr;
        } else {
          part->erase(member.key());
        }
      }
    }
    medium["base"] = std::string(presets()[chosen.below(presets().size())].name);
  }
  /// A scene as its reader completes it: a medium in place need not say its format.
  static Json with_formats(Json scene) {
    const auto complete = [](Json& owner) {
      if (!owner.is_object() || !owner.contains("medium") || !owner["medium"].is_object()) return;
      if (!owner["medium"].contains("format")) owner["medium"]["format"] = "tyndall-medium/1";
    };
    complete(scene);
    if (scene.is_object() && scene.contains("volumes") && scene["volumes"].is_array()) {
      for (Json& volume : scene["volumes"]) complete(volume);
    }
    return scene;
  }
  /// The reader's verdict, which also goes to `out` with the text.
  static std::string judge(const Json& json, bool scene, std::ofstream& out) {
    const std::string text = json.dump();
    Verdict verdict = verdict_of(scene ? with_formats(json).dump() : text, [&](const JsonCursor& at) {
      if (scene) {
        const auto read = read_as<SceneDescription>(at);
        const JsonText again = parse_json(pretty(written(read)), "again");
        EXPECT_TRUE(same(read, read_as<SceneDescription>(JsonCursor(again)))) << text;
      } else {
        medium_file_at(at);
      }
    });
    // What a part of a variant lacks or contradicts may be the base's.
    if (verdict.verdict == "parts" && !scene && json.is_object() && json.contains("base")) {
      verdict = {"whole", "a variant: " + verdict.said.substr(0, 200)};
    }
    const Json line{
        {"kind", scene ? "scene" : "medium"}, {"text", text}, {"verdict", verdict.verdict}, {"said", verdict.said}};
    out << line.dump() << '\n';
    return verdict.verdict;
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
TEST_F(Schema, AgreesWithTheReaders) { agree(2000, 1000); }
TEST_F(Schema, AgreesWithTheReadersOnEverySingleMistake) { agree_on_single_mistakes(300, 1); }
TEST_F(SchemaSoak, AgreesWithTheReaders) {
  // TYNDALL_SEED: other files.
  const char* const seed = std::getenv("TYNDALL_SEED");
  agree(200000, seed != nullptr ? std::strtoull(seed, nullptr, 10) : 1000000);
}
TEST_F(SchemaSoak, AgreesWithTheReadersOnEverySingleMistake) { agree_on_single_mistakes(4000, 30); }

TEST_F(Schema, IsPrintedForAskedFilesOnly) {
  EXPECT_EQ(tyndall("schema").out, tyndall("schema medium").out);
  EXPECT_EQ(Json::parse(tyndall("schema scene").out)["properties"]["format"]["enum"][0], "tyndall-scene/1");
  const tests::Outcome run = tyndall("schema meduim");
  EXPECT_EQ(run.code, 2);
  EXPECT_NE(run.err.find("did you mean \"medium\"?"), std::string::npos) << run.err;
}

}  // namespace
}  // namespace tyndall
