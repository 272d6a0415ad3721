#include "tyndall/document/rehearsal.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <new>
#include <string_view>
#include <vector>

#include "tyndall/document/fault.h"

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define TYNDALL_SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
#define TYNDALL_SANITIZED 1
#endif
#endif
#ifndef TYNDALL_SANITIZED
#define TYNDALL_SANITIZED 0
#endif

namespace tyndall {
namespace {

// The child's report: one letter; then, where all is well, the bytes that it made, and for a Fault its three texts,
// each ended by a zero byte.
constexpr char well = 'w', faulty = 'f', out_of_memory = 'm', thrown = 't';

void send(int pipe, std::string_view text) {
  while (!text.empty()) {
    const ssize_t n = ::write(pipe, text.data(), text.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return;
    text.remove_prefix(static_cast<std::size_t>(n));
  }
}

void send_text(int pipe, const std::string& text) {
  send(pipe, std::string_view(text.c_str(), std::strlen(text.c_str()) + 1));
}

void limit(int resource, std::uint64_t most) {
  rlimit now{};
  ::getrlimit(static_cast<__rlimit_resource_t>(resource), &now);
  now.rlim_cur = std::min<rlim_t>(now.rlim_max, most);
  ::setrlimit(static_cast<__rlimit_resource_t>(resource), &now);
}

/// Address space in use [bytes].
std::uint64_t address_space() {
  unsigned long long pages = 0;
  if (std::FILE* const file = std::fopen("/proc/self/statm", "r")) {
    if (std::fscanf(file, "%llu", &pages) != 1) pages = 0;
    std::fclose(file);
  }
  return pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

[[noreturn]] void perform(int pipe, const std::function<std::string()>& act, const RehearsalLimits& limits) {
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, limits.seconds);
  if (!TYNDALL_SANITIZED) {
    limit(RLIMIT_AS, address_space() + limits.memory);
    // Libraries' complaints are not ours to print; a sanitizer's report is worth having.
    if (const int nowhere = ::open("/dev/null", O_RDWR); nowhere >= 0) {
      for (int standard = 0; standard < 3; ++standard) ::dup2(nowhere, standard);
    }
  }
  try {
    const std::string made = act();
    send(pipe, std::string_view(&well, 1));
    send(pipe, made);
  } catch (const Fault& fault) {
    send(pipe, std::string_view(&faulty, 1));
    send_text(pipe, fault.where);
    send_text(pipe, fault.found);
    send_text(pipe, fault.expected);
  } catch (const std::bad_alloc&) {
    send(pipe, std::string_view(&out_of_memory, 1));
  } catch (...) {
    send(pipe, std::string_view(&thrown, 1));
  }
  // Not exit(): the parent's buffers, threads and static objects are not ours to end.
  ::_exit(0);
}

}  // namespace

std::string performed(const std::string& where, const std::string& expected, const std::function<std::string()>& act,
                      const RehearsalLimits& limits) {
  const auto impossible = [&where] {
    throw Fault{where, std::string("no child process to try it in (") + std::strerror(errno) + ")",
                "a machine with processes and memory to spare"};
  };
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) impossible();
  const pid_t child = ::fork();
  if (child < 0) {
    const int reason = errno;
    ::close(ends[0]);
    ::close(ends[1]);
    errno = reason;
    impossible();
  }
  if (child == 0) {
    ::close(ends[0]);
    perform(ends[1], act, limits);
  }
  ::close(ends[1]);
  std::string report;
  std::vector<char> piece(std::size_t{1} << 16);
  for (;;) {
    const ssize_t n = ::read(ends[0], piece.data(), piece.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) break;
    report.append(piece.data(), static_cast<std::size_t>(n));
  }
  ::close(ends[0]);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }

  const bool ended = WIFEXITED(status) && WEXITSTATUS(status) == 0;  // else bytes may be missing
  if (ended && !report.empty() && report[0] == well) {
    report.erase(0, 1);
    return report;
  }
  if (!report.empty() && report[0] == faulty) {
    std::array<std::string, 3> text;
    std::size_t at = 1;
    for (std::string& t : text) {
      const std::size_t end = std::min(report.find('\0', at), report.size());
      t = report.substr(std::min(at, report.size()), end - std::min(at, end));
      at = end + 1;
    }
    throw Fault{text[0], text[1], text[2]};
  }
  std::string found = "a file whose reader broke off";
  if (!report.empty() && report[0] == out_of_memory) {
    found = "a file that asks for too much memory";
  } else if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU) {
    found = "a file that keeps its reader busy for more than " + std::to_string(limits.seconds) + " s";
  } else if (WIFSIGNALED(status)) {
    found = "a file that crashes its reader (signal " + std::to_string(WTERMSIG(status)) + ")";
  } else if (WIFEXITED(status) && WEXITSTATUS(status) != 0) {
    found = "a file that crashes its reader (exit code " + std::to_string(WEXITSTATUS(status)) + ")";
  }
  throw Fault{where, found, expected};
}

void rehearse(const std::string& where, const std::string& expected, const std::function<void()>& act,
              const RehearsalLimits& limits) {
  const auto nothing_made = [&act] {
    act();
    return std::string();
  };
  performed(where, expected, nothing_made, limits);
}

}  // namespace tyndall
