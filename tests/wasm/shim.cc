// The C functions by which a page reads the numbers out of the module's memory.
#include "numbers.h"

#define EXPORT(name) extern "C" __attribute__((export_name(#name)))

namespace {
const std::vector<tyndall::NumberGroup>& groups() {
  static const std::vector<tyndall::NumberGroup> all = tyndall::every_number();
  return all;
}
}  // namespace

EXPORT(group_count) std::size_t group_count() { return groups().size(); }
EXPORT(group_name) const char* group_name(std::size_t group) { return groups()[group].name.c_str(); }
EXPORT(value_count) std::size_t value_count(std::size_t group) { return groups()[group].values.size(); }
EXPORT(values) const double* values(std::size_t group) { return groups()[group].values.data(); }
