#pragma once
// Values per colour channel.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace tyndall {

/// How many channels light is transported in. Everything takes it from here, so that more wavelengths can follow.
inline constexpr std::size_t channel_count = 3;

/// One number per channel; arithmetic is channel by channel.
template <class T, std::size_t N>
struct Channels {
  std::array<T, N> value{};

  static constexpr Channels grey(T x) {
    Channels c;
    c.value.fill(x);
    return c;
  }
  constexpr T& operator[](std::size_t i) { return value[i]; }
  constexpr const T& operator[](std::size_t i) const { return value[i]; }
  constexpr bool operator==(const Channels&) const = default;

  constexpr Channels& operator+=(const Channels& b) { return *this = *this + b; }
  constexpr Channels& operator-=(const Channels& b) { return *this = *this - b; }
  constexpr Channels& operator*=(const Channels& b) { return *this = *this * b; }
  constexpr Channels& operator*=(T b) { return *this = *this * b; }
  friend constexpr Channels operator+(Channels a, const Channels& b) {
    for (std::size_t i = 0; i < N; ++i) a[i] = a[i] + b[i];
    return a;
  }
  friend constexpr Channels operator-(Channels a, const Channels& b) {
    for (std::size_t i = 0; i < N; ++i) a[i] = a[i] - b[i];
    return a;
  }
  friend constexpr Channels operator*(Channels a, const Channels& b) {
    for (std::size_t i = 0; i < N; ++i) a[i] = a[i] * b[i];
    return a;
  }
  friend constexpr Channels operator/(Channels a, const Channels& b) {
    for (std::size_t i = 0; i < N; ++i) a[i] = a[i] / b[i];
    return a;
  }
  friend constexpr Channels operator*(Channels a, T b) {
    for (auto& x : a.value) x = x * b;
    return a;
  }
  friend constexpr Channels operator*(T b, const Channels& a) { return a * b; }
  friend constexpr Channels operator/(Channels a, T b) {
    for (auto& x : a.value) x = x / b;
    return a;
  }
};

/// Linear values per channel: coefficients [1/m], radiance [W/(m^2 sr)], reflectances, ...
using Spectrum = Channels<double, channel_count>;

/// f of every channel.
template <class T, std::size_t N, class F>
constexpr Channels<T, N> map(Channels<T, N> a, F f) {
  for (auto& x : a.value) x = f(x);
  return a;
}
template <class T, std::size_t N>
Channels<T, N> exp(const Channels<T, N>& a) {
  return map(a, [](T x) { return std::exp(x); });
}
template <class T, std::size_t N>
constexpr T sum(const Channels<T, N>& a) {
  T s{};
  for (const T& x : a.value) s = s + x;
  return s;
}
template <class T, std::size_t N>
constexpr T mean(const Channels<T, N>& a) {
  return sum(a) / static_cast<T>(N);
}
template <class T, std::size_t N>
constexpr T largest(const Channels<T, N>& a) {
  return *std::max_element(a.value.begin(), a.value.end());
}
template <class T, std::size_t N>
constexpr T smallest(const Channels<T, N>& a) {
  return *std::min_element(a.value.begin(), a.value.end());
}
template <class T, std::size_t N>
constexpr bool is_zero(const Channels<T, N>& a) {
  return std::all_of(a.value.begin(), a.value.end(), [](const T& x) { return x == T{}; });
}
template <class T, std::size_t N>
bool is_finite(const Channels<T, N>& a) {
  return std::all_of(a.value.begin(), a.value.end(), [](const T& x) { return std::isfinite(x); });
}

/// Relative luminance of linear sRGB (ITU-R BT.709 primaries).
constexpr double luminance(const Spectrum& rgb) { return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]; }

}  // namespace tyndall
