#pragma once
// What a fuzz target demands: libFuzzer keeps the input of a process that aborts.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "tyndall/document/fault.h"

namespace tyndall::fuzz {

inline void must(bool held, const char* what) {
  if (held) return;
  std::fprintf(stderr, "fuzz: does not hold: %s\n", what);
  std::abort();
}

/// Every refusal says where, what was found and what was possible, and cannot steer a terminal.
inline void must_be_a_message(const Fault& fault) {
  must(!fault.where.empty() && !fault.found.empty() && !fault.expected.empty(), "a fault says all three");
  const std::string_view text = fault.what();
  must(text.size() < 4000, "a message is short");
  for (const char c : text) must(static_cast<unsigned char>(c) >= 0x20 && c != 0x7f, "a message is printable");
}

}  // namespace tyndall::fuzz
