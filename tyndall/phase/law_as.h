#pragma once
// The same law in another number: double from a file, Dual for its derivatives, Symbol for its shader text.
#include <string>
#include <type_traits>
#include <utility>

#include "tyndall/phase/law.h"

namespace tyndall {

/// A law of numbers T becomes the same law of numbers U, walking the field descriptions: number(name, x) gives the new
/// value of parameter `name`. Parameters of a list's parts are numbered: weight_1, g_1, weight_2, g_2_1, ...
template <class U, class T, class Number>
struct LawConversion {
  Number number;

  template <template <class> class Described>
  Described<U> operator()(const Described<T>& from, const std::string& suffix = "") {
    Described<U> to;
    constexpr auto count = std::tuple_size_v<decltype(Described<U>::fields())>;
    [&]<std::size_t... i>(std::index_sequence<i...>) {
      (assign(to.*(std::get<i>(Described<U>::fields()).member), from.*(std::get<i>(Described<T>::fields()).member),
              std::string(std::get<i>(Described<U>::fields()).name), suffix),
       ...);
    }
    (std::make_index_sequence<count>{});
    return to;
  }
  Law<U> operator()(const Law<T>& from, const std::string& suffix = "") {
    return std::visit([&](const auto& law) -> Law<U> { return (*this)(law, suffix); }, from);
  }

 private:
  void assign(U& to, const T& from, const std::string& name, const std::string& suffix) {
    to = number(name + suffix, from);
  }
  void assign(Law<U>& to, const Law<T>& from, const std::string&, const std::string& suffix) {
    to = (*this)(from, suffix);
  }
  template <template <class> class Part>
  void assign(std::vector<Part<U>>& to, const std::vector<Part<T>>& from, const std::string&,
              const std::string& suffix) {
    for (std::size_t i = 0; i < from.size(); ++i) to.push_back((*this)(from[i], suffix + "_" + std::to_string(i + 1)));
  }
  // Parameters that are no numbers (counts, choices, texts) stay as they are.
  template <class Same>
  requires(!std::is_same_v<Same, U> && !std::is_same_v<Same, T>) void assign(Same& to, const Same& from,
                                                                             const std::string&, const std::string&) {
    to = from;
  }
};

template <class U, class T, class Number>
Law<U> law_as(const Law<T>& law, Number number) {
  return LawConversion<U, T, Number>{number}(law);
}
/// The plain conversion, by U's constructor from T.
template <class U, class T>
Law<U> law_as(const Law<T>& law) {
  return law_as<U>(law, [](const std::string&, const T& x) { return U(x); });
}

}  // namespace tyndall
