#pragma once
// Random values of anything described, from the descriptions alone: what joins a list of laws, profiles, densities or
// models is drawn here the day it joins.
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "tyndall/artist/keyframes.h"
#include "tyndall/color/spectrum.h"
#include "tyndall/geometry/vector.h"
#include "tyndall/number/demand.h"
#include "tyndall/number/described.h"

namespace tyndall::tests {

/// Values made from a list of choices, and simplest when the list is all zeros or has run out: a property test that
/// shortens the list and lowers its numbers (rapidcheck) shrinks the value with it.
class Chosen {
 public:
  explicit Chosen(std::vector<std::uint32_t> choices) : choices_(std::move(choices)) {}
  static Chosen of_seed(std::uint64_t seed, std::size_t length = 400) {
    std::mt19937_64 engine(seed);
    std::vector<std::uint32_t> choices(length);
    for (auto& c : choices) c = static_cast<std::uint32_t>(engine());
    return Chosen(std::move(choices));
  }

  std::uint32_t next() { return at_ < choices_.size() ? choices_[at_++] : 0; }
  std::size_t below(std::size_t n) { return next() % n; }
  bool one_in(std::size_t n) { return below(n) == n - 1; }
  /// In [0, 1), all 53 bits.
  double share() {
    const double high = next(), low = next();
    return high * 0x1p-32 + std::floor(low * 0x1p-11) * 0x1p-53;
  }

  /// A number of the range: an end of it, a round number or one with all its digits.
  double number(const Range& range) {
    const bool low = std::isfinite(range.low), high = std::isfinite(range.high);
    const auto admitted = [&](double x, double other) { return range.contains(x) ? x : other; };
    const double inside = low && high ? 0.5 * (range.low + range.high)
                          : low       ? range.low + 1.0
                          : high      ? range.high - 1.0
                                      : 0.0;
    switch (below(8)) {
      case 0:
        return inside;
      case 1:
        return admitted(low ? range.low : -1.0, inside);
      case 2:
        return admitted(high ? range.high : 1.0, inside);
      case 3:  // the number next to an excluded end
        return low ? admitted(std::nextafter(range.low, inside), inside) : 1e-3;
      case 4:
        return admitted(static_cast<double>(below(2001)) / 1000.0, inside);
      case 5:
        return admitted(-static_cast<double>(below(2001)) / 1000.0, inside);
      default:
        // 1e30 and its like end a range that is as good as open.
        if (low && high && range.high - range.low < 1e6)
          return admitted(range.low + (range.high - range.low) * share(), inside);
        const double size = std::exp(std::log(1e-6) + std::log(1e12) * share());
        return admitted(low ? range.low + size : one_in(2) ? -size : size, inside);
    }
  }

  std::string text() {
    static const char* const texts[] = {"",
                                        "fog",
                                        "quote \" backslash \\ slash /",
                                        "newline\n tab\t zero-ish\x01",
                                        "\xE9\x9C\xA7 \xF0\x9F\x8C\xAB",
                                        "*/ </script> ${x}",
                                        "$schema",
                                        "1e999"};
    return texts[below(std::size(texts))];
  }

