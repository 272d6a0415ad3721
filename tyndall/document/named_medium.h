#pragma once
// A medium by what a person types: the name of a file or of a preset. The one place that tells them apart.
#include <filesystem>
#include <string>
#include <string_view>

#include "tyndall/document/medium_file.h"

namespace tyndall {

struct NamedMedium {
  MediumFile file;
  std::string name;  // what messages call it: its path, or "preset haze"
};

/// Whether `text` can be nothing but a word: no path and no name of a file with an ending.
bool is_bare_word(std::string_view text);

/// Whether anything is at a path.
bool is_there(const std::filesystem::path& path);

/// The preset of this name, else the file. A preset's name wins over a file that is called the same without any ending,
/// so that a command means the same in every folder; "./haze" is the file. Throws Fault, for a word that is neither
/// with the nearest spelling.
NamedMedium read_named_medium(const std::string& text, bool allow_path = false);

/// The same for a name that stands in the file `naming` at the place `where`: files are those below its folder
/// (reference.h).
NamedMedium read_named_medium(const std::filesystem::path& naming, const std::string& text, bool allow_path,
                              const std::string& where);

/// The same where a law's name would do too and `text` is none (law_text.h): a word that is nothing is answered with
/// both. `where` is what asks.
NamedMedium read_named_medium_beside_laws(const std::string& where, const std::string& text, bool allow_path = false);

}  // namespace tyndall
