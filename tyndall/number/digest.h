#pragma once
// A digest of numbers and described values, for telling contents apart. Not for secrets: whoever wants two contents of
// one digest can make them.
#include <bit>
#include <cstdint>
#include <optional>
#include <string_view>
#include <type_traits>
#include <variant>

#include "tyndall/number/described.h"
#include "tyndall/number/grid_file.h"
#include "tyndall/number/number_file.h"

namespace tyndall {

/// 64 bits of what was added, in its order. Each word goes through the finalizer of SplitMix64 (G. Steele, D. Lea, C.
/// Flood, "Fast splittable pseudorandom number generators", OOPSLA 2014, fig. 14), a bijection in which every bit of
/// the word reaches every bit of the digest.
class Digest {
 public:
  void add(std::uint64_t word) {
    state_ = (state_ ^ word) + 0x9e3779b97f4a7c15U;
    state_ = (state_ ^ (state_ >> 30)) * 0xbf58476d1ce4e5b9U;
    state_ = (state_ ^ (state_ >> 27)) * 0x94d049bb133111ebU;
    state_ ^= state_ >> 31;
  }
  /// Bits, so that 0 and -0 differ.
  void add(double x) { add(std::bit_cast<std::uint64_t>(x)); }
  void add(std::string_view text) {
    add(std::uint64_t{text.size()});
    for (const char c : text) add(static_cast<std::uint64_t>(static_cast<unsigned char>(c)));
  }

  std::uint64_t value() const { return state_; }

 private:
  std::uint64_t state_ = 0;
};

/// Adds every field of a value of the kinds that descriptions know (described.h); of a file of numbers, the numbers; of
/// a file of voxels, their digest.
template <class T>
void add_value(Digest& digest, const T& value) {
  if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
    digest.add(static_cast<double>(value));
  } else if constexpr (std::is_convertible_v<const T&, std::string_view>) {
    digest.add(std::string_view(value));
  } else if constexpr (std::is_same_v<T, NumberFile>) {
    digest.add(value.rows ? static_cast<double>(value.rows->columns) : 0.0);
    if (value.rows) add_value(digest, value.rows->values);
  } else if constexpr (std::is_same_v<T, GridFile>) {
    digest.add(value.grid ? value.content : 0);
  } else if constexpr (OptionalMember<T>) {
    digest.add(value ? 1.0 : 0.0);
    if (value) add_value(digest, *value);
  } else if constexpr (Choice<T>) {
    digest.add(static_cast<double>(value.index()));
    std::visit([&](const auto& chosen) { add_value(digest, chosen); }, value);
  } else if constexpr (Described<T>) {
    for_each_field<T>([&](const auto& field) { add_value(digest, value.*field.member); });
  } else if constexpr (requires { value.value.size(); }) {  // a Spectrum
    add_value(digest, value.value);
  } else if constexpr (requires { value.x, value.y, value.z; }) {  // a Vector
    digest.add(static_cast<double>(value.x)), digest.add(static_cast<double>(value.y)),
        digest.add(static_cast<double>(value.z));
  } else {  // a list or an array
    digest.add(static_cast<double>(value.size()));
    for (const auto& element : value) add_value(digest, element);
  }
}

}  // namespace tyndall
