#pragma once
// Which lines a picture of some subjects has, and how each is told from the others.
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "tyndall/plot/figure.h"
#include "tyndall/plot/subject.h"

namespace tyndall {

enum class Quantity { phase, transmittance };

/// The channel that stands for a subject where several are compared: green.
inline constexpr std::size_t reference_channel = channel_count / 2;

struct Line {
  const Subject* subject;
  std::size_t channel;
  const SubjectPart* part;  // none: the whole subject
  Stroke stroke;
  std::string label;  // for the legend
};

/// One subject is drawn by channel (one line where they agree); of several, each has one line, for its reference
/// channel (of a phase function, for one that scatters). With `species`, thin lines for the parts (of one subject the
/// eight that matter most) come first, since they lie beneath. A subject that has no such quantity has no line.
std::vector<Line> lines_of(std::span<const Subject> subjects, Quantity quantity, bool species);

/// The phase function [1/sr] at an angle [radians]: a part counts by its share, so that parts add up to the whole.
double density_of(const Line& line, double angle);
/// [1/m]; a part's alone.
double extinction_of(const Line& line);

/// Whether the subject's channels differ in this quantity.
bool is_coloured(const Subject& subject, Quantity quantity);

/// Names of a line in the SVG.
Attributes attributes_of(const Line& line);

}  // namespace tyndall
