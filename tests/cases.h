#pragma once
// How many cases a test has tried, said on a line that scripts/soak_page.py finds in its output.
#include <cstdint>
#include <cstdio>
#include <string>

namespace tyndall::tests {

inline void say_cases(std::int64_t count, const std::string& of) {
  std::printf("cases: %lld %s\n", static_cast<long long>(count), of.c_str());
}

}  // namespace tyndall::tests
