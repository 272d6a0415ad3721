#pragma once
// Medium files (*.medium.json): read, written, checked, and compiled to species.
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>

#include "tyndall/artist/keyframes.h"
#include "tyndall/document/grid_sequence.h"
#include "tyndall/document/json_text.h"
#include "tyndall/document/source.h"
#include "tyndall/document/writing.h"

namespace tyndall {

enum class MediumFormat { version_1 };
constexpr std::array<std::string_view, 1> words_of(MediumFormat) { return {"tyndall-medium/1"}; }

/// What a medium file says, as it says it: lengths and inverse lengths in its own units.
struct MediumFile : MediumDials {
  /// The key by which a file builds on another medium (base_medium.h).
  static constexpr std::string_view base_key = "base";
  static constexpr std::string_view base_text =
      "The medium that this one is a variant of: a file in this folder or below, or a preset.";
  std::optional<std::string> schema;  // for editors; not read
  MediumFormat format = MediumFormat::version_1;
  std::string name;
  std::optional<std::string> description;
  std::vector<Source> sources;  // of its numbers; not computed with
  double meters_per_unit = 1.0;
  std::optional<Keyframes> keyframes;  // then there are no `conditions`
  static constexpr auto fields() {
    return std::tuple_cat(
        std::tuple{
            Field{"$schema", &MediumFile::schema, any_number, "", "Where editors find the format's schema."},
            Field{"format", &MediumFile::format, any_number, "", "The format of this file.", Scaling::none, true},
            Field{"name", &MediumFile::name, any_number, "", "What to call the medium."},
            Field{"description", &MediumFile::description, any_number, "", "What it is, in a sentence."},
            Field{"sources", &MediumFile::sources, any_number, "", "Where its numbers come from."},
            Field{"meters_per_unit", &MediumFile::meters_per_unit, positive, "m",
                  "The file's unit of length: 1 for metres, 0.01 for centimetres."}},
        MediumDials::fields(),
        std::tuple{
            Field{"keyframes", &MediumFile::keyframes, any_number, "",
                  "Instead of conditions: weather that changes in time, by its states at some times. Between them "
                  "it is blended, before the first and after the last it stays."}});
  }
};

inline std::optional<Objection> objection_to(const MediumFile& file) {
  if (!file.keyframes) return std::nullopt;
  if (file.conditions) {
    return Objection{"keyframes", "keyframes beside conditions", "one or the other: each key has its own conditions"};
  }
  return objection_to_keys(*file.keyframes);
}
constexpr auto demands_of(const MediumFile&) {
  return std::array{not_both("conditions", "keyframes"), sized("keyframes", 1, most_keyframes)};
}

/// The channels' meaning, stated or not.
inline ChannelTag channels_of(const MediumFile& file) { return file.channels.value_or(ChannelTag{ChannelSpace{}}); }

/// The value at a cursor (a file's root, or an object inside a scene), checked: what it compiles to is sound. Throws
/// Fault.
MediumFile medium_file_at(const JsonCursor& at);
MediumFile medium_from_json(std::string text, const std::string& name_for_messages);
/// Files that it names must be below its folder unless `allow_path`.
MediumFile read_medium_file(const std::filesystem::path& file, bool allow_path = false);

/// The file as it is at a time [s], without keyframes. Throws Fault {`name_for_messages`, ...} where there is no medium
/// between two keys (a visibility that is held, out of reach on the way); never for a file without keyframes.
MediumFile at_time(const MediumFile& file, double time, const std::string& name_for_messages = "medium");

/// Makes sequences of grids those of a time (set_time()). Throws Fault.
void set_grid_time(std::vector<Profile>& profiles, double time, Grids grids = Grids::read);
void set_grid_time(MediumFile& file, double time, Grids grids = Grids::read);

/// The medium in SI, one with keyframes as it is at time 0. Throws Fault {`name_for_messages`, ...} where the dials
/// contradict each other; never for a file as read.
Medium compile(const MediumFile& file, const std::string& name_for_messages = "medium");

/// The dials in metres and 1/m; keyframes are left out, at_time() puts the conditions of a time in their place.
MediumDials dials_in_metres(const MediumFile& file);

/// A medium read from the file `from`, to be written as `to`: a "$schema" that names a file beside the old place names
/// the same one from the new place. Addresses (https://..) and absolute names stay.
void move_schema(MediumFile& file, const std::filesystem::path& from, const std::filesystem::path& to);

/// Everything in a medium that is outside what physics allows, at any of its keyframes.
std::vector<Remark> remarks_on(const MediumFile& file);

/// "file:/pointer: found ..., expected ...": a remark on a medium that stands at `pointer` of the file.
std::string remark_text(const Remark& remark, const std::string& file, const std::string& pointer = "");

std::string medium_to_json(const MediumFile& file);
/// Writes the file whole or not at all. A file of numbers that the medium refers to stays a reference where the new
/// file could refer to it (it is in the same folder or below, and still holds the same); else its numbers are written
/// out. Throws Fault, also where the dials could not be read back.
void write_medium_file(const std::filesystem::path& file, const MediumFile& medium);

}  // namespace tyndall
