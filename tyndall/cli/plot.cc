// tyndall plot: laws and media as a figure.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tyndall/cli/arguments.h"
#include "tyndall/cli/commands.h"
#include "tyndall/cli/law_list.h"
#include "tyndall/document/law_text.h"
#include "tyndall/document/named_medium.h"
#include "tyndall/document/spelling.h"
#include "tyndall/document/whole_file.h"
#include "tyndall/plot/plot.h"
#include "tyndall/plot/svg.h"
#if TYNDALL_HAS_CAIRO
#include "tyndall/plot/raster.h"
#endif

namespace tyndall {
namespace {

struct PixelSize {
  int width = 0, height = 0;
};

struct Options {
  std::vector<std::string> subjects;
  std::string output, what = "all", size;
  bool logarithmic = false, species = false, allow_path = false;
};

constexpr int least_pixels = 100, most_side = 16384, usual_width = 1600;

/// A law's text for reading: "henyey_greenstein:g=0.7" as "henyey greenstein, g = 0.7".
std::string law_title(const std::string& text) {
  std::string title;
  for (const char c : printable(text, 120)) {
    title += c == '_' ? " " : c == ':' || c == ',' ? ", " : c == '=' ? " = " : std::string(1, c);
  }
  return text.starts_with('{') ? printable(text, 120) : title;
}

/// The channels' names where the file gives their wavelengths.
std::array<std::string, channel_count> channel_names(const MediumFile& file) {
  std::array<std::string, channel_count> names = Subject{}.channels;
  const ChannelTag tag = channels_of(file);
  if (const auto* wavelengths = std::get_if<ChannelWavelengths>(&tag)) {
    for (std::size_t c = 0; c < channel_count; ++c) names[c] = short_number(wavelengths->wavelengths_nm[c]) + " nm";
  }
  return names;
}

Subject subject_from(const std::string& text, bool allow_path) {
  if (is_law_text(text)) return subject_of(law_title(text), law_from_text(text));
  const MediumFile file = read_named_medium_beside_laws("plot", text, allow_path).file;
  std::string name = file.name;
  if (name.empty()) name = std::filesystem::path(text).stem().stem().string();
  Subject subject = subject_of(printable(name, 120), compile(file, text));
  for (SubjectPart& part : subject.parts) part.name = printable(part.name, 40);
  subject.channels = channel_names(file);
  return subject;
}

std::vector<Panel> panels_from(const std::string& text) {
  std::vector<std::string_view> words{"all"};
  for (const std::string_view word : words_of(Panel{})) words.push_back(word);
  std::vector<Panel> panels;
  bool all = false;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string word = text.substr(begin, end - begin);
    const auto found = std::find(words.begin(), words.end(), word);
    if (found == words.end()) throw Fault("--what", in_quotes(word), one_of(word, words));
    all = all || found == words.begin();
    if (found != words.begin()) panels.push_back(static_cast<Panel>(found - words.begin() - 1));
    begin = end + 1;
  }
  if (all) panels.clear();
  return panels;
}

PixelSize size_from(const std::string& text) {
  const auto fault = [&] {
    return Fault(
        "--size", in_quotes(text),
        "WIDTHxHEIGHT in pixels, each from " + std::to_string(least_pixels) + " to " + std::to_string(most_side));
  };
  const std::size_t x = text.find('x');
  if (x == text.npos) throw fault();
  const auto side = [&](const std::string& digits) {
    if (digits.empty() || digits.size() > 5 || digits.find_first_not_of("0123456789") != digits.npos) throw fault();
    const int pixels = std::stoi(digits);
    if (pixels < least_pixels || pixels > most_side) throw fault();
    return pixels;
  };
  const PixelSize size{side(text.substr(0, x)), side(text.substr(x + 1))};
#if TYNDALL_HAS_CAIRO
  if (size.width > most_pixels / size.height) {
    throw Fault("--size", in_quotes(text), "at most " + std::to_string(most_pixels) + " pixels");
  }
#endif
  return size;
}

void write_svg(const std::string& output, const Figure& figure, const std::optional<PixelSize>& size) {
  SvgSize written{std::to_string(std::lround(figure.width)) + "pt", std::to_string(std::lround(figure.height)) + "pt"};
  if (size) written = {std::to_string(size->width), std::to_string(size->height)};
  write_whole_file(output, svg_text(figure, written));
}

void write_png([[maybe_unused]] const std::string& output, [[maybe_unused]] const Figure& figure,
               [[maybe_unused]] const std::optional<PixelSize>& size) {
#if TYNDALL_HAS_CAIRO
  const int width = size ? size->width : figure.width < page_width ? usual_width / 2 : usual_width;
  const int height = size ? size->height : static_cast<int>(std::lround(width * figure.height / figure.width));
  write_whole_file(output, png_bytes(figure, width, height));
#endif
}

void plot_to_file(const Options& options) {
  const std::string kind = std::filesystem::path(options.output).extension().string();
  if (kind != ".svg" && kind != ".png") {
    throw Fault("--output", "the file name " + in_quotes(options.output), "a name ending in .svg or .png");
  }
  if (kind == ".png" && !TYNDALL_HAS_CAIRO) {
    throw Fault("--output", "the file name " + in_quotes(options.output),
                "a name ending in .svg: this program was built without cairo, which paints .png");
  }
  std::optional<PixelSize> size;
  if (!options.size.empty()) size = size_from(options.size);
  PlotOptions how{panels_from(options.what), options.logarithmic, options.species, {}};
  if (size) how.aspect = static_cast<double>(size->height) / size->width;
  if (options.subjects.size() > most_plotted) {
    throw Fault("plot", std::to_string(options.subjects.size()) + " media and laws",
                "at most " + std::to_string(most_plotted) + " in one picture");
  }
  std::vector<Subject> subjects;
  for (const std::string& text : options.subjects) subjects.push_back(subject_from(text, options.allow_path));
  const Figure figure = plot(subjects, how);
  kind == ".svg" ? write_svg(options.output, figure, size) : write_png(options.output, figure, size);
}

}  // namespace

