#include "tyndall/plot/axis.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <initializer_list>

namespace tyndall {
namespace {

double power_of_ten(int k) { return std::pow(10.0, k); }

std::string formatted(const char* format, double x) {
  char text[64];
  std::snprintf(text, sizeof text, format, x);
  // The program sets no locale, but a host program may.
  for (char* c = text; *c != '\0'; ++c) *c = *c == ',' ? '.' : *c;
  return text[0] == '-' ? "\u2212" + std::string(text + 1) : text;
}

std::string raised(int exponent) {
  static constexpr const char* digits[] = {"\u2070", "\u00b9", "\u00b2", "\u00b3", "\u2074",
                                           "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};
  std::string out = exponent < 0 ? "\u207b" : "";
  for (const char c : std::to_string(std::abs(exponent))) out += digits[c - '0'];
  return out;
}

std::string power_text(int mantissa, int exponent) {
  if (exponent == 0) return std::to_string(mantissa);
  if (exponent == 1) return std::to_string(10 * mantissa);
  return (mantissa == 1 ? "10" : std::to_string(mantissa) + "\u00d710") + raised(exponent);
}

std::vector<Tick> linear_ticks(const Axis& axis, double step, int minors, const char* format) {
  std::vector<Tick> ticks;
  const double minor = step / minors, tolerance = 1e-9 * (axis.high - axis.low);
  const auto first = static_cast<long>(std::ceil((axis.low - tolerance) / minor));
  for (long i = first; static_cast<double>(i) * minor <= axis.high + tolerance; ++i) {
    const double value = static_cast<double>(i) * minor;
    ticks.push_back({value, i == 0 ? "0" : i % minors == 0 ? formatted(format, value) : ""});
  }
  return ticks;
}

std::vector<Tick> logarithmic_ticks(const Axis& axis, double spacing) {
  const double decades = std::log10(axis.high / axis.low), length = std::fabs(axis.end - axis.begin);
  const int first = static_cast<int>(std::floor(std::log10(axis.low) + 1e-9));
  const int last = static_cast<int>(std::ceil(std::log10(axis.high) - 1e-9));
  const int stride = std::max(1, static_cast<int>(std::ceil(decades * spacing / length - 1e-9)));
  const bool between = decades < 2.5 && 0.3 * length / decades >= spacing;  // 1 to 2 are 0.30 decades
  const bool plain = axis.low >= 0.999e-3 && axis.high <= 1.001e4;
  std::vector<Tick> ticks;
  for (int k = first; k <= last; ++k) {
    for (int m = 1; m <= 9; ++m) {
      const double value = m * power_of_ten(k);
      if (value < axis.low * (1.0 - 1e-9) || value > axis.high * (1.0 + 1e-9)) continue;
      const bool labelled = m == 1 ? k % stride == 0 : between && (m == 2 || m == 5);
      if (m > 1 && !labelled && (stride > 1 || decades > 12.0)) continue;
      ticks.push_back({value, !labelled ? "" : plain ? tick_text(value) : power_text(m, k)});
    }
  }
  return ticks;
}

}  // namespace

double Axis::at(double value) const {
  const double share = logarithmic ? std::log(value / low) / std::log(high / low) : (value - low) / (high - low);
  return begin + (end - begin) * std::clamp(share, -0.5, 1.5);
}

std::vector<Tick> ticks_of(const Axis& axis, double spacing) {
  if (axis.logarithmic) return logarithmic_ticks(axis, spacing);
  const double length = std::fabs(axis.end - axis.begin);
  const double least = (axis.high - axis.low) * spacing / length;
  const int k = static_cast<int>(std::floor(std::log10(least)));
  for (const int m : {1, 2, 5, 10, 20}) {
    const double step = m * power_of_ten(k);
    if (step < least * (1.0 - 1e-9)) continue;
    const int decimals = std::max(0, -static_cast<int>(std::floor(std::log10(step) + 1e-9)));
    std::vector<Tick> ticks =
        linear_ticks(axis, step, m == 2 || m == 20 ? 4 : 5, ("%." + std::to_string(decimals) + "f").c_str());
    if (axis.high >= 1e5 || decimals > 4) {
      for (Tick& tick : ticks) tick.label = tick.label.empty() ? "" : tick_text(tick.value);
    }
    return ticks;
  }
  return {};
}

std::vector<Tick> angle_ticks_of(const Axis& axis, double spacing) {
  if (axis.logarithmic) return logarithmic_ticks(axis, spacing);
  const bool fine = std::fabs(axis.end - axis.begin) / 6.0 >= spacing;
  return linear_ticks(axis, fine ? 30.0 : 60.0, fine ? 3 : 4, "%.0f");
}

std::vector<Tick> distance_ticks_of(const Axis& axis, double spacing) {
  std::vector<Tick> ticks = logarithmic_ticks(axis, spacing);
  for (Tick& tick : ticks) {
    const LengthUnit unit = length_unit_for(tick.value);
    if (!tick.label.empty()) tick.label = tick_text(tick.value / unit.metres) + ' ' + unit.name;
  }
  return ticks;
}

Limits round_limits(double low, double high) {
  const auto decade = [](double x) { return power_of_ten(static_cast<int>(std::floor(std::log10(x) + 1e-9))); };
  Limits limits{decade(low), 10.0 * decade(high)};
  for (const double m : {2.0, 5.0}) {
    if (m * decade(low) <= low * (1.0 + 1e-9)) limits.low = m * decade(low);
  }
  for (const double m : {5.0, 2.0, 1.0}) {
    if (m * decade(high) >= high * (1.0 - 1e-9)) limits.high = m * decade(high);
  }
  return limits;
}

Limits decade_limits(double low, double high) {
  return {power_of_ten(static_cast<int>(std::floor(std::log10(low) + 1e-9))),
          power_of_ten(static_cast<int>(std::ceil(std::log10(high) - 1e-9)))};
}

std::string decade_text(int exponent, bool plain) {
  return plain ? tick_text(power_of_ten(exponent)) : power_text(1, exponent);
}

std::string tick_text(double x) {
  if (x == 0.0 || (x >= 0.999e-3 && x < 1.001e4)) return formatted("%.6g", x);
  const std::string digits = formatted("%.5e", x);
  const double mantissa = std::stod(digits.substr(0, digits.find('e')));
  const std::string power = "10" + raised(std::stoi(digits.substr(digits.find('e') + 1)));
  return mantissa == 1.0 ? power : formatted("%.6g", mantissa) + "\u00d7" + power;
}

std::string quantity_text(double x) {
  if (std::isnan(x)) return "\u2013";
  if (std::isinf(x)) return "\u221e";
  if (x == 0.0) return "0";
  if (x < 0.0) return "\u2212" + quantity_text(-x);
  const std::string digits = formatted("%.2e", x);  // rounds first: 999.6 is 1.00e3
  const std::size_t e = digits.find('e');
  const int exponent = std::stoi(digits.substr(e + 1));
  if (exponent < -3 || exponent > 5) return digits.substr(0, e) + "\u00d710" + raised(exponent);
  if (exponent >= 2) return formatted("%.0f", std::stod(digits));
  return formatted(("%." + std::to_string(2 - exponent) + "f").c_str(), x);
}

std::string share_text(double x) {
  const double rest = 1.0 - std::fabs(x);
  if (!(rest > 0.0 && rest < 5e-4)) return rest == 0.0 ? (x > 0.0 ? "1" : "\u22121") : quantity_text(x);
  const int decimals = static_cast<int>(std::ceil(-std::log10(rest) - 1e-9));
  if (decimals > 6) return x > 0.0 ? "~1" : "~\u22121";
  return formatted(("%." + std::to_string(decimals) + "f").c_str(), x);
}

std::string distance_text(double metres) {
  if (!std::isfinite(metres)) return quantity_text(metres);
  if (metres >= 1e9) return "> 10" + raised(6) + " km";
  if (metres < 1e-6) return "< 1 \u00b5m";
  const LengthUnit unit = length_unit_for(metres);
  return quantity_text(metres / unit.metres) + ' ' + unit.name;
}

LengthUnit length_unit_for(double metres) {
  if (metres >= 999.5) return {"km", 1000.0};
  if (metres >= 0.9995) return {"m", 1.0};
  if (metres >= 0.009995) return {"cm", 0.01};
  return {"mm", 0.001};
}

}  // namespace tyndall
