#include "tyndall/plot/plot.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <tuple>
#include <utility>

#include "tyndall/document/fault.h"
#include "tyndall/plot/axis.h"
#include "tyndall/plot/legend.h"
#include "tyndall/plot/lines.h"
#include "tyndall/plot/panels.h"
#include "tyndall/plot/style.h"
#include "tyndall/plot/summary_table.h"
#include "tyndall/plot/text_width.h"

namespace tyndall {
namespace {

constexpr double margin = 8.0, column_gap = 14.0, row_gap = 12.0;
constexpr double usual_row = 190.0, single_row = 200.0, least_row = 132.0;
constexpr double most_aspect = 4.0, most_widening = 2.0;
static_assert(most_plotted == style::most_subjects);

bool any_medium(std::span<const Subject> subjects) {
  return std::any_of(subjects.begin(), subjects.end(), [](const Subject& s) { return s.is_medium; });
}
bool any_scatters(std::span<const Subject> subjects) { return std::any_of(subjects.begin(), subjects.end(), scatters); }

/// The panels to draw, each once, in their usual order.
std::vector<Panel> panels_of(std::span<const Subject> subjects, const PlotOptions& options) {
  const auto asked = [&](Panel panel) {
    return std::find(options.panels.begin(), options.panels.end(), panel) != options.panels.end();
  };
  if (asked(Panel::transmittance) && !any_medium(subjects)) {
    throw Fault("panel transmittance", "only laws, which say where light goes but not how much of it",
                "at least one medium");
  }
  std::vector<Panel> panels;
  for (const Panel panel : {Panel::polar, Panel::polar_log, Panel::phase, Panel::transmittance, Panel::table}) {
    bool wanted = asked(panel);
    if (options.panels.empty()) {
      wanted = panel == Panel::table || (panel == Panel::transmittance ? any_medium(subjects) : any_scatters(subjects));
      if (panel == Panel::polar && options.logarithmic) wanted = false;
    } else if (options.logarithmic && panel == Panel::polar_log) {
      wanted = wanted || asked(Panel::polar);
    } else if (options.logarithmic && panel == Panel::polar) {
      wanted = false;
    }
    if (wanted) panels.push_back(panel);
  }
  return panels;
}

/// What has to be said besides.
std::string caption_of(std::span<const Subject> subjects, const PlotOptions& options,
                       const std::vector<Panel>& panels) {
  const auto shown = [&](Panel panel) { return std::find(panels.begin(), panels.end(), panel) != panels.end(); };
  const bool phases = shown(Panel::polar) || shown(Panel::polar_log) || shown(Panel::phase);
  const bool distances = shown(Panel::transmittance);
  std::string text;
  const auto say = [&](const std::string& sentence) { text += (text.empty() ? "" : " ") + sentence; };
  if (any_medium(subjects)) say("Media are taken at the origin, as if they went on like that.");
  const auto loses = [](const Subject& s) { return s.is_medium && !is_zero(s.extinction); };
  if (distances && std::any_of(subjects.begin(), subjects.end(), loses))
    say("Dots mark the visibility, where 5 % of light and contrast are left.");
  const auto coloured = [&](const Subject& s) {
    return (shown(Panel::phase) && has_coloured_phase(s)) || (distances && has_coloured_extinction(s));
  };
  if (subjects.size() > 1 && (phases || distances)) {
    const bool bands = std::any_of(subjects.begin(), subjects.end(), coloured);
    if (bands) say("Lines are the " + subjects[0].channels[reference_channel] + " channel, bands span all channels.");
  }
  if (options.species && (phases || distances)) {
    if (phases) say("Thin lines of the phase function are weighted by share and add up to the whole.");
    if (distances) say("Thin lines of transmittance are those of one species alone.");
    const bool many = subjects.size() == 1 && subjects[0].parts.size() > style::most_subjects;
    if (many) say("Of " + std::to_string(subjects[0].parts.size()) + " parts, those that matter most are drawn.");
  }
  for (const Subject& subject : subjects) {
    if (!phases || scatters(subject) || !any_scatters(subjects)) continue;
    say("Not every medium scatters; one that does not has no phase function.");
    break;
  }
  return text;
}

std::string title_of(Panel panel) {
  switch (panel) {
    case Panel::polar:
      return "phase function [sr\u207b\u00b9], linear radius";
    case Panel::polar_log:
      return "phase function [sr\u207b\u00b9], logarithmic radius";
    case Panel::phase:
      return "phase function against angle";
    case Panel::transmittance:
      return "transmittance against distance";
    case Panel::table:
      break;
  }
  return "";
}

struct Contents {
  PanelContent phase, transmittance;
};

void draw_panel(Figure& figure, Panel panel, const Rectangle& cell, const std::string& letter, const Contents& contents,
                bool logarithmic) {
  const std::string title = letter + title_of(panel);
  if (panel == Panel::transmittance) {
    draw_transmittance_panel(figure, cell, title, contents.transmittance, logarithmic);
  } else if (contents.phase.lines.empty()) {
    draw_empty_panel(figure, cell, title, "nothing scatters here");
  } else if (panel == Panel::phase) {
    draw_phase_panel(figure, cell, title, contents.phase, logarithmic);
  } else {
    draw_polar_panel(figure, cell, title, contents.phase, panel == Panel::polar_log);
  }
}

/// The lines of all panels, each once: subjects in their order, channels in theirs, species last.
std::vector<LegendEntry> legend_of(const Contents& contents, bool several) {
  std::vector<Line> lines = contents.phase.lines;
  lines.insert(lines.end(), contents.transmittance.lines.begin(), contents.transmittance.lines.end());
  std::stable_sort(lines.begin(), lines.end(), [](const Line& a, const Line& b) {
    return std::tuple(a.part != nullptr, a.subject, a.part, a.channel) <
           std::tuple(b.part != nullptr, b.subject, b.part, b.channel);
  });
  std::vector<LegendEntry> entries;
  for (const Line& line : lines) {
    LegendEntry entry{line.label, line.stroke};
    if (line.part != nullptr && several) entry.stroke = {style::quiet_ink, style::thin_width, {}};
    if (std::find(entries.begin(), entries.end(), entry) == entries.end()) entries.push_back(std::move(entry));
  }
  return entries;
}

/// All that a page holds, before it is known how wide it is.
struct Page {
  std::span<const Subject> subjects;
  const PlotOptions& options;
  std::vector<Panel> panels;
  Contents contents;
  std::vector<LegendEntry> legend;
  std::vector<Stroke> strokes;
  std::string caption;
  bool table = false;
  std::size_t cells = 0, columns = 1, rows = 0;
};

Page page_of(std::span<const Subject> subjects, const PlotOptions& options) {
  Page page{subjects, options, panels_of(subjects, options), {}, {}, {}, "", false, 0, 1, 0};
  for (const Panel panel : page.panels) {
    if (panel == Panel::table) {
      page.table = true;
      continue;
    }
    ++page.cells;
    if (panel == Panel::transmittance) {
      page.contents.transmittance.lines = lines_of(subjects, Quantity::transmittance, options.species);
    } else if (page.contents.phase.lines.empty()) {
      page.contents.phase.lines = lines_of(subjects, Quantity::phase, options.species);
    }
  }
  page.contents.phase.subjects = page.contents.transmittance.subjects = subjects;
  page.columns = page.cells > 1 ? 2 : 1;
  page.rows = (page.cells + page.columns - 1) / page.columns;
  page.legend = legend_of(page.contents, subjects.size() > 1);
  if (subjects.size() == 1 && page.legend.size() == 1) page.legend.clear();  // the title has said it
  for (std::size_t i = 0; subjects.size() > 1 && page.cells > 0 && i < subjects.size(); ++i) {
    page.strokes.push_back(style::subject_line(i));
  }
  page.caption = caption_of(subjects, options, page.panels);
  return page;
}

/// What stands above the panels, from the top margin down; returns where it ends.
double draw_head(Group& head, const Page& page, double inner) {
  double y = margin;
  if (page.subjects.size() == 1) {
    const std::string title = shortened(page.subjects[0].name, style::title_size, inner);
    head.marks.emplace_back(
        Text{{margin, y + style::title_size}, title, style::title_size, Anchor::start, false, style::text_ink, false});
    y += 1.6 * style::title_size;
  }
  return y + draw_legend(head, page.legend, margin, y, inner) + 6.0;
}

/// What stands below them; returns its height.
double draw_foot(Group& foot, const Page& page, double top, double inner) {
  double height = 0.0;
  if (page.table) height += draw_summary_table(foot, page.subjects, page.strokes, margin, top, inner) + 3.0;
  return height + draw_paragraph(foot, page.caption, margin, top + height, inner);
}

/// Heights of a page of a given width.
struct Heights {
  double head, foot, around;  // around: all but the panels
};

Heights heights_of(const Page& page, double width) {
  Group drawn;
  const double head = draw_head(drawn, page, width - 2.0 * margin);
  const double foot = draw_foot(drawn, page, 0.0, width - 2.0 * margin);
  const double gaps = page.rows > 0 ? static_cast<double>(page.rows - 1) * row_gap + (foot > 0.0 ? 8.0 : 0.0) : 0.0;
  return {head, foot, head + gaps + foot + margin};
}

}  // namespace

Figure plot(std::span<const Subject> subjects, const PlotOptions& options) {
  if (subjects.empty() || subjects.size() > most_plotted) {
    throw Fault("plot", std::to_string(subjects.size()) + " media and laws",
                "1 to " + std::to_string(most_plotted) + " of them");
  }
  const Page page = page_of(subjects, options);
  const auto rows = static_cast<double>(page.rows);
  Figure figure;
  for (const Subject& subject : subjects) figure.title += (figure.title.empty() ? "" : ", ") + subject.name;
  const bool single = page.cells == 1 && !page.table;
  figure.width = single ? column_width : page_width;
  Heights heights = heights_of(page, figure.width);
  figure.height = heights.around + rows * (single ? single_row : usual_row);
  if (options.aspect) {
    // A flat shape makes the page wider than usual, since text keeps its size.
    const double least = heights.around + rows * least_row, most = most_widening * figure.width;
    figure.width = std::max(figure.width, least / *options.aspect);
    figure.height = *options.aspect * figure.width;
    if (!(figure.width <= most && figure.height <= most_aspect * figure.width)) {
      throw Fault("the shape of the picture", "a height of " + quantity_text(*options.aspect) + " times the width",
                  "from " + quantity_text(std::ceil(100.0 * least / most) / 100.0) + " to " +
                      quantity_text(most_aspect) + " times, for what it holds");
    }
    heights = heights_of(page, figure.width);
  }
  const double inner = figure.width - 2.0 * margin;
  const double row = page.rows > 0 ? (figure.height - heights.around) / rows : 0.0;
  const double column =
      (inner - static_cast<double>(page.columns - 1) * column_gap) / static_cast<double>(page.columns);
  Group head{{{"class", "legend"}}, {}, {}}, foot{{{"class", "table"}}, {}, {}};
  draw_head(head, page, inner);
  draw_foot(foot, page, figure.height - margin - heights.foot, inner);
  figure.groups.push_back(std::move(head));
  for (std::size_t place = 0; place < page.cells; ++place) {  // the table is the last panel
    const bool last_alone = place + 1 == page.cells && page.cells % page.columns != 0;
    const Rectangle cell{margin + static_cast<double>(place % page.columns) * (column + column_gap),
                         heights.head + static_cast<double>(place / page.columns) * (row + row_gap),
                         last_alone ? inner : column, row};
    const std::string letter = page.cells > 1 ? '(' + std::string(1, static_cast<char>('a' + place)) + ") " : "";
    draw_panel(figure, page.panels[place], cell, letter, page.contents, options.logarithmic);
  }
  figure.groups.push_back(std::move(foot));
  return figure;
}

}  // namespace tyndall
