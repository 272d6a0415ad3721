// Hostile medium files: damaged good ones are read or answered with a Fault, never with anything else.
#include <gtest/gtest.h>

#include <filesystem>
#include <random>

#include "tests/cases.h"
#include "tyndall/artist/random_dials_test.h"
#include "tyndall/document/law_text.h"
#include "tyndall/document/medium_file.h"
#include "tyndall/document/medium_summary.h"
#include "tyndall/document/whole_file.h"

namespace tyndall {
namespace {

/// True when it is a medium; a Fault is the only other way out. What is read must also compile, show and write.
bool is_read(const std::string& text) {
  try {
    const MediumFile file = medium_from_json(text, "mutant");
    if (!file.keyframes) summary_of(compile(file));
    for (std::size_t i = 0; file.keyframes && i < file.keyframes->size(); ++i) {
      summary_of(compile(at_time(file, (*file.keyframes)[i].time)));
    }
    medium_from_json(medium_to_json(file), "again");
    return true;
  } catch (const Fault& fault) {
    EXPECT_FALSE(fault.found.empty());
    EXPECT_FALSE(fault.expected.empty());
    return false;
  }
}

std::vector<std::string> good_texts() {
  std::vector<std::string> texts;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::filesystem::path(TYNDALL_SOURCE_DIR) / "examples" / "media")) {
    if (entry.path().extension() == ".json") texts.push_back(read_whole_text(entry.path(), largest_json));
  }
  tests::Dice dice(31);
  for (int i = 0; i < 10; ++i) {
    MediumFile file;
    static_cast<MediumDials&>(file) = dice.medium();
    if (i % 3 == 0 && file.conditions) {  // from the weather that there is to any other and on
      file.keyframes = Keyframes{{-1.0, *file.conditions},
                                 {2.5, dice.two_lobes(), BlendHow::morph},
                                 {4.0, dice.two_lobes_explicit(), BlendHow::mix}};
      file.conditions.reset();
    }
    texts.push_back(medium_to_json(file));
  }
  return texts;
}

/// One to four changes: a bit, a byte, a piece dropped, doubled or moved, a token that means trouble.
std::string mutated(std::string text, std::mt19937_64& random) {
  static const char* const tokens[] = {"1e999", "-", "null", "{", "]", "\"", "\\u0000", "-1e308",  "1e-320", "\"law\"",
                                       "[[[[[", "0", "NaN",  ",", ":", "//", "\xff",    "\"g\":1", "1e308",  "true"};
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % std::max<std::size_t>(n, 1)); };
  for (std::size_t changes = 1 + below(4); changes > 0 && !text.empty(); --changes) {
    const std::size_t at = below(text.size()), length = std::min(below(40), text.size() - at);
    switch (below(6)) {
      case 0:
        text[at] = static_cast<char>(text[at] ^ (1 << below(8)));
        break;
      case 1:
        text[at] = static_cast<char>(below(256));
        break;
      case 2:
        text.erase(at, length);
        break;
      case 3:
        text.insert(below(text.size()), text.substr(at, length));
        break;
      case 4:
        text.replace(at, std::min<std::size_t>(length, 6), tokens[below(std::size(tokens))]);
        break;
      default: {
        // A number for a number.
        const std::size_t digit = text.find_first_of("0123456789", at);
        if (digit == text.npos) break;
        const std::size_t end = text.find_first_not_of("0123456789.eE+-", digit);
        text.replace(digit, std::min(end, text.size()) - digit, tokens[below(std::size(tokens))]);
      }
    }
  }
  return text;
}

void survive(int count, std::uint64_t seed) {
  const auto texts = good_texts();
  std::mt19937_64 random(seed);
  int read = 0;
  for (int i = 0; i < count; ++i) {
    SCOPED_TRACE(i);
    if (is_read(mutated(texts[static_cast<std::size_t>(i) % texts.size()], random))) ++read;
  }
  // Mutations that leave a file good and ones that break it both occur, or the test would say little.
  EXPECT_GT(read, count / 100);
  EXPECT_LT(read, count * 9 / 10);
  tests::say_cases(count, "damaged files, " + std::to_string(read) + " of them still good");
}

TEST(HostileMediumFile, EveryTruncationIsAFault) {
  for (std::string text : good_texts()) {
    text.erase(text.find_last_of('}'));
    for (; !text.empty(); text.pop_back()) ASSERT_FALSE(is_read(text));
  }
}

TEST(HostileMediumFile, MutationsAreReadOrFaults) { survive(5000, 41); }
TEST(HostileMediumFileSoak, MutationsAreReadOrFaults) { survive(1000000, 42); }

TEST(HostileLawText, MutationsAreReadOrFaults) {
  std::mt19937_64 random(43);
  for (int i = 0; i < 5000; ++i) {
    try {
      const auto law = law_from_text(mutated("henyey_greenstein:g=0.7,g=-1e3", random));
      EXPECT_TRUE(std::isfinite(mean_cosine(law)));
    } catch (const Fault&) {
    }
  }
}

}  // namespace
}  // namespace tyndall
