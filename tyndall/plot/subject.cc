#include "tyndall/plot/subject.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "tyndall/document/medium_summary.h"
#include "tyndall/phase/merged_lobes.h"

namespace tyndall {
namespace {

constexpr double visible = 0.01;  // relative; less than half a line's width on any axis

}  // namespace

Subject subject_of(std::string name, const Law<double>& law) {
  Subject subject;
  subject.name = std::move(name);
  subject.phase = lower_channels(law);
  for (std::size_t c = 0; c < channel_count; ++c) {
    subject.phase[c] = merged(std::move(subject.phase[c]));
    subject.mean_cosine[c] = mean_cosine(subject.phase[c]);
  }
  subject.albedo = Spectrum::grey(std::nan(""));
  const auto add = [&](std::string part, double share, std::array<LobeSum<double>, channel_count> phase) {
    subject.parts.push_back({std::move(part), Spectrum::grey(share), {}, std::move(phase)});
  };
  if (const auto* mixture = std::get_if<Mixture<double>>(&law)) {
    double total = 0.0;
    for (const auto& part : mixture->parts) total += part.weight;
    for (const auto& part : mixture->parts) {
      add(std::visit([](const auto& l) { return std::string(l.name); }, part.phase), part.weight / total,
          lower_channels(part.phase));
    }
  } else if (!is_chromatic(law)) {  // else each channel is one lobe, its own
    for (const auto& lobe : subject.phase[0]) {
      std::array<LobeSum<double>, channel_count> alone;
      alone.fill({{1.0, lobe.lobe}});
      add("lobe " + std::to_string(subject.parts.size() + 1), lobe.weight, std::move(alone));
    }
  }
  return subject;
}

Subject subject_of(std::string name, const Medium& medium) {
  const MediumSummary summary = summary_of(medium);
  Subject subject;
  subject.name = std::move(name);
  subject.is_medium = true;
  subject.phase = mixture_at(medium);
  subject.extinction.value = summary.extinction;
  subject.albedo.value = summary.albedo;
  subject.mean_cosine.value = summary.mean_cosine;
  for (const SpeciesSummary& s : summary.species) {
    const Spectrum extinction{s.extinction};
    if (is_zero(extinction)) continue;  // elsewhere
    SubjectPart part{s.name.empty() ? s.law : s.name, {}, extinction, lower_channels(s.phase)};
    for (std::size_t c = 0; c < channel_count; ++c) {
      part.share[c] = summary.scattering[c] > 0.0 ? s.scattering[c] / summary.scattering[c] : 0.0;
    }
    subject.parts.push_back(std::move(part));
  }
  return subject;
}

double density_at(const LobeSum<double>& phase, double angle) {
  if (phase.empty()) return 0.0;
  // Near the end, from_angle would round pi - angle away.
  const double s = std::sin(0.5 * angle), c = std::sin(0.5 * (std::numbers::pi - angle));
  return density(phase, Deflection<double>::from_halves(c * c, s * s));
}

DensitySpan density_span(const Subject& subject, double angle) {
  DensitySpan span{std::numeric_limits<double>::infinity(), 0.0};
  for (const auto& phase : subject.phase) {
    if (phase.empty()) continue;
    const double p = density_at(phase, angle);
    span = {std::min(span.low, p), std::max(span.high, p)};
  }
  return span;
}

bool has_coloured_phase(const Subject& subject) {
  for (int degrees = 0; degrees <= 180; degrees += 2) {
    const auto [low, high] = density_span(subject, degrees * std::numbers::pi / 180.0);
    if (high > low * (1.0 + visible)) return true;
  }
  return false;
}

bool has_coloured_extinction(const Subject& subject) {
  return largest(subject.extinction) > smallest(subject.extinction) * (1.0 + visible);
}

bool scatters(const Subject& subject) {
  return std::any_of(subject.phase.begin(), subject.phase.end(), [](const auto& p) { return !p.empty(); });
}

}  // namespace tyndall
