#pragma once
// Laws and media as a figure for print: phase functions, transmittance, and the numbers beneath.
#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "tyndall/plot/figure.h"
#include "tyndall/plot/subject.h"

namespace tyndall {

enum class Panel { polar, polar_log, phase, transmittance, table };
constexpr std::array<std::string_view, 5> words_of(Panel) {
  return {"polar", "polar-log", "phase", "transmittance", "table"};
}

struct PlotOptions {
  std::vector<Panel> panels;     // none: all that say something about the subjects
  bool logarithmic = false;      // angle, radius and distance too; density always is, but for the radius of `polar`
  bool species = false;          // thin lines for what a medium or mixture is made of
  std::optional<double> aspect;  // height / width; otherwise as high as it takes
};

/// Width of the page in print [points]: 180 mm, the text width of a journal; a single panel takes one column, 88 mm. An
/// aspect that leaves too little height makes the page up to twice as wide.
inline constexpr double page_width = 510.0, column_width = 250.0;

/// The most subjects that one picture tells apart.
inline constexpr std::size_t most_plotted = 8;

/// The figure of 1 to most_plotted subjects. Throws Fault where that many are not there, where a panel has nothing to
/// say about any of them (a law alone has no transmittance), or where its panels have no room in the aspect.
Figure plot(std::span<const Subject> subjects, const PlotOptions& options);

}  // namespace tyndall
