#include "tyndall/image/whole_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <random>
#include <string>

#include "tyndall/document/fault.h"

namespace tyndall {
namespace {

/// Closes its file when it goes out of scope.
struct Descriptor {
  int number;
  explicit Descriptor(int n) : number(n) {}
  ~Descriptor() {
    if (number >= 0) ::close(number);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
};

std::string megabytes(std::uint64_t bytes) { return std::to_string((bytes + 999999) / 1000000) + " MB"; }

}  // namespace

std::vector<std::uint8_t> read_whole_file(const std::filesystem::path& file, std::uint64_t limit) {
  const std::string where = place(file.string());
  // O_NONBLOCK: opening a pipe without a writer must not wait for one.
  const Descriptor in(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  const auto fail = [&where] {
    throw Fault{where, std::string("nothing readable (") + std::strerror(errno) + ")", "a file that can be read"};
  };
  if (in.number < 0) fail();
  struct stat status {};
  if (::fstat(in.number, &status) != 0) fail();
  if (!S_ISREG(status.st_mode)) {
    throw Fault{where, S_ISDIR(status.st_mode) ? "a folder" : "a device or pipe", "a regular file"};
  }
  const auto size = static_cast<std::uint64_t>(status.st_size);
  if (size > limit) throw Fault{where, "a file of " + megabytes(size), "at most " + megabytes(limit)};
  std::vector<std::uint8_t> bytes(size);
  std::size_t have = 0;
  while (have < bytes.size()) {
    const ssize_t n = ::read(in.number, bytes.data() + have, bytes.size() - have);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail();
    if (n == 0) throw Fault{where, "a file that became shorter while it was read", "a file at rest"};
    have += static_cast<std::size_t>(n);
  }
  return bytes;
}

void write_whole_file(const std::filesystem::path& file, std::span<const std::uint8_t> bytes) {
  const auto fail = [&file] {
    throw Fault{place(file.string()), std::string("no way to write it (") + std::strerror(errno) + ")",
                "a place that can be written to"};
  };
  // Another program may be writing the same file: its temporary is another one.
  std::random_device random;
  std::filesystem::path temporary;
  int number = -1;
  for (int attempt = 0; attempt < 100 && number < 0; ++attempt) {
    temporary = file.parent_path() / ("." + file.filename().string() + "." + std::to_string(random()) + ".part");
    number = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (number < 0 && errno != EEXIST) break;
  }
  const Descriptor out(number);
  if (out.number < 0) fail();
  const auto give_up = [&] {
    const int reason = errno;
    ::unlink(temporary.c_str());
    errno = reason;
    fail();
  };
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t n = ::write(out.number, bytes.data() + done, bytes.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) give_up();
    done += static_cast<std::size_t>(n);
  }
  if (::fsync(out.number) != 0) give_up();
  if (::rename(temporary.c_str(), file.c_str()) != 0) give_up();
}

}  // namespace tyndall
