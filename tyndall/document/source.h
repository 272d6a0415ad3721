#pragma once
// Where a number of a file comes from.
#include <optional>
#include <string>
#include <string_view>
#include <tuple>

#include "tyndall/color/spectrum.h"
#include "tyndall/number/described.h"

namespace tyndall {

/// A statement about one number of a file (or about all below a part of it), for people: nothing is computed from it.
/// Value, unit and wavelength are those of the source, which need not be the file's.
struct Source {
  std::string of;  // RFC 6901, from the file's root: "/conditions/visibility"
  std::optional<Spectrum> value;
  std::string unit;
  std::optional<Spectrum> wavelength_nm;
  std::string source;
  static constexpr auto fields() {
    return std::tuple{
        Field{"of", &Source::of, any_number, "",
              "What the source is of: a JSON pointer from the file's root, for example /conditions/visibility.",
              Scaling::none, true},
        Field{"value", &Source::value, any_number, "", "The number as its source has it, in `unit`."},
        Field{"unit", &Source::unit, any_number, "", "The value's unit; \"1\" where it has none."},
        Field{"wavelength_nm", &Source::wavelength_nm, positive, "nm", "The wavelength, or those of the channels."},
        Field{"source", &Source::source, any_number, "",
              "Author, year, table or page; or that the number is the file's own choice.", Scaling::none, true}};
  }
};

}  // namespace tyndall
