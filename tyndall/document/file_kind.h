#pragma once
// Files of another kind than was asked for: a scene where a medium belongs, a picture where a scene belongs. Without
// this, the reader of what was asked for would complain about the first thing it does not know.
#include <filesystem>
#include <string_view>

#include "tyndall/document/json_text.h"

namespace tyndall {

/// What a person may be asked to name a file of.
enum class FileKind { medium, scene, model };

/// What a file is by its first bytes (32 are enough): "a PNG picture", "a glTF model (.glb)", "an empty file" where
/// there are none; empty for everything else, such as JSON.
std::string_view kind_of_start(std::string_view start);

/// Throws the Fault that says what this file is, where its first bytes show that it is not what was asked for. Does
/// nothing for a file that cannot be looked at without using it up (a pipe) or at all: reading it says why.
void refuse_other_kinds(const std::filesystem::path& file, FileKind asked);

/// The same by what a JSON text says of itself: its format, or the marks of a glTF model, a JSON Schema or a printed
/// report.
void refuse_other_kinds(const JsonText& json, FileKind asked);

}  // namespace tyndall
