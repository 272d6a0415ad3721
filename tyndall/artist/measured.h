#pragma once
// Weather in measured terms: how far one sees, what is in the air, how large its drops are.
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "tyndall/artist/aerosol.h"
#include "tyndall/artist/channel_tag.h"
#include "tyndall/artist/remark.h"
#include "tyndall/artist/standard_air.h"
#include "tyndall/artist/stated_species.h"
#include "tyndall/artist/surroundings.h"
#include "tyndall/number/demand.h"

namespace tyndall {

/// One species of one kind of particles, its density stated in one of four ways, all at 550 nm and at the origin.
struct Measured {
  static constexpr std::string_view name = "measured";
  static constexpr std::string_view text = "Weather as it is measured: visibility, kind of air, size of droplets.";
  Particles air = Particles::continental;
  std::optional<double> visibility = std::nullopt;
  double contrast = 0.05;
  std::optional<double> extinction = std::nullopt, turbidity = std::nullopt, liquid_water_content = std::nullopt;
  std::optional<double> droplet_diameter = std::nullopt;
  std::optional<Spectrum> albedo = std::nullopt;
  std::optional<double> angstrom_exponent = std::nullopt, mean_cosine = std::nullopt;
  std::optional<Profiles> profile = std::nullopt;
  static constexpr auto fields() {
    return std::tuple{
        Field{"air", &Measured::air, any_number, "", "What is in the air.", Scaling::none, true},
        Field{"visibility", &Measured::visibility, positive, "m",
              "How far one can see through the finished medium at 550 nm.", Scaling::length},
        Field{"contrast", &Measured::contrast, Range{0.0, 1.0, true, true}, "1",
              "Contrast that is still seen: 0.05 (weather reports) or 0.02."},
        Field{"extinction", &Measured::extinction, not_negative, "1/m", "Extinction of the particles at 550 nm.",
              Scaling::inverse_length},
        Field{"turbidity", &Measured::turbidity, not_negative, "1",
              "Optical depth of air and haze together over that of air alone; 2 clear, 6 hazy."},
        Field{"liquid_water_content", &Measured::liquid_water_content, not_negative, "g/m^3",
              "Mass of the drops of fog or rain per volume of air."},
        Field{"droplet_diameter", &Measured::droplet_diameter, Range{smallest_fog_drop, 1e4, false, false}, "um",
              "Effective diameter of the drops of fog (1.5 to 50) or rain (100 to 10000)."},
        Field{"albedo", &Measured::albedo, unit_interval, "1",
              "Share of the extinction that is scattered, where measured; else that of the kind of air."},
        Field{"angstrom_exponent", &Measured::angstrom_exponent, Range{-10.0, 10.0, false, false}, "1",
              "Extinction goes as wavelength to minus this, where measured; else as in the kind of air."},
        Field{"mean_cosine", &Measured::mean_cosine, Range{-1.0, 1.0, true, true}, "1",
              "Mean cosine of scattering, where measured; else that of the kind of air."},
        Field{"profile", &Measured::profile, any_number, "",
              "How it varies in space, a list multiplies; absent: not at all."}};
  }
  double diameter() const { return droplet_diameter.value_or(usual_diameter(air)); }
};

inline std::optional<Objection> objection_to(const Measured& m) {
  const int ways = m.visibility.has_value() + m.extinction.has_value() + m.turbidity.has_value() +
                   m.liquid_water_content.has_value();
  if (ways != 1) {
    return Objection{"", ways == 0 ? "no density" : "more than one density",
                     "one of visibility, extinction, turbidity, liquid_water_content"};
  }
  if (!is_water(m.air) && (m.droplet_diameter || m.liquid_water_content)) {
    return Objection{m.droplet_diameter ? "droplet_diameter" : "liquid_water_content",
                     "drops of water in the air \"" + std::string(word_of(m.air)) + '"', "\"air\": fog or rain"};
  }
  const double d = m.diameter();
  if (m.air == Particles::fog && d > largest_fog_drop) {
    return Objection{"droplet_diameter", "fog of drops of " + short_number(d) + " um",
                     "1.5 to 50 um, which the law of fog is fitted to, or rain"};
  }
  if (m.air == Particles::rain && d < 100.0) {
    return Objection{"droplet_diameter", "rain of drops of " + short_number(d) + " um", "100 to 10000 um, or fog"};
  }
  return std::nullopt;
}

constexpr auto demands_of(const Measured&) {
  return std::array{some_of("visibility", "extinction", "turbidity", "liquid_water_content"),
                    not_both("visibility", "extinction"),
                    not_both("visibility", "turbidity"),
                    not_both("visibility", "liquid_water_content"),
                    not_both("extinction", "turbidity"),
                    not_both("extinction", "liquid_water_content"),
                    not_both("turbidity", "liquid_water_content")};
}

/// Scale height of haze [m] where no exponential profile states one (Bruneton & Neyret 2008).
inline constexpr double usual_haze_height = 1200.0;

/// Extinction of the particles at the origin and 550 nm [1/m] as stated, whether or not there can be that much: a
/// visibility beyond what the surroundings leave gives a negative one. Turbidity T means (T - 1) times the optical
/// depth of the air above the origin, spread over the scale height of the model's profile (Preetham et al. 1999).
inline double stated_extinction_at_550(const Measured& m, const Surroundings& others) {
  if (m.extinction) return *m.extinction;
  if (m.visibility) {
    const double whole = -std::log(m.contrast) / *m.visibility;
    const double rest = at_wavelength(others.extinction, others.wavelengths_nm, 550.0);
    // Rounding may leave a rest that should be all of it a little thicker.
    return rest > whole && rest <= whole * (1.0 + 1e-12) ? 0.0 : whole - rest;
  }
  if (m.turbidity) {
    const auto height = m.profile ? scale_height_of(*m.profile) : std::nullopt;
    return std::fmax(0.0, *m.turbidity - 1.0) * air_optical_depth_above(550.0, others.pressure) /
           height.value_or(usual_haze_height);
  }
  return extinction_of_liquid_water(m.liquid_water_content.value_or(0.0), m.diameter(), 550.0);
}

/// Adds the model's species; objects to a visibility that what else is in the medium leaves no room for.
template <class Out>
std::optional<Objection> compile(const Measured& m, const Surroundings& others, Out& out) {
  if (auto objection = objection_to(m)) return objection;
  const double at_origin = stated_extinction_at_550(m, others);
  if (at_origin < 0.0) {
    const double contrast_factor = -std::log(m.contrast);
    const double farthest = contrast_factor / at_wavelength(others.extinction, others.wavelengths_nm, 550.0);
    return Objection{"visibility",
                     "a visibility of " + short_number(*m.visibility) +
                         " m, when background and other species alone leave " + short_number(farthest) + " m",
                     "a shorter visibility, or less of them"};
  }
  const double here = m.profile ? mean_factor(*m.profile, Vector{}) : 1.0;
  if (!(here > 0.0) || !std::isfinite(here)) {
    return Objection{"profile", "a profile that leaves nothing at the origin, where the air was measured",
                     "one that covers the origin"};
  }
  Spectrum scattering, absorption;
  for (std::size_t c = 0; c < channel_count; ++c) {
    const double nm = others.wavelengths_nm[c];
    const double extinction = at_origin / here * relative_extinction(m.air, m.diameter(), m.angstrom_exponent, nm);
    const double absorbed = m.albedo ? 1.0 - (*m.albedo)[c] : absorbed_share(m.air, m.diameter(), nm);
    absorption[c] = extinction * absorbed;
    scattering[c] = extinction - absorption[c];
  }
  const Law<double> phase =
      m.mean_cosine ? Law<double>{HenyeyGreenstein<double>{*m.mean_cosine}} : law_of(m.air, m.diameter());
  add_species(out, word_of(m.air), scattering, absorption, phase, factors_of(m.profile));
  return std::nullopt;
}

/// Where a measured medium's numbers come from.
inline std::vector<std::string> statements_on(const Measured& m) {
  const double d = m.diameter();
  std::string text = std::string(word_of(m.air)) + ": ";
  if (is_water(m.air)) {
    text += "drops of " + short_number(d) + " um" + (m.droplet_diameter ? "" : " (usual)") +
            ", extinction efficiency " + short_number(std::round(1e3 * drop_extinction_efficiency(d, 550.0)) / 1e3) +
            " (Nussenzveig & Wiscombe 1980)";
    text += m.air == Particles::fog ? ", mean cosine of the fit by Jendersie & d'Eon 2023"
                                    : ", mean cosine of geometrical optics (van de Hulst 1957)";
  } else {
    const Aerosol aerosol = aerosol_of(m.air);
    text += "OPAC (Hess et al. 1998, table 4, 80 % humidity), Angstrom exponents " +
            short_number(aerosol.exponent_below_500) + " and " + short_number(aerosol.exponent_above_500) +
            " below and above 500 nm, albedo " + short_number(aerosol.albedo[1]) + " at 550 nm, mean cosine " +
            short_number(aerosol.mean_cosine);
  }
  if (m.albedo || m.angstrom_exponent || m.mean_cosine) text += "; except what the file states itself";
  return {text};
}

/// What in a measured medium, in SI, is not found in nature.
inline void remark_on(const Measured& m, const Remarks& remarks) {
  if (m.visibility && *m.visibility > farthest_visibility(m.contrast)) {
    remarks.add("visibility", "a visibility of " + short_number(*m.visibility) + " m",
                "at most " + short_number(farthest_visibility(m.contrast)) + " m, through air alone at sea level");
  }
  if (m.visibility && m.air == Particles::fog && -std::log(0.05) / -std::log(m.contrast) * *m.visibility > 1000.0) {
    remarks.add("visibility", "fog with a visibility of " + short_number(*m.visibility) + " m",
                "less than 1000 m (WMO); beyond that it is called mist or haze");
  }
  if (m.turbidity && *m.turbidity < 1.0) {
    remarks.add("turbidity", "a turbidity of " + short_number(*m.turbidity) + ", taken as 1",
                "at least 1, that of air without haze");
  }
  if (m.turbidity && is_water(m.air)) {
    remarks.add("turbidity", "a turbidity of " + std::string(word_of(m.air)),
                "turbidity of haze; fog and rain have a "
                "visibility or a liquid water content");
  }
  if (m.liquid_water_content && m.air == Particles::fog && *m.liquid_water_content > 1.0) {
    remarks.add("liquid_water_content", "fog with " + short_number(*m.liquid_water_content) + " g/m^3 of water",
                "0.01 to 0.5 g/m^3 in fog (Shettle & Fenn 1979), up to 1 in dense cloud");
  }
  if (m.liquid_water_content && m.air == Particles::rain && *m.liquid_water_content > 10.0) {
    remarks.add("liquid_water_content", "rain with " + short_number(*m.liquid_water_content) + " g/m^3 of water",
                "0.3 g/m^3 in moderate rain, up to 10 in a cloudburst");
  }
  if (m.air == Particles::rain && m.diameter() > 5000.0) {
    remarks.add("droplet_diameter", "raindrops of " + short_number(m.diameter()) + " um",
                "at most 5000 um: larger drops break up in falling");
  }
  if (m.albedo && is_water(m.air) && smallest(*m.albedo) < 0.999) {
    remarks.add("albedo", std::string(word_of(m.air)) + " with an albedo of " + short_number(smallest(*m.albedo)),
                "above 0.999: drops of water hardly absorb visible light; put soot or smoke beside them as a species");
  }
  if (m.angstrom_exponent && !(*m.angstrom_exponent >= -0.5 && *m.angstrom_exponent <= 4.0)) {
    remarks.add("angstrom_exponent", "an exponent of " + short_number(*m.angstrom_exponent),
                "-0.5 (drops) to 4 (particles far smaller than the wavelength)");
  }
}

}  // namespace tyndall
