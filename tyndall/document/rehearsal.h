#pragma once
// Rehearsals: what foreign files make a library do is tried first in a child process with limits, so that its crash,
// its endless loop or its appetite for memory becomes a message. The parent then does the same on the same bytes; or it
// never touches them and takes what the child has made of them.
#include <cstdint>
#include <functional>
#include <string>

namespace tyndall {

struct RehearsalLimits {
  std::uint64_t memory = std::uint64_t{6} << 30;  // [bytes] beyond what this process already has
  unsigned seconds = 60;                          // of processor time
};

/// Runs `act` in a child process. Returns the bytes that it returned there. Throws the Fault that `act` threw there, or
/// a Fault {where, what happened to the child, expected}. `act` must not depend on other threads; nothing it changes in
/// memory is seen here. The memory limit is left out under AddressSanitizer, which reserves terabytes.
std::string performed(const std::string& where, const std::string& expected, const std::function<std::string()>& act,
                      const RehearsalLimits& limits = {});

/// The same where nothing is handed back.
void rehearse(const std::string& where, const std::string& expected, const std::function<void()>& act,
              const RehearsalLimits& limits = {});

}  // namespace tyndall