void add_plot(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("plot", "Draw how media and laws scatter light, and how far one sees in them");
  command->add_option("MEDIUM|LAW", options->subjects, "1 to 8 medium files or laws, drawn over each other")
      ->required();
  command->add_option("-o,--output", options->output, "Where to write: .svg (for print and the web) or .png")
      ->required();
  command
      ->add_option(
          "--what", options->what,
          "What to draw, one or several of: polar (scattered light around the place of scattering), polar-log "
          "(the same, faint directions enlarged), phase (against the angle), transmittance (against distance), "
          "table (numbers), all (default)")
      ->type_name("WHAT,..");
  command->add_flag("--log", options->logarithmic,
                    "Logarithmic axes throughout: for sharp forward peaks and for media of very different density");
  command->add_flag("--species", options->species, "Thin lines for each species of a medium, each part of a law");
  command->add_option("--size", options->size, "Pixels, for example 1600x1200 (default: as large as it takes)")
      ->type_name("WxH");
  add_allow_path(*command, options->allow_path);
  command->footer(
      law_list() +
      "\nOne medium is drawn in its red, green and blue; of several, each has a line of its own (its green).\n"
      "Angle 0 is straight on, 180 back to where the light came from. A medium is taken at the origin.\n"
      "The page is made for print 180 mm wide, a single panel 88 mm; --size sets its pixels and its shape.\n\n"
      "Example: tyndall plot rayleigh henyey_greenstein:g=0.7 -o laws.svg\n"
      "Example: tyndall plot examples/media/harbour_fog.medium.json --species -o fog.png");
  command->callback([options] { plot_to_file(*options); });
}

}  // namespace tyndall
