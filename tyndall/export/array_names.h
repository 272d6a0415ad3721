#pragma once
// What printed code calls the constant arrays that it reads.
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tyndall/number/constant_array.h"

namespace tyndall {

/// One name for each array; arrays of equal numbers are one array.
class ArrayNames {
 public:
  struct Entry {
    SharedArray array;
    std::string name;
  };

  /// `reserved` are words that are no names.
  explicit ArrayNames(std::span<const std::string_view> reserved) : taken_(reserved.begin(), reserved.end()) {}
  void avoid(const std::string& name) { taken_.insert(name); }

  /// Names an array after itself, `prefix` in front, with a letter behind where that name is taken.
  void add(const SharedArray& array, const std::string& prefix);
  /// The name of an array that has been added.
  const std::string& name_of(const ConstantArray& array) const;
  const std::vector<Entry>& entries() const { return entries_; }

 private:
  const Entry* find(const ConstantArray& array) const;

  std::set<std::string> taken_;
  std::vector<Entry> entries_;
};

}  // namespace tyndall
