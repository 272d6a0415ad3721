#pragma once
// Files that other files name: followed only below the folder of the file that names them.
#include <filesystem>
#include <string>

#include "tyndall/document/fault.h"

namespace tyndall {

/// The path of the regular file that `reference`, written in the file `naming`, stands for; relative references start
/// from the folder of `naming`. Throws Fault {`where`, ...} for an empty reference, a file that is absent or not
/// regular (a folder, a pipe, a device), and, unless `allow_path`, for one outside that folder, be it by an absolute
/// path, by ".." or by a symbolic link. Such a Fault does not tell whether anything exists there.
std::filesystem::path referenced_file(const std::filesystem::path& naming, const std::string& reference,
                                      bool allow_path, const std::string& where);

}  // namespace tyndall
