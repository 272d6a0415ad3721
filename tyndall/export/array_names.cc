#include "tyndall/export/array_names.h"

#include <algorithm>
#include <cassert>

namespace tyndall {

const ArrayNames::Entry* ArrayNames::find(const ConstantArray& array) const {
  const auto found = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) {
    return entry.array.get() == &array || entry.array->values() == array.values();
  });
  return found == entries_.end() ? nullptr : &*found;
}

void ArrayNames::add(const SharedArray& array, const std::string& prefix) {
  if (find(*array) != nullptr) return;
  const std::string base = prefix + array->name();
  std::string name = base;
  for (int i = 1; !taken_.insert(name).second; ++i)
    name = base + "_" + (i < 26 ? std::string(1, static_cast<char>('a' + i)) : std::to_string(i));
  entries_.push_back({array, name});
}

const std::string& ArrayNames::name_of(const ConstantArray& array) const {
  const Entry* const entry = find(array);
  assert(entry != nullptr);
  return entry->name;
}

}  // namespace tyndall
