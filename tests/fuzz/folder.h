#pragma once
// Where targets put files that the readers open by name.
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "tests/fuzz/must.h"

namespace tyndall::fuzz {

/// A folder of its own, in memory where there is one; gone afterwards.
struct Folder {
  std::filesystem::path path;
  Folder() {
    namespace fs = std::filesystem;
    std::string name = (fs::exists("/dev/shm") ? fs::path("/dev/shm") : fs::temp_directory_path()) / "tyndall-XXXXXX";
    must(::mkdtemp(name.data()) != nullptr, "a folder can be made");
    path = name;
  }
  ~Folder() { std::filesystem::remove_all(path); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::filesystem::path write(const char* name, std::string_view bytes) const {
    std::ofstream(path / name, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    return path / name;
  }
};

}  // namespace tyndall::fuzz
