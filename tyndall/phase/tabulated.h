#pragma once
// A law known by numbers at some angles: measured, or computed by Mie's theory.
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "tyndall/color/spectrum.h"
#include "tyndall/number/field.h"
#include "tyndall/number/number_file.h"
#include "tyndall/phase/lobe_sum.h"
#include "tyndall/phase/thinned_table.h"

namespace tyndall {

class Symbol;

/// The most knots that a table may be given with.
inline constexpr std::size_t most_table_knots = 100000;
/// The smallest difference between the angles of neighbouring knots [degrees].
inline constexpr double least_knot_distance = 1e-6;

/// The most knots that laws of numbers T keep; more are thinned (thinned_table.h). Shaders hold their tables in
/// constants, and 512 well chosen knots are good to about 1e-4 for clouds of droplets.
template <class T>
inline constexpr std::size_t knots_kept = most_table_knots + 2;
template <>
inline constexpr std::size_t knots_kept<Symbol> = 512;

/// Values at knots of any angles, linear in mu = cos(angle) between them, held beyond the first and the last. Scale is
/// no matter: the law is normalised by the exact integral. Knots belong where the law bends: dense in the forward peak.
///
/// Either `angles` and `values`, or `file`, whose rows are angle, value or angle, red, green, blue. Without any of them
/// it is isotropic. Values per channel are chromatic: in_channel() gives the law of a channel; by itself such a law
/// means the average of its channels' laws.
template <class T>
struct Tabulated {
  static constexpr std::string_view name = "tabulated";
  static constexpr std::string_view text = "Values at given angles, inline or from a file, grey or per channel.";
  /// Tables are no dials: two of them are the same law or different laws, with none between.
  static constexpr bool whole = true;
  std::vector<double> angles;
  std::vector<Spectrum> values;
  std::optional<NumberFile> file;

  static constexpr auto fields() {
    return std::tuple{
        Field{"angles", &Tabulated::angles, Range{0.0, 180.0}, "degrees",
              "Angles between directions of travel, rising: 0 is straight on."},
        Field{"values", &Tabulated::values, not_negative, "",
              "How much is scattered at each angle per solid angle, on any scale; numbers, or [red, green, blue]."},
        Field{"file", &Tabulated::file, any_number, "",
              "A CSV file of rows angle, value or angle, red, green, blue, instead of angles and values."}};
  }
  bool operator==(const Tabulated& other) const {
    return angles == other.angles && values == other.values && file == other.file;
  }

  bool from_file() const { return file && file->rows; }
  std::size_t size() const { return from_file() ? file->rows->rows() : std::min(angles.size(), values.size()); }
  double angle(std::size_t i) const { return from_file() ? (*file->rows)(i, 0) : angles[i]; }
  double value(std::size_t i, std::size_t channel) const {
    if (!from_file()) return values[i][channel];
    return (*file->rows)(i, file->rows->columns == 2 ? 1 : 1 + channel);
  }
  /// Whether the values differ between channels.
  bool is_chromatic() const {
    if (from_file() && file->rows->columns == 2) return false;
    for (std::size_t c = 1; c < channel_count; ++c) {
      for (std::size_t i = 0; i < size(); ++i)
        if (value(i, c) != value(i, 0)) return true;
    }
    return false;
  }
  /// The values at the knots in one channel, on their own scale.
  TableKnots knots(std::size_t channel) const {
    std::vector<double> degrees, column;
    for (std::size_t i = 0; i < size(); ++i) {
      degrees.push_back(angle(i));
      column.push_back(value(i, channel));
    }
    return TableKnots::of_angles(degrees, column);
  }
  /// The same law with the numbers of its file as its own.
  Tabulated written_out() const {
    Tabulated out;
    for (std::size_t i = 0; i < size(); ++i) {
      out.angles.push_back(angle(i));
      Spectrum& row = out.values.emplace_back();
      for (std::size_t c = 0; c < channel_count; ++c) row[c] = value(i, c);
    }
    return out;
  }
  /// Grey: the law of one channel.
  Tabulated in_channel(std::size_t channel) const {
    Tabulated out;
    for (std::size_t i = 0; i < size(); ++i) {
      out.angles.push_back(angle(i));
      out.values.push_back(Spectrum::grey(value(i, channel)));
    }
    return out;
  }

  /// What the kept knots leave out of a channel's law; 0 unless there are more than knots_kept<T>.
  double thinning_error(std::size_t channel) const { return thinned(knots(channel), knots_kept<T>).error; }

  /// One lobe, or one for each channel.
  LobeSum<T> lower() const {
    const auto lobe = [&](std::size_t channel) {
      return TableLobe<T>{std::make_shared<const ScatteringTable>(thinned(knots(channel), knots_kept<T>).knots)};
    };
    if (!is_chromatic()) return {{T(1.0), lobe(0)}};
    LobeSum<T> out;
    for (std::size_t c = 0; c < channel_count; ++c) out.push_back({T(1.0 / channel_count), lobe(c)});
    return out;
  }
};

/// What is wrong with a table: which knot, whether with its angle or with the value of a channel (none: as a whole).
struct TableFlaw {
  std::size_t knot;
  std::optional<std::size_t> channel;
  bool whole = false;
  std::string found, expected;
};

/// The first thing that keeps numbers from being a law.
template <class T>
std::optional<TableFlaw> flaw_of(const Tabulated<T>& table) {
  const auto flaw = [](std::size_t knot, std::optional<std::size_t> channel, std::string found, std::string expected) {
    return TableFlaw{knot, channel, false, std::move(found), std::move(expected)};
  };
  const auto as_whole = [](std::string found, std::string expected) {
    return TableFlaw{0, std::nullopt, true, std::move(found), std::move(expected)};
  };
  if (table.size() < 2) return as_whole("a table of fewer than 2 angles", "at least 2 angles");
  if (table.size() > most_table_knots) {
    return as_whole("a table of " + std::to_string(table.size()) + " angles",
                    "at most " + std::to_string(most_table_knots));
  }
  bool any[channel_count] = {};
  for (std::size_t i = 0; i < table.size(); ++i) {
    const double angle = table.angle(i);
    if (!(angle >= 0.0 && angle <= 180.0)) return flaw(i, std::nullopt, "no angle from 0 to 180", "degrees, 0 to 180");
    if (i > 0 && !(angle - table.angle(i - 1) >= least_knot_distance)) {
      return flaw(i, std::nullopt, "an angle that is not above the one before it", "angles that rise by at least 1e-6");
    }
    for (std::size_t c = 0; c < channel_count; ++c) {
      const double value = table.value(i, c);
      if (!(value >= 0.0 && std::isfinite(value))) return flaw(i, c, "a value that is not at least 0", "0 or more");
      any[c] = any[c] || value > 0.0;
    }
  }
  for (const bool channel : any) {
    if (!channel) return as_whole("values that are all 0", "a value above 0 in each channel");
  }
  return std::nullopt;
}

}  // namespace tyndall
