#include "tyndall/render/checkpoint.h"

#include <bit>
#include <cstring>
#include <vector>

#include "tyndall/document/binding.h"
#include "tyndall/document/whole_file.h"
#include "tyndall/document/writing.h"
#include "tyndall/number/digest.h"
#include "tyndall/scene/fingerprint.h"

namespace tyndall {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::size_t numbers_per_pixel = (LightByOrder::parts.size() + 2) * channel_count + 1;
constexpr std::size_t bytes_per_pixel = numbers_per_pixel * 8 + 4;
constexpr std::size_t longest_head = 4096;

template <class T>
void put(Bytes& out, T word) {
  for (std::size_t i = 0; i < sizeof(T); ++i) out.push_back(static_cast<std::uint8_t>(word >> (8 * i)));
}
template <class T>
T take(const std::uint8_t*& at) {
  T word = 0;
  for (std::size_t i = 0; i < sizeof(T); ++i) word |= static_cast<T>(static_cast<T>(*at++) << (8 * i));
  return word;
}

/// Calls visit with every double of a pixel, in the order of the file.
template <class P, class Visit>
void for_each_number(P& pixel, Visit visit) {
  for (auto part : LightByOrder::parts)
    for (auto& x : (pixel.light.*part).value) visit(x);
  for (auto* sum : {&pixel.beauty_squared, &pixel.transmittance})
    for (auto& x : sum->value) visit(x);
  visit(pixel.depth);
}

std::uint64_t digest_of(const std::uint8_t* bytes, std::size_t size) {
  Digest digest;
  std::size_t i = 0;
  for (const std::uint8_t* at = bytes; i + 8 <= size; i += 8) digest.add(take<std::uint64_t>(at));
  for (; i < size; ++i) digest.add(std::uint64_t{bytes[i]});
  return digest.value();
}

std::string hexadecimal(std::uint64_t x) {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(x));
  return text;
}

/// What to do where a checkpoint is of something else.
std::string remedy(std::string_view field) {
  if (field == "scene")
    return "the scene, medium, size and time that it was begun with; or remove the file to begin anew";
  if (field == "instruction_set")
    return "a processor of the kind that it was begun on; or remove the file to begin anew";
  return "the same as when it was begun; or remove the file to begin anew";
}

template <class T>
std::string in_words(const T& value) {
  if constexpr (std::is_same_v<T, int>) {
    return std::to_string(value);
  } else {
    return in_quotes(value);
  }
}

}  // namespace

CheckpointSubject subject_of(const Scene& scene, const RenderSettings& settings, InstructionSet set) {
  CheckpointSubject subject;
  subject.scene = hexadecimal(fingerprint(scene));
  subject.seed = std::to_string(settings.seed);
  subject.integrator = settings.integrator;
  const bool single = settings.integrator == "single";
  subject.max_depth = single ? 0 : settings.max_depth;
  subject.spp = single ? settings.spp : 0;
  subject.instruction_set = name_of(set);
  subject.width = scene.film.width;
  subject.height = scene.film.height;
  return subject;
}

void write_checkpoint(const std::filesystem::path& file, const CheckpointSubject& subject, const SampleFilm& film) {
  const std::string head = written(subject).dump() + "\n";
  Bytes out(head.begin(), head.end());
  out.reserve(out.size() + film.pixels().size() * bytes_per_pixel + 8);
  for (const Pixel& pixel : film.pixels()) {
    for_each_number(pixel, [&](double x) { put(out, std::bit_cast<std::uint64_t>(x)); });
    put(out, pixel.samples);
  }
  put(out, digest_of(out.data(), out.size()));
  write_whole_file(file, out);
}

SampleFilm read_checkpoint(const std::filesystem::path& file, const CheckpointSubject& subject) {
  SampleFilm film(subject.width, subject.height);
  const std::string name = file.string();
  const std::size_t body = film.pixels().size() * bytes_per_pixel;
  const Bytes bytes = read_whole_file(file, longest_head + body + 8);
  const auto line =
      std::find(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(std::min(bytes.size(), longest_head)), '\n');
  if (line == bytes.end() || *line != '\n')
    throw Fault(name, "no line of JSON at its beginning", "a checkpoint that tyndall render wrote");
  const JsonText text = parse_json(std::string(bytes.begin(), line), name);
  const auto found = read_as<CheckpointSubject>(JsonCursor(text));
  for_each_field<CheckpointSubject>([&](const auto& field) {
    if (found.*field.member == subject.*field.member) return;
    throw Fault(name,
                "samples whose " + std::string(field.name) + " is " + in_words(found.*field.member) +
                    " where this is " + in_words(subject.*field.member),
                remedy(field.name));
  });
  const std::size_t head = static_cast<std::size_t>(line - bytes.begin()) + 1;
  if (bytes.size() != head + body + 8)
    throw Fault(name, std::to_string(bytes.size()) + " bytes",
                std::to_string(head + body + 8) + " bytes for this picture; it was cut short or is damaged");
  const std::uint8_t* sum = bytes.data() + head + body;
  if (take<std::uint64_t>(sum) != digest_of(bytes.data(), head + body))
    throw Fault(name, "a digest that is not that of its contents", "a checkpoint as it was written; it is damaged");
  const std::uint8_t* at = bytes.data() + head;
  for (Pixel& pixel : film.pixels()) {
    for_each_number(pixel, [&](double& x) { x = std::bit_cast<double>(take<std::uint64_t>(at)); });
    pixel.samples = take<std::uint32_t>(at);
  }
  return film;
}

}  // namespace tyndall
