#include "tyndall/document/reference.h"

#include <algorithm>

#include "tyndall/document/spelling.h"

namespace tyndall {
namespace fs = std::filesystem;
namespace {

/// Whether `path` is `folder` or stands below it; both are canonical.
bool is_below(const fs::path& path, const fs::path& folder) {
  const auto [end, at] = std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
  return end == folder.end() && at != path.end();
}

}  // namespace

fs::path referenced_file(const fs::path& naming, const std::string& reference, bool allow_path,
                         const std::string& where) {
  const std::string found = "the file name " + in_quotes(reference, 100);
  if (reference.empty() || reference.find('\0') != std::string::npos) throw Fault(where, found, "the name of a file");
  std::error_code error;
  const fs::path folder = fs::canonical(naming.has_parent_path() ? naming.parent_path() : fs::path("."), error);
  if (error) throw Fault(where, found, "a folder that can be read around the file that names it");
  const fs::path path = fs::weakly_canonical(folder / reference, error);
  if (!allow_path && (error || !is_below(path, folder))) {
    throw Fault(where, found, "a file under the folder of the file that names it (--allow-path lifts this)");
  }
  if (error || !fs::exists(path, error)) throw Fault(where, found + ", which does not exist", "an existing file");
  if (!fs::is_regular_file(path, error)) throw Fault(where, found + ", which is no regular file", "a regular file");
  return path;
}

}  // namespace tyndall
