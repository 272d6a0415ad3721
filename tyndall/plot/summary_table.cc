#include "tyndall/plot/summary_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>

#include "tyndall/plot/axis.h"
#include "tyndall/plot/lines.h"
#include "tyndall/plot/style.h"
#include "tyndall/plot/text_width.h"

namespace tyndall {
namespace {

constexpr double size = style::small_size, row_height = 1.45 * size;
constexpr double sample_length = 16.0, gap = 5.0, least_gap = 6.0, least_name = 70.0, widest_channel = 30.0;

using Cells = std::vector<std::string>;  // one, or one for each channel

struct Column {
  std::string heading;
  std::size_t cells;  // 1 or channel_count
  std::function<Cells(const Subject&)> of;
};

Cells per_channel(const Spectrum& values, std::string (*text)(double)) {
  Cells cells;
  for (const double x : values.value) cells.push_back(text(x));
  if (std::all_of(cells.begin(), cells.end(), [&](const auto& c) { return c == cells[0]; })) cells.resize(1);
  return cells;
}

std::vector<Column> columns_for(std::span<const Subject> subjects) {
  std::vector<Column> columns;
  if (std::any_of(subjects.begin(), subjects.end(), [](const Subject& s) { return s.is_medium; })) {
    const auto undefined = [](const Subject& s, const Spectrum& x) {
      return s.is_medium ? x : Spectrum::grey(std::nan(""));
    };
    columns.push_back({"mean free path", channel_count, [=](const Subject& s) {
                         return per_channel(undefined(s, Spectrum::grey(1.0) / s.extinction), distance_text);
                       }});
    columns.push_back({"visibility (5 %)", channel_count, [=](const Subject& s) {
                         const auto visibility = [](double x) { return visibility_of(x, 0.05); };
                         return per_channel(undefined(s, map(s.extinction, visibility)), distance_text);
                       }});
    columns.push_back({"albedo", channel_count, [](const Subject& s) { return per_channel(s.albedo, share_text); }});
    columns.push_back(
        {"mean cosine", channel_count, [](const Subject& s) { return per_channel(s.mean_cosine, share_text); }});
    return columns;
  }
  // Laws may be tables that differ by channel.
  const bool coloured =
      std::any_of(subjects.begin(), subjects.end(), [](const Subject& s) { return is_coloured(s, Quantity::phase); });
  const std::size_t cells = coloured ? channel_count : 1;
  columns.push_back({"mean cosine", cells, [](const Subject& s) { return per_channel(s.mean_cosine, share_text); }});
  for (const int degrees : {0, 90, 180}) {
    columns.push_back({"at " + std::to_string(degrees) + "\u00b0 [sr\u207b\u00b9]", cells, [degrees](const Subject& s) {
                         const double angle = degrees * std::numbers::pi / 180.0;
                         Spectrum density;
                         for (std::size_t c = 0; c < channel_count; ++c) density[c] = density_at(s.phase[c], angle);
                         return per_channel(density, quantity_text);
                       }});
  }
  return columns;
}

}  // namespace

double draw_summary_table(Group& group, std::span<const Subject> subjects, const std::vector<Stroke>& strokes, double x,
                          double y, double width) {
  const std::vector<Column> columns = columns_for(subjects);
  std::vector<std::vector<Cells>> rows;
  std::vector<double> cell_widths(columns.size(), 0.0), widths(columns.size(), 0.0);
  for (const Subject& subject : subjects) {
    rows.emplace_back();
    for (std::size_t k = 0; k < columns.size(); ++k) {
      rows.back().push_back(columns[k].of(subject));
      const Cells& cells = rows.back().back();
      for (const std::string& cell : cells) {
        // A value for all channels stands in the middle and may be wider than a channel's share.
        const double share = cells.size() == columns[k].cells ? 1.0 : static_cast<double>(columns[k].cells);
        cell_widths[k] = std::max(cell_widths[k], text_width(cell, size) / share);
      }
    }
  }
  // Where all rows agree in all channels, nothing needs to be said of channels.
  std::vector<std::string> channels;
  for (const auto& row : rows) {
    for (const Cells& cell : row) {
      if (cell.size() > 1) channels.assign(subjects[0].channels.begin(), subjects[0].channels.end());
    }
  }
  double all = 0.0, cells = 0.0;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const auto n = static_cast<double>(columns[k].cells);
    cell_widths[k] = std::max(cell_widths[k], text_width(columns[k].heading, size) / n);
    for (const std::string& channel : channels) {
      cell_widths[k] = std::max(cell_widths[k], std::min(text_width(channel, size), widest_channel));
    }
    all += n * cell_widths[k];
    cells += n;
  }
  // Names take what the numbers leave, and the numbers share what names do not need.
  const double sample = strokes.empty() ? 0.0 : sample_length + gap;
  double longest = least_name;
  for (const Subject& subject : subjects) longest = std::max(longest, text_width(subject.name, size));
  const double name_width = std::clamp(width - sample - all - cells * least_gap, least_name / 2.0, longest);
  const double spread = (width - sample - name_width - all) / cells;

  const auto write = [&](double at, double base, const std::string& text, Anchor anchor, Ink ink) {
    group.marks.emplace_back(Text{{at, base}, text, size, anchor, false, ink, false});
  };
  const auto rule = [&](double at, double thickness) {
    group.marks.emplace_back(Path{{{x, at}, {x + width, at}}, Stroke{style::frame_ink, thickness, {}}, {}, false, {}});
  };
  const bool coloured = !channels.empty();
  const double first_row = y + (coloured ? 2.0 : 1.0) * row_height + 3.0;
  rule(y, 0.6);
  double left = x + width;
  for (std::size_t k = columns.size(); k-- > 0;) {
    const double step = cell_widths[k] + spread, column_width = static_cast<double>(columns[k].cells) * step;
    left -= column_width;
    const double middle = left + spread + (column_width - spread) / 2.0;
    write(middle, y + 0.5 + size, columns[k].heading, Anchor::middle, style::text_ink);
    for (std::size_t c = 0; columns[k].cells > 1 && c < channels.size(); ++c) {
      const std::string& channel = channels[c];
      write(left + static_cast<double>(c + 1) * step, y + 0.5 + row_height + size,
            shortened(channel, size, cell_widths[k]), Anchor::end, style::channel_line(c).ink);
    }
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const double base = first_row + static_cast<double>(i) * row_height + size;
      const Cells& row = rows[i][k];
      for (std::size_t c = 0; c < row.size(); ++c) {
        const bool one = row.size() == 1;
        write(one ? middle : left + static_cast<double>(c + 1) * step, base, row[c], one ? Anchor::middle : Anchor::end,
              style::text_ink);
      }
    }
  }
  for (std::size_t i = 0; i < subjects.size(); ++i) {
    const double base = first_row + static_cast<double>(i) * row_height + size, middle = base - 0.36 * size;
    if (!strokes.empty()) {
      group.marks.emplace_back(Path{{{x, middle}, {x + sample_length, middle}}, strokes[i], {}, false, {}});
    }
    write(x + sample, base, shortened(subjects[i].name, size, name_width), Anchor::start, style::text_ink);
  }
  rule(first_row - 1.0, 0.4);
  const double bottom = first_row + static_cast<double>(rows.size()) * row_height + 2.0;
  rule(bottom, 0.6);
  return bottom + 1.0 - y;
}

}  // namespace tyndall
