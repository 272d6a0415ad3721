#pragma once
// The air itself, before any weather: what stays constant through a shot.
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "tyndall/artist/channel_tag.h"
#include "tyndall/artist/dials.h"
#include "tyndall/artist/ozone.h"
#include "tyndall/artist/remark.h"
#include "tyndall/artist/standard_air.h"
#include "tyndall/artist/stated_species.h"
#include "tyndall/artist/surroundings.h"

namespace tyndall {

/// Which clean air. More kinds join here, each with its word and its line in air_scattering().
enum class Air { none, note, standard };
constexpr std::array<std::string_view, 3> words_of(Air) { return {"none", "note", "standard"}; }

/// Rayleigh scattering of air at sea level, sigma_s per channel [1/m] at 680, 550 and 440 nm, as printed in Hoobler's
/// note (there called optical depth). It is 15 to 20 % above measured air at those wavelengths: see docs/note.md.
inline constexpr Spectrum note_air{{5.8e-6, 1.36e-5, 3.31e-5}};

struct Background {
  static constexpr std::string_view text = "The clean air that is always there.";
  Air air = Air::note;
  double exaggeration = 1.0;
  std::optional<Profiles> profile = std::nullopt;
  double altitude = 0.0;
  std::optional<double> ozone = std::nullopt;
  static constexpr auto fields() {
    return std::tuple{
        Field{"air", &Background::air, any_number, "",
              "\"note\": the note's triplet; \"standard\": measured air (Bodhaine et al. 1999); or \"none\"."},
        Field{"exaggeration", &Background::exaggeration, not_negative, "1",
              "Artistic factor on the air's scattering and absorption; 1 is real."},
        Field{"profile", &Background::profile, any_number, "",
              "How the air varies in space; absent: not at all. Real air: exponential, scale height about 8 km."},
        Field{"altitude", &Background::altitude, any_number, "m",
              "Height of the scene's origin above the sea: air is thinner up there.", Scaling::length},
        Field{"ozone", &Background::ozone, not_negative, "DU",
              "Column of the ozone layer in Dobson units, 10 to 40 km above the sea; Earth has about 300."}};
  }
};

/// Scattering coefficient per channel [1/m] of a kind of air at sea level. The note's triplet is taken as it is
/// whatever the channels mean.
inline Spectrum air_scattering(Air air, const Spectrum& wavelengths_nm) {
  switch (air) {
    case Air::none:
      break;
    case Air::note:
      return note_air;
    case Air::standard:
      return map(wavelengths_nm, standard_air_scattering);
  }
  return {};
}

/// The law of a kind of air. Standard air is depolarised as its King factor in the green channel says (0.0284 at 550
/// nm); between 440 and 680 nm its law differs from that by less than 0.05 %.
inline Rayleigh<double> air_law(Air air, const Spectrum& wavelengths_nm) {
  return {air == Air::standard ? depolarisation_of(king_factor(wavelengths_nm[visibility_channel])) : 0.0};
}

/// Adds the background's species, air first, then ozone; those whose coefficients are zero are left out. Both are as
/// thick as they are at the origin's altitude. Objects to channels at which no data exist.
template <class Out>
std::optional<Objection> compile(const Background& background, const Spectrum& wavelengths_nm, Out& out) {
  if (!(background.altitude >= lowest_altitude && background.altitude <= highest_altitude)) {
    return Objection{"background/altitude", "an altitude of " + short_number(background.altitude) + " m",
                     "one from -5000 to 86000 m, where the standard atmosphere is defined"};
  }
  for (const double nm : wavelengths_nm.value) {
    if (background.air == Air::standard && nm < 230.0) {
      return Objection{"channels/wavelengths_nm", short_number(nm) + " nm, where the formula of standard air fails",
                       "wavelengths from 230 nm, or other air"};
    }
    if (background.ozone && !is_in_ozone_table(nm)) {
      return Objection{"channels/wavelengths_nm", short_number(nm) + " nm, where ozone's absorption is not tabulated",
                       "wavelengths from 360 to below 840 nm, or no ozone"};
    }
  }
  const double density = standard_air_at(background.altitude).relative_density * background.exaggeration;
  add_species(out, "air", air_scattering(background.air, wavelengths_nm) * density, {},
              air_law(background.air, wavelengths_nm), factors_of(background.profile));
  if (background.ozone) {
    const Spectrum absorption = map(wavelengths_nm, [&](double nm) { return ozone_absorption(nm, *background.ozone); });
    const Profile layer = TentProfile{ozone_centre - background.altitude, ozone_half_width};
    add_species(out, "ozone", {}, absorption * background.exaggeration, Isotropic<double>{}, {&layer, 1});
  }
  return std::nullopt;
}

/// What a background in SI stands for, in words and numbers that can be looked up.
inline std::vector<std::string> statements_on(const Background& background, const Spectrum& wavelengths_nm) {
  std::vector<std::string> out;
  const AirState state = standard_air_at(background.altitude);
  std::string channels;
  for (const double nm : wavelengths_nm.value) channels += (channels.empty() ? "" : ", ") + short_number(nm);
  const auto rounded = [](double x) { return short_number(std::round(x * 10.0) / 10.0); };
  const std::string weather = rounded(state.temperature) + " K, " + rounded(state.pressure / 100.0) + " hPa";
  const std::string where = background.altitude == 0.0
                                ? "sea level (" + weather + ")"
                                : short_number(background.altitude) + " m above the sea (" + weather + ", density " +
                                      rounded(100.0 * state.relative_density) + " % of that at the sea)";
  if (background.air == Air::note) out.push_back("air: the note's triplet, 15 to 20 % above measured air, at " + where);
  if (background.air == Air::standard) {
    out.push_back("air: Bodhaine et al. 1999 at " + channels + " nm, depolarisation " +
                  short_number(std::round(1e4 * air_law(background.air, wavelengths_nm).depolarisation) / 1e4) +
                  ", at " + where);
  }
  if (background.ozone) {
    out.push_back("ozone: " + short_number(*background.ozone) +
                  " DU, absorbing only, from 10 over 25 to 40 km above the sea; cross sections at " + channels +
                  " nm (Gorshelev et al. 2014)");
  }
  return out;
}

/// Whether two backgrounds are the same but for their exaggeration, so that what lies between them is the same air.
inline bool differ_in_exaggeration_only(Background a, const Background& b) {
  a.exaggeration = b.exaggeration;
  return same(a, b);
}

/// What in a background, in SI, is not found on Earth.
inline void remark_on(const Background& background, const Spectrum& wavelengths_nm, const Remarks& remarks) {
  if (background.exaggeration != 1.0 && (background.air != Air::none || background.ozone)) {
    remarks.add("exaggeration", "air exaggerated by a factor of " + short_number(background.exaggeration),
                "1: real air scatters as stated");
  }
  // R T / (M g) for 200 to 310 K, the coldest and warmest air near the ground.
  const auto height = background.profile ? scale_height_of(*background.profile) : std::nullopt;
  if (height && !(*height >= 5850.0 && *height <= 9100.0)) {
    const bool alone = background.profile->all.size() == 1;
    remarks.add(alone ? "profile/scale_height" : "profile",
                "air that thins by a factor e every " + short_number(*height) + " m",
                "5.9 km (200 K) to 9.1 km (310 K); 8 km is usual");
  }
  // Daily columns go from some 80 DU in the deepest ozone holes to some 600 DU in Arctic spring.
  if (background.ozone && *background.ozone != 0.0 && !(*background.ozone >= 80.0 && *background.ozone <= 650.0)) {
    remarks.add("ozone", "a column of " + short_number(*background.ozone) + " DU",
                "80 DU (ozone hole) to 650 DU; 300 DU is usual");
  }
  if (background.air == Air::standard && largest(wavelengths_nm) > 1690.0) {
    remarks.add("air", "standard air at " + short_number(largest(wavelengths_nm)) + " nm",
                "230 to 1690 nm, where its refractive index was measured (Peck & Reeder 1972)");
  }
}

}  // namespace tyndall
