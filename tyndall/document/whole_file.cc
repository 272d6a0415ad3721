#include "tyndall/document/whole_file.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <random>
#include <utility>

namespace tyndall {
namespace fs = std::filesystem;
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

template <class Bytes>
Bytes read_all(const fs::path& file, std::uint64_t limit, bool regular_only) {
  const std::string where = place(file.string());
  const auto fail = [&where] {
    throw Fault(where,
                errno == ENOENT ? "no such file" : "nothing readable (" + std::string(std::strerror(errno)) + ")",
                "a file that can be read");
  };
  // O_NONBLOCK: opening a pipe without a writer must not wait for one.
  const Descriptor in(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (in.number < 0) fail();
  struct stat status {};
  if (::fstat(in.number, &status) != 0) fail();
  if (S_ISDIR(status.st_mode)) throw Fault(where, "a folder", "a file");
  const bool regular = S_ISREG(status.st_mode);
  if (regular_only && !regular) throw Fault(where, "a device or pipe", "a regular file");
  const auto size = regular ? static_cast<std::uint64_t>(status.st_size) : 0;
  if (size > limit) throw Fault(where, "a file of " + megabytes(size), "at most " + megabytes(limit));
  // A size is a claim until all is read, and pipes make none: there is always room for at least a byte more.
  Bytes bytes;
  std::size_t have = 0;
  for (;;) {
    if (have == bytes.size()) bytes.resize(std::max<std::size_t>(2 * have, size + 1));
    const ssize_t n = ::read(in.number, bytes.data() + have, bytes.size() - have);
    if (n == 0) break;
    if (n > 0) {
      have += static_cast<std::size_t>(n);
      if (have > limit) throw Fault(where, "a file of more than " + megabytes(limit), "a smaller file");
    } else if (errno == EAGAIN) {
      pollfd ready{in.number, POLLIN, 0};
      ::poll(&ready, 1, -1);
    } else if (errno != EINTR) {
      fail();
    }
  }
  bytes.resize(have);
  return bytes;
}

/// A new file that takes the place of another once it is complete, or goes away.
class Replacement {
 public:
  explicit Replacement(const fs::path& file) : file_(file) {
    std::error_code error;
    target_ = file;
    if (fs::is_symlink(file, error)) {
      target_ = fs::weakly_canonical(file, error);
      if (error) refuse(error.message());
    }
    const fs::file_status there = fs::status(target_, error);
    if (there.type() == fs::file_type::none) refuse(error.message());  // such as a name that is too long
    // Renaming onto these would take them away: a program run by root must not replace /dev/null.
    if (fs::is_directory(there)) refuse("a folder");
    if (fs::exists(there) && !fs::is_regular_file(there)) refuse("a device or pipe");
    if (!target_.has_filename()) refuse("a name that ends in nothing");
    // Another program may be writing the same file: its temporary is another one.
    std::random_device random;
    for (int attempt = 0; attempt < 100 && number_ < 0; ++attempt) {
      temporary_ = target_.parent_path() / (".tyndall-" + std::to_string(random()) + ".part");
      number_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
      if (number_ < 0 && errno != EEXIST) break;
    }
    if (number_ < 0) refuse("no way to write it (" + std::string(std::strerror(errno)) + ")");
  }
  ~Replacement() {
    if (number_ < 0) return;
    ::close(number_);
    ::unlink(temporary_.c_str());
  }
  Replacement(const Replacement&) = delete;
  Replacement& operator=(const Replacement&) = delete;

  void fill(std::span<const std::uint8_t> bytes) {
    for (std::size_t done = 0; done < bytes.size();) {
      const ssize_t n = ::write(number_, bytes.data() + done, bytes.size() - done);
      if (n < 0 && errno == EINTR) continue;
      if (n < 0) fail();
      done += static_cast<std::size_t>(n);
    }
    if (::fsync(number_) != 0) fail();
    if (::rename(temporary_.c_str(), target_.c_str()) != 0) fail();
    ::close(std::exchange(number_, -1));
  }

 private:
  [[noreturn]] void refuse(const std::string& found) const {
    throw Fault(place(file_.string()), found, "a place that can be written to");
  }
  [[noreturn]] void fail() const {
    throw WriteFailure(place(file_.string()) + ": could not be written (" + std::strerror(errno) + ")");
  }

  const fs::path& file_;
  fs::path target_, temporary_;
  int number_ = -1;
};

}  // namespace

std::vector<std::uint8_t> read_whole_file(const fs::path& file, std::uint64_t limit) {
  return read_all<std::vector<std::uint8_t>>(file, limit, true);
}

std::string read_whole_text(const fs::path& file, std::uint64_t limit) {
  return read_all<std::string>(file, limit, false);
}

void write_whole_file(const fs::path& file, std::span<const std::uint8_t> bytes) { Replacement(file).fill(bytes); }

void write_whole_file(const fs::path& file, std::string_view text) {
  write_whole_file(file, std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

void check_writable(const fs::path& file) { Replacement{file}; }

}  // namespace tyndall
