#pragma once
// The note's three-parameter scattering: two Henyey-Greenstein lobes and what they share.
#include <optional>
#include <string_view>
#include <tuple>
#include <vector>

#include "tyndall/artist/remark.h"
#include "tyndall/artist/standard_air.h"
#include "tyndall/artist/surroundings.h"
#include "tyndall/artist/veil.h"

namespace tyndall {

/// Extinction (1 - r) thickness with lobe g1 and r thickness with lobe g2: r weights the second lobe, as in Hoobler's
/// note (Glassner's r weights the first).
struct TwoLobes {
  static constexpr std::string_view name = "two_lobes";
  static constexpr std::string_view text = "Two lobes of free sharpness, for full control.";
  double r = 0.5, g1 = 0.0, g2 = 0.0;
  Density thickness = PlainExtinction{};
  Spectrum albedo = Spectrum::grey(1.0);
  std::optional<Veil> veil;
  std::optional<Profiles> profile;
  static constexpr auto fields() {
    constexpr Range inside{-1.0, 1.0, true, true};
    return std::tuple{Field{"r", &TwoLobes::r, unit_interval, "1", "Share of the second lobe.", Scaling::none, true},
                      Field{"g1", &TwoLobes::g1, inside, "1",
                            "Mean cosine of the first lobe; positive scatters forward.", Scaling::none, true},
                      Field{"g2", &TwoLobes::g2, inside, "1", "Mean cosine of the second lobe.", Scaling::none, true},
                      Field{"thickness", &TwoLobes::thickness, any_number, "", "Extinction of both lobes together.",
                            Scaling::none, true},
                      Field{"albedo", &TwoLobes::albedo, unit_interval, "1",
                            "Share of what the lobes take from a beam that is scattered."},
                      Field{"veil", &TwoLobes::veil, any_number, "", "The even part, as of dust or smoke."},
                      Field{"profile", &TwoLobes::profile, any_number, "",
                            "How it varies in space, a list multiplies; absent: not at all."}};
  }
};

/// Adds the model's species; what else is in the medium does not matter to it.
template <class Out>
std::optional<Objection> compile(const TwoLobes& lobes, const Surroundings& /*others*/, Out& out) {
  const Spectrum thickness = extinction_of(lobes.thickness);
  add_species_of(out, "first lobe", (1.0 - lobes.r) * thickness, lobes.albedo, HenyeyGreenstein<double>{lobes.g1},
                 factors_of(lobes.profile));
  add_species_of(out, "second lobe", lobes.r * thickness, lobes.albedo, HenyeyGreenstein<double>{lobes.g2},
                 factors_of(lobes.profile));
  compile(lobes.veil, lobes.profile, out);
  return std::nullopt;
}

/// Remarks on two lobes of which the second has the share r.
inline void remark_on_lobes(const std::string& field, double g1, double g2, double r, const Remarks& remarks) {
  if (g1 > g2) {
    remarks.add(
        field,
        "a first lobe that points further forward than the second, " + short_number(g1) + " > " + short_number(g2),
        "the forward lobe second, as in fitted sets; r is the second's share (in Glassner's sets the first's)");
  }
  // A white Lambertian sphere scatters backward as much as any particle in air does.
  const double mean = (1.0 - r) * g1 + r * g2;
  if (mean < -4.0 / 9.0 - 1e-12) {
    remarks.add(field, "a mean cosine of " + short_number(mean) + ", back to where the light comes from",
                "0 (small particles) to 0.9 (fog and rain); -0.44 for a Lambertian sphere");
  }
}

/// What in two lobes, in SI, is unusual or not found in nature.
inline void remark_on(const TwoLobes& lobes, const Remarks& remarks) {
  remark_on_thickness(lobes.thickness, "thickness", remarks);
  remark_on_lobes("g1", lobes.g1, lobes.g2, lobes.r, remarks);
}

}  // namespace tyndall
