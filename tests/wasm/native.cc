// Prints every group of numbers as a line: its name, a tab, the bits of each number in hexadecimal.
#include <bit>
#include <cinttypes>
#include <cstdio>

#include "numbers.h"

int main() {
  for (const tyndall::NumberGroup& group : tyndall::every_number()) {
    std::printf("%s\t", group.name.c_str());
    for (const double x : group.values) std::printf(" %016" PRIx64, std::bit_cast<std::uint64_t>(x));
    std::printf("\n");
  }
}
