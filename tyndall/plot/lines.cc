#include "tyndall/plot/lines.h"

#include <algorithm>
#include <functional>

#include "tyndall/plot/style.h"

namespace tyndall {
namespace {

bool has(const Subject& subject, Quantity quantity) {
  return quantity == Quantity::phase ? scatters(subject) : subject.is_medium;
}

/// How much a part matters to the quantity: what its line is drawn from.
double weight_of(const SubjectPart& part, Quantity quantity) {
  return largest(quantity == Quantity::phase ? part.share : part.extinction);
}

/// The parts with a line, in their own order.
std::vector<const SubjectPart*> parts_of(const Subject& subject, Quantity quantity) {
  std::vector<const SubjectPart*> parts;
  for (const SubjectPart& part : subject.parts) {
    if (weight_of(part, quantity) > 0.0) parts.push_back(&part);
  }
  if (subject.parts.size() < 2) parts.clear();  // the part is the whole
  if (parts.size() > style::most_subjects) {
    std::vector<double> weights;
    for (const SubjectPart* part : parts) weights.push_back(weight_of(*part, quantity));
    std::nth_element(weights.begin(), weights.begin() + style::most_subjects - 1, weights.end(), std::greater<>());
    const double least = weights[style::most_subjects - 1];
    std::erase_if(parts, [&](const SubjectPart* part) { return weight_of(*part, quantity) < least; });
    parts.resize(style::most_subjects);
  }
  return parts;
}

/// The channel that stands for the others: the usual one, or where it does not scatter one that does.
std::size_t representative(const Subject& subject, Quantity quantity) {
  if (quantity == Quantity::transmittance || !subject.phase[reference_channel].empty()) return reference_channel;
  const auto first = std::find_if(subject.phase.begin(), subject.phase.end(), [](const auto& p) { return !p.empty(); });
  return static_cast<std::size_t>(first - subject.phase.begin());
}

}  // namespace

bool is_coloured(const Subject& subject, Quantity quantity) {
  return quantity == Quantity::phase ? has_coloured_phase(subject) : has_coloured_extinction(subject);
}

std::vector<Line> lines_of(std::span<const Subject> subjects, Quantity quantity, bool species) {
  std::vector<Line> lines;
  const bool alone = subjects.size() == 1;
  for (std::size_t i = 0; species && i < subjects.size(); ++i) {
    if (!has(subjects[i], quantity)) continue;
    for (const SubjectPart* part : parts_of(subjects[i], quantity)) {
      // A species keeps its line in all panels.
      Stroke stroke = style::part_line(static_cast<std::size_t>(part - subjects[i].parts.data()));
      if (!alone) stroke = {style::subject_line(i).ink, style::thin_width, style::subject_line(i).dash};
      lines.push_back(
          {&subjects[i], representative(subjects[i], quantity), part, stroke, alone ? part->name : "thin: species"});
    }
  }
  for (std::size_t i = 0; i < subjects.size(); ++i) {
    const Subject& subject = subjects[i];
    if (!has(subject, quantity)) continue;
    const bool all_scatter =
        std::none_of(subject.phase.begin(), subject.phase.end(), [](const auto& p) { return p.empty(); });
    if (!alone) {
      lines.push_back({&subject, representative(subject, quantity), nullptr, style::subject_line(i), subject.name});
    } else if (!is_coloured(subject, quantity)) {
      lines.push_back({&subject, representative(subject, quantity), nullptr, style::grey_line(),
                       !subject.is_medium                            ? subject.name
                       : quantity == Quantity::phase && !all_scatter ? "channels that scatter"
                                                                     : "all channels"});
    } else {
      const std::size_t before = lines.size();
      for (std::size_t c = 0; c < channel_count; ++c) {
        if (quantity == Quantity::phase && subject.phase[c].empty()) continue;
        lines.push_back({&subject, c, nullptr, style::channel_line(c), subject.channels[c]});
      }
      // The unbroken line lies beneath, so that the others show where they meet.
      const auto whole = lines.begin() + static_cast<std::ptrdiff_t>(before);
      std::stable_partition(whole, lines.end(), [](const Line& line) { return line.stroke.dash.empty(); });
    }
  }
  return lines;
}

double density_of(const Line& line, double angle) {
  if (line.part != nullptr) return line.part->share[line.channel] * density_at(line.part->phase[line.channel], angle);
  return density_at(line.subject->phase[line.channel], angle);
}

double extinction_of(const Line& line) {
  return line.part != nullptr ? line.part->extinction[line.channel] : line.subject->extinction[line.channel];
}

Attributes attributes_of(const Line& line) {
  Attributes list{{"class", line.part != nullptr ? "curve part" : "curve"},
                  {"of", line.subject->name},
                  {"channel", line.subject->channels[line.channel]}};
  if (line.part != nullptr) list.push_back({"part", line.part->name});
  return list;
}

}  // namespace tyndall
