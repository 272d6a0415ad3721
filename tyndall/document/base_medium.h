#pragma once
// Media that are variants of other media: {"base": "harbour_fog.medium.json", "conditions": {"w": 0.9}}.
#include <string>

#include "tyndall/document/json_text.h"

namespace tyndall {

/// How many media may stand on each other.
inline constexpr std::size_t most_bases = 16;
/// How much text may be laid under the media of one file, counted each time that it is: a base's base is laid under the
/// base, and both are under the file. Small files could else ask for any amount of work.
inline constexpr std::uint64_t most_base_bytes = largest_json;

/// Lays the medium at `pointer` of a text ("" for a file's root) over the medium that it names as its base, which is
/// a preset, or a file below the folder of `json` (reference.h). The base must be a medium in itself and may have a
/// base. Afterwards the text's root has the whole medium; faults about parts that the base states point to its file.
/// Lengths keep their meaning: where the two differ in meters_per_unit, the base's are converted. The base's sources of
/// numbers that this file states itself are left out. Nothing is done where there is no "base". Throws Fault: for a
/// base that cannot be read, one that leads back to where it began, more than most_bases of them, and more than
/// most_base_bytes.
void resolve_base(JsonText& json, const std::string& pointer = "");

}  // namespace tyndall