  /// A T of the field's range. `depth` counts choices inside choices: deep ones take their first alternatives.
  template <class T>
  T value(const FieldFacts& facts = {}, int depth = 0) {
    if constexpr (std::is_same_v<T, double>) {
      return number(facts.range);
    } else if constexpr (std::is_same_v<T, int>) {
      const double most = std::min(facts.range.high, 1e6), least = std::max(facts.range.low, -1e6);
      return static_cast<int>(least + std::floor((most - least) * share()));
    } else if constexpr (std::is_same_v<T, bool>) {
      return one_in(2);
    } else if constexpr (std::is_same_v<T, std::string>) {
      return text();
    } else if constexpr (OneOf<T>) {
      return static_cast<T>(below(words_of(T{}).size()));
    } else if constexpr (std::is_same_v<T, Spectrum>) {
      if (!one_in(2)) return Spectrum::grey(number(facts.range));
      Spectrum s;
      for (double& x : s.value) x = number(facts.range);
      return s;
    } else if constexpr (std::is_same_v<T, Vector>) {
      return {number(facts.range), number(facts.range), number(facts.range)};
    } else if constexpr (ArrayMember<T>) {
      T list{};
      for (auto& x : list) x = number(facts.range);
      return list;
    } else if constexpr (OptionalMember<T>) {
      if (!one_in(2)) return std::nullopt;
      return value<typename T::value_type>(facts, depth);
    } else if constexpr (std::is_same_v<T, Keyframes>) {
      return keyframes(depth);
    } else if constexpr (ListMember<T>) {
      T list;
      for (std::size_t n = below(4); n > 0; --n) list.push_back(value<typename T::value_type>(facts, depth));
      return list;
    } else if constexpr (OneOrMoreMember<T>) {
      T several;
      for (auto& element : several.all) element = value<std::remove_cvref_t<decltype(element)>>(facts, depth);
      for (std::size_t n = one_in(3) ? 1 + below(3) : 0; n > 0; --n) {
        several.all.push_back(value<typename decltype(T::all)::value_type>(facts, depth));
      }
      return several;
    } else if constexpr (Choice<T>) {
      const std::size_t chosen = depth < 4 ? below(std::variant_size_v<T>) : 0;
      std::size_t index = 0;
      T out{};
      for_each_alternative<T>([&]<class A>(std::type_identity<A>) {
        // What names a file of voxels is tested in grid_reader_test.cc.
        if constexpr (!std::is_same_v<A, GridProfile>) {
          if (index == chosen) out = value<A>({}, depth + 1);
        }
        ++index;
      });
      return out;
    } else if constexpr (std::is_same_v<T, Tabulated<double>>) {
      return table();
    } else {
      return described<T>(depth);
    }
  }

 private:
  /// Mostly a sound one. Its numbers are its own: what names a file is tested in number_rows_test.cc.
  Tabulated<double> table() {
    Tabulated<double> out;
    for (std::size_t n = 2 + below(4); n > 0; --n) {
      out.angles.push_back(number({0.0, 180.0}));
      out.values.push_back(value<Spectrum>({"values", not_negative, "", ""}));
    }
    if (!one_in(8)) std::sort(out.angles.begin(), out.angles.end());
    if (one_in(16)) out.values.pop_back();
    return out;
  }

  /// Mostly in their order, and mostly alike where they are to be interpolated.
  Keyframes keyframes(int depth) {
    Keyframes out;
    for (std::size_t n = one_in(16) ? 0 : 1 + below(3); n > 0; --n) {
      Keyframe key = value<Keyframe>({}, depth);
      if (!out.empty() && key.transition == BlendHow::interpolate && !one_in(8)) {
        key.conditions = out.back().conditions;
        if (auto* const simple = std::get_if<Simple>(&key.conditions)) simple->w = number(unit_interval);
      }
      out.push_back(std::move(key));
    }
    if (!one_in(8)) {
      std::sort(out.begin(), out.end(), [](const Keyframe& a, const Keyframe& b) { return a.time < b.time; });
    }
    return out;
  }

  /// Mostly one that nothing objects to.
  template <Described T>
  T described(int depth) {
    const bool insist = !one_in(8);
    for (int attempt = 0;; ++attempt) {
      T out{};
      for_each_field<T>([&](const auto& field) {
        using Member = std::remove_cvref_t<decltype(out.*field.member)>;
        out.*field.member = value<Member>(facts_of(field), depth);
        if constexpr (std::is_same_v<Member, std::string>) choose_word(out, field.name, out.*field.member);
      });
      if constexpr (requires { objection_to(out); }) {
        if (insist && attempt < 30 && at_ < choices_.size() && objection_to(out)) continue;
      }
      return out;
    }
  }

  /// Where a text must be one of a list, one of the list.
  template <Described T>
  void choose_word(const T& owner, std::string_view field, std::string& text) {
    if constexpr (requires { demands_of(owner); }) {
      for (const Demand& demand : demands_of(owner)) {
        if (demand.kind != Demand::Kind::one_word_of || demand.names[0] != field || one_in(16)) continue;
        text = demand.words[below(demand.word_count)];
      }
    }
  }

  std::vector<std::uint32_t> choices_;
  std::size_t at_ = 0;
};

}  // namespace tyndall::tests
