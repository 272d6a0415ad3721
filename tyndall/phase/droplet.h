#pragma once
// Water droplets by their diameter: a fit to Mie's theory.
#include <array>
#include <numbers>
#include <string_view>
#include <tuple>

#include "tyndall/number/field.h"
#include "tyndall/phase/lobe_sum.h"

namespace tyndall {

/// (1 - w) h(g_h) + w d(g_d, alpha) with Henyey and Greenstein's h and Draine's d (Jendersie and d'Eon 2023, eqs. 4 to
/// 19): water droplets in visible light, diameters of 5 to 50 um to within 5 % of Mie's theory, smaller ones roughly.
/// Fogbow and glory are smoothed away. The paper's four ranges do not meet; each border at 0.1, 1.5 and 5 um is
/// cross-faded over 10 % to both sides, so that an animated diameter never jumps.
template <class T>
struct Droplet {
  static constexpr std::string_view name = "droplet";
  static constexpr std::string_view text = "Fog and cloud, by the diameter of their droplets.";
  T diameter = T(10.0);
  static constexpr auto fields() {
    return std::tuple{Field{"diameter", &Droplet::diameter, Range{0.01, 50.0}, "um",
                            "Diameter of the droplets in micrometres: haze 0.5, fog 5 to 20, drizzle above.",
                            Scaling::none, true}};
  }

  LobeSum<T> lower() const {
    LobeSum<T> out;
    for_each_lobe([&](const T& weight, const Lobe<T>& lobe) { out.push_back({weight, lobe}); });
    return out;
  }
  /// At most this many lobes.
  static constexpr std::size_t most_lobes = 4;
  /// Calls put(weight, lobe) for each lobe of lower().
  template <class Put>
  void for_each_lobe(Put&& put) const {
    constexpr std::array borders{0.1, 1.5, 5.0};
    // The nearest border decides which two fits are blended.
    const T d = named("diameter", diameter);
    const auto low = d<T(0.3), high = d> T(2.7);
    const T border = named("border", select(low, T(borders[0]), select(high, T(borders[2]), T(borders[1]))));
    const T x = named("x", max(T(0.0), min(T(1.0), (d / border - T(0.9)) / T(0.2))));
    const T over = named("over", x * x * (T(3.0) - T(2.0) * x));
    const Fit tiny = tiny_fit(min(d, T(0.11))), small = small_fit(max(T(0.09), min(d, T(1.65)))),
              middle = middle_fit(max(T(1.35), min(d, T(5.5)))), large = large_fit(max(T(4.5), d));
    const auto add = [&](const char* which, const T& share, const Fit& below, const Fit& between, const Fit& above) {
      const auto chosen = [&](T Fit::*value) {
        return select(low, below.*value, select(high, above.*value, between.*value));
      };
      const T weight = named("draine_share", chosen(&Fit::weight));
      const T beside = named("beside_peak", chosen(&Fit::beside_peak));
      push(put, named(which, share * (T(1.0) - weight)),
           HenyeyGreensteinLobe<T>{named("g_peak", T(1.0) - beside), beside});
      push(put, named(which, share * weight),
           DraineLobe<T>::of(named("g_draine", chosen(&Fit::g_draine)), named("alpha", chosen(&Fit::alpha))));
    };
    add("share_below", T(1.0) - over, tiny, small, middle);
    add("share_above", over, small, middle, large);
  }

 private:
  struct Fit {
    T beside_peak;  // 1 - g of the Henyey-Greenstein lobe, which is near 1
    T g_draine, alpha, weight;
  };
  /// A fit without part in the law need not be carried along; numbers without a value of their own keep all.
  template <class Put>
  static void push(Put& put, const T& weight, const Lobe<T>& lobe) {
    if constexpr (Scalar<T>) {
      if (weight == T(0.0)) return;
    }
    put(weight, lobe);
  }
  static T power(const T& x, double exponent) { return exp(T(exponent) * log(x)); }

  static Fit tiny_fit(const T& d) {
    return {T(1.0) - T(13.8) * d * d, T(1.1456) * d * sin(T(9.29044) * d), T(250.0),
            T(0.252977) - T(312.983) * power(d, 4.3)};
  }
  static Fit small_fit(const T& d) {
    const T l = named("log_small", log(d));
    const T shift = (l - T(0.238604)) * (l + T(1.00667)) / (T(0.507522) - T(0.15677) * l);
    return {T(0.138) + T(0.143) * l * l,
            fma(T(0.379685), cos(fma(T(1.19692), cos(shift), fma(T(1.37932), l, T(0.0625835)))), T(0.344213)), T(250.0),
            fma(T(0.146209), cos(fma(T(3.38707), l, T(2.11193))), fma(T(0.0778917), l, T(0.316072)))};
  }
  static Fit middle_fit(const T& d) {
    const T l = named("log_middle", log(d));
    const T tangent = sin(l) / cos(l);
    return {fma(T(-0.0604931), log(l), T(0.059744)),
            T(0.500411) - T(0.081287) / (fma(T(-2.0), l, tangent) + T(1.27551)), fma(T(7.30354), l, T(6.31675)),
            fma(T(0.026914), l - cos(T(5.68947) * (log(l) - T(0.0292149))), T(0.376475))};
  }
  static Fit large_fit(const T& d) {
    return {-expm1(T(-0.0990567) / (d - T(1.67154))), exp(T(-2.20679) / (d + T(3.91029)) - T(0.428934)),
            exp(T(3.62489) - T(8.29288) / (d + T(5.52825))), exp(T(-0.599085) / (d - T(0.641583)) - T(0.665888))};
  }
};

}  // namespace tyndall
