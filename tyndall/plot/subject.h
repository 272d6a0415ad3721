#pragma once
// What is drawn: a law, or a medium at a point.
#include <array>
#include <string>
#include <vector>

#include "tyndall/color/spectrum.h"
#include "tyndall/medium/medium.h"
#include "tyndall/phase/lobe_sum.h"

namespace tyndall {

/// One species of a medium, or one part of a law.
struct SubjectPart {
  std::string name;
  Spectrum share;       // of the subject's scattering, 0 to 1
  Spectrum extinction;  // [1/m]; 0 for a law
  std::array<LobeSum<double>, channel_count> phase;
};

struct Subject {
  std::string name;
  bool is_medium = false;  // a law has no extinction
  std::array<std::string, channel_count> channels{"red", "green", "blue"};
  std::array<LobeSum<double>, channel_count> phase;  // empty where nothing scatters
  Spectrum extinction;                               // [1/m]
  Spectrum albedo, mean_cosine;                      // NaN where there is nothing to average
  std::vector<SubjectPart> parts;
};

/// `name` may be anyone's text.
Subject subject_of(std::string name, const Law<double>& law);
/// The medium at the origin.
Subject subject_of(std::string name, const Medium& medium);

/// Density [1/sr] of a channel at an angle [radians, 0 to pi]; 0 where nothing scatters.
double density_at(const LobeSum<double>& phase, double angle);

/// The least and the greatest density [1/sr] of the channels that scatter.
struct DensitySpan {
  double low, high;
};
DensitySpan density_span(const Subject& subject, double angle);

/// Whether the channels differ by enough to be seen: in their laws, in their extinction.
bool has_coloured_phase(const Subject& subject);
bool has_coloured_extinction(const Subject& subject);
bool scatters(const Subject& subject);

}  // namespace tyndall
