#pragma once
// Two Henyey-Greenstein lobes, each with a thickness of its own: the note's three parameters without their ratio.
#include <optional>
#include <string_view>
#include <tuple>
#include <vector>

#include "tyndall/artist/surroundings.h"
#include "tyndall/artist/two_lobes.h"

namespace tyndall {

/// One lobe: how sharp, and how thick per channel.
struct ExplicitLobe {
  static constexpr std::string_view text = "A lobe of scattering with its own thickness.";
  double g = 0.0;
  Density thickness = PlainExtinction{};
  Spectrum albedo = Spectrum::grey(1.0);
  static constexpr auto fields() {
    return std::tuple{
        Field{"g", &ExplicitLobe::g, Range{-1.0, 1.0, true, true}, "1",
              "Mean cosine of the lobe; positive scatters forward.", Scaling::none, true},
        Field{"thickness", &ExplicitLobe::thickness, any_number, "", "Extinction of the lobe.", Scaling::none, true},
        Field{"albedo", &ExplicitLobe::albedo, unit_interval, "1",
              "Share of what the lobe takes from a beam that is scattered."}};
  }
};

/// Hoobler's note: "The ratio term r could be eliminated completely and replaced with specifying the optical
/// thicknesses for the two HG terms explicitly". Coloured thicknesses make the sharpness of scattering depend on
/// colour.
struct TwoLobesExplicit {
  static constexpr std::string_view name = "two_lobes_explicit";
  static constexpr std::string_view text = "Two lobes, each with its own sharpness and coloured thickness.";
  ExplicitLobe first, second;
  std::optional<Veil> veil = std::nullopt;
  std::optional<Profiles> profile = std::nullopt;
  static constexpr auto fields() {
    return std::tuple{
        Field{"first", &TwoLobesExplicit::first, any_number, "", "The first lobe.", Scaling::none, true},
        Field{"second", &TwoLobesExplicit::second, any_number, "", "The second lobe.", Scaling::none, true},
        Field{"veil", &TwoLobesExplicit::veil, any_number, "", "The even part, as of dust or smoke."},
        Field{"profile", &TwoLobesExplicit::profile, any_number, "",
              "How it varies in space, a list multiplies; absent: not at all."}};
  }
};

/// Adds the model's species; what else is in the medium does not matter to it.
template <class Out>
std::optional<Objection> compile(const TwoLobesExplicit& lobes, const Surroundings& /*others*/, Out& out) {
  const auto add = [&](std::string_view name, const ExplicitLobe& lobe) {
    add_species_of(out, name, extinction_of(lobe.thickness), lobe.albedo, HenyeyGreenstein<double>{lobe.g},
                   factors_of(lobes.profile));
  };
  add("first lobe", lobes.first);
  add("second lobe", lobes.second);
  compile(lobes.veil, lobes.profile, out);
  return std::nullopt;
}

/// What in two lobes, in SI, is unusual or not found in nature.
inline void remark_on(const TwoLobesExplicit& lobes, const Remarks& remarks) {
  remark_on_thickness(lobes.first.thickness, "first/thickness", remarks);
  remark_on_thickness(lobes.second.thickness, "second/thickness", remarks);
  const double first = extinction_of(lobes.first.thickness)[visibility_channel];
  const double second = extinction_of(lobes.second.thickness)[visibility_channel];
  if (first + second > 0.0) {
    remark_on_lobes("first/g", lobes.first.g, lobes.second.g, second / (first + second), remarks);
  }
}

}  // namespace tyndall
