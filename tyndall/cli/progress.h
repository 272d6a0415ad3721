#pragma once
// Telling a person how long work has still to go.
#include <chrono>
#include <string>

namespace tyndall {

/// A bar on a terminal, a plain line now and then elsewhere, nothing when quiet; on stderr.
class ProgressBar {
 public:
  explicit ProgressBar(bool quiet);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// fraction in [0, 1]; `detail` is what else is known, such as samples and noise.
  void show(double fraction, double seconds, const std::string& detail);

 private:
  bool quiet_, terminal_, drawn_ = false;
  double next_line_ = 0.0;  // seconds, where lines are plain
};

/// "1 h 02 min", "3 min 05 s", "4.2 s".
std::string duration_text(double seconds);

}  // namespace tyndall
