#include "tyndall/document/medium_summary.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tyndall/artist/surroundings.h"
#include "tyndall/phase/merged_lobes.h"

namespace tyndall {

double telling_distance(const Spectrum& extinction) {
  const double green = extinction[visibility_channel];
  return green > 0.0 ? std::pow(10.0, std::clamp(std::round(-std::log10(green)), -6.0, 9.0)) : 1000.0;
}

MediumSummary summary_of(const Medium& medium, const Vector& point) {
  MediumSummary out;
  const Spectrum scattering = scattering_at(medium, point), absorption = absorption_at(medium, point);
  const Spectrum extinction = scattering + absorption;
  out.scattering = scattering.value;
  out.absorption = absorption.value;
  out.extinction = extinction.value;
  out.albedo = (scattering / extinction).value;
  out.mean_free_path = (Spectrum::grey(1.0) / extinction).value;
  out.visibility_5 = map(extinction, [](double x) { return visibility_of(x, 0.05); }).value;
  out.visibility_2 = map(extinction, [](double x) { return visibility_of(x, 0.02); }).value;
  out.densities = every_form_of(extinction, telling_distance(extinction), 1.0);
  out.mean_cosine = mean_cosine_at(medium, point).value;
  for (const Species& s : medium.species) {
    const double here = mean_factor(s, point);
    SpeciesSummary summary;
    summary.name = s.name;
    summary.law = std::visit([](const auto& law) { return std::string(law.name); }, s.phase);
    summary.scattering = (s.scattering * here).value;
    summary.absorption = (s.absorption * here).value;
    summary.extinction = (s.extinction() * here).value;
    summary.mean_cosine = mean_cosines(s.phase);
    summary.phase = s.phase;
    summary.profiles = s.profiles;
    out.species.push_back(std::move(summary));
  }
  return out;
}

std::array<LobeSum<double>, channel_count> mixture_at(const Medium& medium, const Vector& point) {
  const Spectrum total = scattering_at(medium, point);
  std::array<LobeSum<double>, channel_count> out;
  for (const Species& s : medium.species) {
    const Spectrum scattering = s.scattering * mean_factor(s, point);
    const auto lobes = lower_channels(s.phase);
    for (std::size_t c = 0; c < channel_count; ++c) {
      if (!(scattering[c] > 0.0)) continue;
      for (const auto& part : lobes[c]) out[c].push_back({scattering[c] / total[c] * part.weight, part.lobe});
    }
  }
  for (LobeSum<double>& lobes : out) lobes = merged(std::move(lobes));
  return out;
}

}  // namespace tyndall
