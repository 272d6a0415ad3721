#pragma once
// The subjects in numbers, in small print.
#include <span>
#include <vector>

#include "tyndall/plot/figure.h"
#include "tyndall/plot/subject.h"

namespace tyndall {

/// Draws one row for each subject from (x, y) down within `width`, and returns the height that they take [points].
/// Media: mean free path, visibility at 5 % contrast, albedo and mean cosine for each channel, one value where channels
/// agree to the digits shown. Laws alone: mean cosine and the density in three directions. `strokes`: a sample of each
/// subject's line, or empty for none.
double draw_summary_table(Group& group, std::span<const Subject> subjects, const std::vector<Stroke>& strokes, double x,
                          double y, double width);

}  // namespace tyndall
