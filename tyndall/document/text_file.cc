#include "tyndall/document/text_file.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include "tyndall/document/fault.h"

namespace tyndall {
namespace fs = std::filesystem;

std::string read_text_file(const fs::path& file, std::size_t limit) {
  std::error_code error;
  if (fs::is_directory(file, error)) throw Fault(place(file.string()), "a folder", "a file");
  errno = 0;
  std::ifstream in(file, std::ios::binary);
  if (!in)
    throw Fault(place(file.string()), errno == ENOENT ? "no such file" : std::strerror(errno), "a readable file");
  // In pieces: a pipe or a device does not tell its size, and a file's size is a claim until it is read.
  std::string text;
  for (char piece[1 << 16]; in.read(piece, sizeof piece) || in.gcount() > 0;) {
    text.append(piece, static_cast<std::size_t>(in.gcount()));
    if (text.size() > limit) {
      throw Fault(place(file.string()), "more than " + std::to_string(limit) + " bytes", "a smaller file");
    }
  }
  if (in.bad()) throw Fault(place(file.string()), std::strerror(errno), "a readable file");
  return text;
}

void write_text_file(const fs::path& file, std::string_view text) {
  // The process number keeps two programs that write the same file from sharing a temporary one.
  const fs::path temporary =
      file.parent_path() / ("." + file.filename().string() + "." + std::to_string(::getpid()) + ".tmp");
  std::error_code error;
  const auto give_up = [&](const std::string& why) {
    fs::remove(temporary, error);
    throw Fault(place(file.string()), why, "a place that can be written to");
  };
  if (fs::is_directory(file, error)) give_up("a folder");
  errno = 0;
  std::ofstream out(temporary, std::ios::binary | std::ios::trunc);
  if (!out) give_up(std::strerror(errno));
  out.write(text.data(), static_cast<std::streamsize>(text.size()));
  out.close();
  if (!out) give_up(std::strerror(errno));
  fs::rename(temporary, file, error);
  if (error) give_up(error.message());
}

}  // namespace tyndall
