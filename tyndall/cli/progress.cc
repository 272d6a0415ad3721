#include "tyndall/cli/progress.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace tyndall {

std::string duration_text(double seconds) {
  char text[48];
  const long whole = std::lround(std::min(seconds, 1e9));
  if (seconds < 9.95) {
    std::snprintf(text, sizeof text, "%.1f s", seconds);
  } else if (whole < 60) {
    std::snprintf(text, sizeof text, "%ld s", whole);
  } else if (whole < 3600) {
    std::snprintf(text, sizeof text, "%ld min %02ld s", whole / 60, whole % 60);
  } else {
    std::snprintf(text, sizeof text, "%ld h %02ld min", whole / 3600, whole / 60 % 60);
  }
  return text;
}

ProgressBar::ProgressBar(bool quiet) : quiet_(quiet), terminal_(isatty(STDERR_FILENO) != 0) {}

ProgressBar::~ProgressBar() {
  if (drawn_ && terminal_) std::fputc('\n', stderr);
}

void ProgressBar::show(double fraction, double seconds, const std::string& detail) {
  if (quiet_) return;
  fraction = std::clamp(fraction, 0.0, 1.0);
  const bool over = fraction >= 1.0;
  if (!terminal_) {
    if (seconds < next_line_ && !over) return;
    next_line_ = seconds + std::max(5.0, 0.25 * seconds);
  }
  const std::string left = over              ? "done"
                           : fraction > 0.01 ? duration_text(seconds * (1.0 - fraction) / fraction) + " left"
                                             : "...";
  if (terminal_) {
    constexpr int width = 30;
    const int full = static_cast<int>(fraction * width);
    std::fprintf(stderr, "\r[%.*s%*s] %3.0f %%  %s  %s  %s\033[K", full, "##############################", width - full,
                 "", 100.0 * fraction, duration_text(seconds).c_str(), left.c_str(), detail.c_str());
  } else {
    std::fprintf(stderr, "%3.0f %%  %s  %s  %s\n", 100.0 * fraction, duration_text(seconds).c_str(), left.c_str(),
                 detail.c_str());
  }
  std::fflush(stderr);
  drawn_ = true;
}

}  // namespace tyndall
