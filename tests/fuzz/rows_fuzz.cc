// Any bytes as a file of numbers (CSV): finite numbers in rows of one length, or a message.
#include <cmath>

#include "tests/fuzz/must.h"
#include "tyndall/document/number_rows.h"

using namespace tyndall;
using fuzz::must;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const NumberRows rows = parse_number_rows({reinterpret_cast<const char*>(data), size}, "fuzz");
    must(rows.rows() >= 1 && rows.columns >= 1 && rows.values.size() == rows.rows() * rows.columns, "rows are whole");
    for (const double x : rows.values) must(std::isfinite(x), "a number");
  } catch (const Fault& fault) {
    fuzz::must_be_a_message(fault);
  }
  return 0;
}
