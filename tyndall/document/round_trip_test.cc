// What is written is read back as the same medium, and what a person typed stays as typed.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <functional>

#include "tyndall/document/medium_file.h"
#include "tyndall/document/random_described_test.h"

namespace tyndall {
namespace {

using tests::Chosen;

/// So many cases of a property, from a fixed seed: a failure is shrunk, printed, and comes back. RC_PARAMS overrides.
bool holds(const std::string& what, int cases, const std::function<void(Chosen)>& property) {
  ::setenv("RC_PARAMS", ("seed=7 max_discard_ratio=50 max_success=" + std::to_string(cases)).c_str(), 0);
  return rc::check(what, [&] {
    const auto choices = *rc::gen::container<std::vector<std::uint32_t>>(300, rc::gen::arbitrary<std::uint32_t>());
    property(Chosen(choices));
  });
}

/// A medium file that is sound; anything else is discarded.
MediumFile sound_file(Chosen& chosen) {
  const auto file = chosen.value<MediumFile>();
  try {
    medium_from_json(medium_to_json(file), "t");
  } catch (const Fault&) {
    RC_DISCARD("not a medium");
  }
  return file;
}

void same_at(const MediumFile& file, const MediumFile& again, double time) {
  const auto [a, b] = [&] {
    try {
      return std::pair{compile(at_time(file, time)), compile(at_time(again, time))};
    } catch (const Fault&) {  // a held visibility may be out of reach between two keys
      RC_DISCARD("no medium then");
    }
  }();
  RC_ASSERT(a.species.size() == b.species.size());
  for (std::size_t i = 0; i < a.species.size(); ++i) {
    RC_ASSERT(a.species[i].name == b.species[i].name);
    RC_ASSERT(a.species[i].scattering == b.species[i].scattering);
    RC_ASSERT(a.species[i].absorption == b.species[i].absorption);
    RC_ASSERT(same(a.species[i].phase, b.species[i].phase));
    RC_ASSERT(same(a.species[i].profiles, b.species[i].profiles));
  }
}

void written_is_read_bit_for_bit(Chosen chosen) {
  const MediumFile file = sound_file(chosen);
  const std::string text = medium_to_json(file);
  const MediumFile again = medium_from_json(text, "t");
  RC_ASSERT(same(file, again));
  RC_ASSERT(medium_to_json(again) == text);
  const std::size_t species = compile(file).species.size();
  RC_CLASSIFY(species > 0, "something in it");
  RC_CLASSIFY(species > 2, "three species or more");
  RC_CLASSIFY(file.keyframes.has_value(), "keyframes");
  // Without keyframes it is the same at all times.
  std::vector<double> times{0.0};
  for (std::size_t i = 0; file.keyframes && i < file.keyframes->size(); ++i) {
    const double time = (*file.keyframes)[i].time;
    times.push_back(time);
    if (i > 0) times.push_back(0.5 * ((*file.keyframes)[i - 1].time + time));
  }
  for (const double time : times) same_at(file, again, time);
}

/// `typed` without some of what may be left out, and with numbers said in other ways.
Json retyped(const Json& typed, Chosen& chosen) {
  if (typed.is_number() && chosen.one_in(4)) return typed.get<double>();  // 1 as 1.0
  Json out = typed;
  if (typed.is_object() || typed.is_array()) {
    for (Json& value : out) value = retyped(value, chosen);
  }
  if (typed.is_object()) {
    for (const auto& member : typed.items()) {
      if (chosen.one_in(8)) out.erase(member.key());
    }
  }
  return out;
}

/// Whether everything in `typed` is in `kept`, number for number. Three equal numbers are kept as the one they mean.
bool is_kept(const Json& typed, const Json& kept) {
  if (typed.is_number()) return kept.is_number() && typed.get<double>() == kept.get<double>();
  if (typed.is_object()) {
    if (!kept.is_object()) return false;
    for (const auto& member : typed.items()) {
      const bool said = !member.value().is_array() || !member.value().empty();  // an empty list says nothing
      const bool text = !member.value().is_string() || !member.value().get_ref<const std::string&>().empty();
      if (kept.contains(member.key()) ? !is_kept(member.value(), kept.at(member.key())) : said && text) return false;
    }
    return true;
  }
  if (typed.is_array()) {
    if (kept.is_number()) {
      for (const Json& x : typed) {
        if (!x.is_number() || x.get<double>() != kept.get<double>()) return false;
      }
      return typed.size() == channel_count;
    }
    if (!kept.is_array() || kept.size() != typed.size()) return false;
    for (std::size_t i = 0; i < typed.size(); ++i) {
      if (!is_kept(typed[i], kept[i])) return false;
    }
    return true;
  }
  return typed == kept;
}

void what_was_typed_is_kept(Chosen chosen) {
  const Json typed = retyped(Json::parse(medium_to_json(sound_file(chosen))), chosen);
  MediumFile file;
  try {
    file = medium_from_json(typed.dump(), "t");
  } catch (const Fault&) {
    RC_DISCARD("something was left out that may not be");
  }
  const Json kept = Json::parse(medium_to_json(file));
  if (!is_kept(typed, kept)) RC_FAIL(typed.dump() + "\nbecame\n" + kept.dump());
}

TEST(RoundTrip, WrittenIsReadBitForBit) { EXPECT_TRUE(holds("round trip", 3000, written_is_read_bit_for_bit)); }
TEST(RoundTrip, WhatWasTypedIsKept) { EXPECT_TRUE(holds("kept", 3000, what_was_typed_is_kept)); }
TEST(RoundTripSoak, WrittenIsReadBitForBit) { EXPECT_TRUE(holds("round trip", 100000, written_is_read_bit_for_bit)); }
TEST(RoundTripSoak, WhatWasTypedIsKept) { EXPECT_TRUE(holds("kept", 100000, what_was_typed_is_kept)); }

TEST(RoundTrip, NumbersAreAsShortAsTheyCanBe) {
  const auto digits = [](const std::string& text) {
    std::string kept;
    for (const char c : text.substr(0, text.find('e'))) {
      if (c >= '0' && c <= '9' && (c != '0' || !kept.empty())) kept += c;
    }
    return kept.substr(0, kept.find_last_not_of('0') + 1).size();
  };
  Chosen chosen = Chosen::of_seed(5, 1000000);
  for (int i = 0; i < 100000; ++i) {
    std::uint64_t bits = std::uint64_t{chosen.next()} << 32 | chosen.next();
    double x = 0.0;
    if (i % 2 == 0) {
      std::memcpy(&x, &bits, sizeof x);
    } else {
      x = static_cast<double>(chosen.below(100000)) * std::pow(10.0, static_cast<double>(chosen.below(40)) - 25.0);
    }
    if (!std::isfinite(x)) continue;
    const std::string text = number_text(x);
    ASSERT_EQ(std::strtod(text.c_str(), nullptr), x) << text;
    ASSERT_EQ(Json::parse(text).get<double>(), x) << text;
    ASSERT_EQ(std::signbit(Json::parse(text).get<double>()), std::signbit(x)) << text;
    std::size_t least = 17;
    for (int precision = 16; precision >= 0; --precision) {
      char shorter[40];
      std::snprintf(shorter, sizeof shorter, "%.*e", precision, x);
      if (std::strtod(shorter, nullptr) != x) break;
      least = digits(shorter);
    }
    ASSERT_LE(digits(text), least) << text;
    ASSERT_LE(text.size(), 24u) << text;
  }
  EXPECT_EQ(number_text(1e-4), "0.0001");
  EXPECT_EQ(number_text(2e-5), "2e-5");
  EXPECT_EQ(number_text(0.1), "0.1");
  EXPECT_EQ(number_text(1e30), "1e+30");
  EXPECT_EQ(number_text(-0.0), "-0.0");
  EXPECT_EQ(number_text(5e-324), "5e-324");
}

}  // namespace
}  // namespace tyndall
