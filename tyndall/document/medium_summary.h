#pragma once
// A medium in numbers at a point: what `show` prints.
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "tyndall/artist/remark.h"
#include "tyndall/artist/stated_species.h"

namespace tyndall {

/// Values per channel that are always written as a list; infinite or undefined ones as null.
using ChannelList = std::array<double, channel_count>;

struct SpeciesSummary {
  std::string name, law;
  ChannelList scattering{}, absorption{}, extinction{};  // [1/m], profile included
  Spectrum mean_cosine;
  Law<double> phase;
  std::vector<Profile> profiles;
  static constexpr auto fields() {
    return std::tuple{Field{"name", &SpeciesSummary::name, any_number, "", "What it is called."},
                      Field{"law", &SpeciesSummary::law, any_number, "", "Name of its law of scattering."},
                      Field{"scattering", &SpeciesSummary::scattering, any_number, "1/m", "Scattering coefficient."},
                      Field{"absorption", &SpeciesSummary::absorption, any_number, "1/m", "Absorption coefficient."},
                      Field{"extinction", &SpeciesSummary::extinction, any_number, "1/m", "Extinction coefficient."},
                      Field{"mean_cosine", &SpeciesSummary::mean_cosine, any_number, "1",
                            "Mean cosine of the deflection; a list where it differs."},
                      Field{"phase", &SpeciesSummary::phase, any_number, "", "The law with its parameters."},
                      Field{"profiles", &SpeciesSummary::profiles, any_number, "", "How it varies in space."}};
  }
};

struct MediumSummary {
  std::string name;
  double exaggeration = 1.0;
  ChannelList scattering{}, absorption{}, extinction{};       // [1/m]
  ChannelList albedo{}, mean_free_path{};                     // 1, [m]
  ChannelList visibility_5{}, visibility_2{}, mean_cosine{};  // [m], [m], 1
  std::vector<SpeciesSummary> species;
  std::vector<Density> densities;             // the extinction in every form; lengths in metres
  std::vector<std::string> sources;           // of numbers that the medium uses without stating them
  std::vector<Remark> warnings;               // what is outside what physics allows
  std::optional<double> time = std::nullopt;  // [s] of what is shown, where it changes
  std::vector<double> keyframes;              // times [s]
  static constexpr auto fields() {
    return std::tuple{
        Field{"name", &MediumSummary::name, any_number, "", "The medium's name."},
        Field{"exaggeration", &MediumSummary::exaggeration, any_number, "1", "Artistic factor on the background."},
        Field{"scattering", &MediumSummary::scattering, any_number, "1/m", "Scattering coefficient."},
        Field{"absorption", &MediumSummary::absorption, any_number, "1/m", "Absorption coefficient."},
        Field{"extinction", &MediumSummary::extinction, any_number, "1/m", "Extinction coefficient, their sum."},
        Field{"albedo", &MediumSummary::albedo, any_number, "1", "Share of the extinction that is scattering."},
        Field{"mean_free_path", &MediumSummary::mean_free_path, any_number, "m", "1 / extinction."},
        Field{"visibility_5", &MediumSummary::visibility_5, any_number, "m", "Distance at which 5 % contrast is left."},
        Field{"visibility_2", &MediumSummary::visibility_2, any_number, "m", "Distance at which 2 % contrast is left."},
        Field{"mean_cosine", &MediumSummary::mean_cosine, any_number, "1", "Of the mixture, weighted by scattering."},
        Field{"species", &MediumSummary::species, any_number, "", "What the medium is made of.", Scaling::none, true},
        Field{"densities", &MediumSummary::densities, any_number, "", "The extinction in every form.", Scaling::none,
              true},
        Field{"sources", &MediumSummary::sources, any_number, "", "Where numbers come from.", Scaling::none, true},
        Field{"warnings", &MediumSummary::warnings, any_number, "", "What is outside what physics allows.",
              Scaling::none, true},
        Field{"time", &MediumSummary::time, any_number, "s", "When the medium is so, where it has keyframes."},
        Field{"keyframes", &MediumSummary::keyframes, any_number, "s", "Times of its keyframes."}};
  }
};

/// The power of ten [m] nearest to the mean free path in green: over that distance transmittance and optical depth are
/// numbers that say something. 1000 where nothing is lost.
double telling_distance(const Spectrum& extinction);

/// The medium at a point [m], without what only the dials know (name, exaggeration, sources, warnings); albedo and mean
/// cosine are NaN where there is nothing to average, lengths infinite where nothing is lost.
MediumSummary summary_of(const Medium& medium, const Vector& point = {});

/// The law of each channel's mixture at a point as a sum of lobes; empty where nothing scatters.
std::array<LobeSum<double>, channel_count> mixture_at(const Medium& medium, const Vector& point = {});

}  // namespace tyndall
