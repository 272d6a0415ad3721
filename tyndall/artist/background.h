#pragma once
// The air itself, before any weather: what stays constant through a shot.
#include <array>
#include <optional>
#include <string_view>
#include <tuple>
#include <vector>

#include "tyndall/artist/stated_species.h"

namespace tyndall {

/// Which clean air. More kinds join here, each with its word and its line in compile().
enum class Air { none, note };
constexpr std::array<std::string_view, 2> words_of(Air) { return {"none", "note"}; }

/// Rayleigh scattering of air at sea level, sigma_s per channel [1/m] at 680, 550 and 440 nm, as printed in Hoobler's
/// note (there called optical depth). It is 15 to 20 % above measured air at those wavelengths: see docs/note.md.
inline constexpr Spectrum note_air{{5.8e-6, 1.36e-5, 3.31e-5}};

struct Background {
  static constexpr std::string_view text = "The clean air that is always there.";
  Air air = Air::note;
  double exaggeration = 1.0;
  std::optional<Profile> profile;
  static constexpr auto fields() {
    return std::tuple{
        Field{"air", &Background::air, any_number, "", "The kind of clean air."},
        Field{"exaggeration", &Background::exaggeration, not_negative, "1",
              "Artistic factor on the air's scattering and absorption; 1 is real."},
        Field{"profile", &Background::profile, any_number, "", "How the air varies in space; absent: not at all."}};
  }
};

/// Adds the background's species; those whose coefficients are zero are left out.
inline void compile(const Background& background, std::vector<Species>& out) {
  Species air{"air", {}, {}, Rayleigh<double>{}, profiles_of(background.profile)};
  switch (background.air) {
    case Air::none:
      return;
    case Air::note:
      air.scattering = note_air;
      break;
  }
  air.scattering *= background.exaggeration;
  air.absorption *= background.exaggeration;
  add_unless_void(std::move(air), out);
}

}  // namespace tyndall
