#pragma once
// Airlight in closed form, for lobes that are polynomials in mu. Double, host only.
#include <optional>

#include "tyndall/light/airlight.h"

namespace tyndall {

/// A number with a bound on its absolute error, so that a closed form can tell when it has lost its digits.
struct Bounded {
  double value = 0.0, error = 0.0;

  /// Bound for values that are right to a few units of the last place.
  static Bounded rounded(double x, double relative = 1e-15) { return {x, relative * std::fabs(x)}; }
  friend Bounded operator+(Bounded a, Bounded b) { return {a.value + b.value, a.error + b.error}; }
  friend Bounded operator-(Bounded a, Bounded b) { return {a.value - b.value, a.error + b.error}; }
  friend Bounded operator*(double s, Bounded a) { return {s * a.value, std::fabs(s) * a.error}; }
};

/// J_k = int e^(-u (v - v0)) (1 + v^2)^-k dv over [v0, v1], k = 1 .. J.size(); v0, v1 > 0, u >= 0. With
/// K_k = int v e^(-u (v - v0)) (1 + v^2)^-k dv, [f] = f(v1) - f(v0) and S(z) = e^z E1(z):
///   K_1 + i J_1 = int e^(-u (v - v0)) / (v - i) dv = S(u (v0 - i)) - e^(-u (v1 - v0)) S(u (v1 - i)),
///   K_k     = -([e^(-u (v - v0)) (1 + v^2)^(1-k)] + u J_(k-1)) / (2 (k - 1)),
///   J_(k+1) = ((2 k - 1) J_k + [v e^(-u (v - v0)) (1 + v^2)^-k] + u K_k) / (2 k),
/// the last two by parts. J_1 is Sun, Ramamoorthi, Narasimhan and Nayar 2005; the scale e^(u v0) and S instead of E1
/// keep it from overflowing however far the lamp is. Digits are lost on short intervals (differences) and for u beyond
/// about 12 (the recurrence grows like e^u); the errors say so.
inline void airlight_moments(double u, double v0, double v1, std::span<Bounded> moments) {
  Bounded j, k;
  const double fade = std::exp(-u * (v1 - v0));
  if (u > 0.0) {
    const std::complex<double> near = scaled_exponential_integral({u * v0, -u});
    const std::complex<double> far = fade > 0.0 ? scaled_exponential_integral({u * v1, -u}) : 0.0;
    const auto size = [](const std::complex<double>& z) { return std::fabs(z.real()) + std::fabs(z.imag()); };
    const double error = 4e-15 * (size(near) + fade * (1.0 + u * (v1 - v0)) * size(far));
    j = {near.imag() - fade * far.imag(), error};
    k = {near.real() - fade * far.real(), error};
  } else {
    const double angle = std::atan2(v1 - v0, 1.0 + v0 * v1);
    const double ratio = 0.5 * std::log1p((v1 - v0) * (v1 + v0) / (1.0 + v0 * v0));
    j = Bounded::rounded(angle, 4e-15);
    k = Bounded::rounded(ratio, 4e-15);
  }
  const double q0 = 1.0 / (1.0 + v0 * v0), q1 = 1.0 / (1.0 + v1 * v1);
  double power0 = 1.0, power1 = fade;  // (1 + v^2)^(1-n) at both ends, the far one faded
  for (std::size_t n = 1; n <= moments.size(); ++n) {
    const double digits = 1e-15 * static_cast<double>(n + 1);
    if (n > 1) {
      const Bounded bracket = Bounded::rounded(power1, digits) - Bounded::rounded(power0, digits);
      const Bounded next_k = (-0.5 / static_cast<double>(n - 1)) * (bracket + u * j);
      // j and k still belong to n - 1 here, as do v q^(n-1) = v power: J_n from J_(n-1) and K_(n-1).
      const Bounded sides = Bounded::rounded(v1 * power1, digits) - Bounded::rounded(v0 * power0, digits);
      j = (0.5 / static_cast<double>(n - 1)) * (static_cast<double>(2 * n - 3) * j + sides + u * k);
      k = next_k;
    }
    moments[n - 1] = j;
    power0 *= q0;
    power1 *= q1;
  }
}

/// The highest k of J_k that a lobe asks for; 0 when it has no closed form (Henyey-Greenstein, say: p goes as
/// (1 + v^2)^(3/2) / ((1 + g)^2 v^2 + (1 - g)^2)^(3/2)).
inline int airlight_order(const Lobe<double>& lobe) {
  if (std::holds_alternative<IsotropicLobe<double>>(lobe)) return 1;
  if (std::holds_alternative<RayleighLobe<double>>(lobe)) return 3;
  if (const auto* power = std::get_if<PowerLobe<double>>(&lobe)) return power->n + 1;
  return 0;
}

/// int p / (1 + v^2) e^.. dv of one lobe from the moments; with q = 1/(1 + v^2), mu = 2 q - 1.
inline Bounded airlight_of(const Lobe<double>& lobe, std::span<const Bounded> j) {
  if (std::holds_alternative<IsotropicLobe<double>>(lobe)) return inverse_four_pi<double>() * j[0];
  if (const auto* rayleigh = std::get_if<RayleighLobe<double>>(&lobe)) {
    // p = A + B mu^2, mu^2 = 1 - 4 q + 4 q^2.
    const double a = rayleigh->density(Deflection<double>::from_mu(0.0));
    const double b = rayleigh->density(Deflection<double>::from_mu(1.0)) - a;
    return (a + b) * j[0] + 4.0 * b * (j[2] - j[1]);
  }
  if (const auto* power = std::get_if<PowerLobe<double>>(&lobe)) {
    return (power->n + 1.0) * inverse_four_pi<double>() * j[static_cast<std::size_t>(power->n)];
  }
  return {0.0, infinity};
}

/// As airlight_by_panels with even falloff, in closed form:
///   radiance = (2 / aside) e^(-extinction (t0 + r0)) sum_i scattering_i int p_i e^(-u (v - v0)) / (1 + v^2) dv.
/// None where some lobe has no closed form, its power is beyond 64, or more than `relative_error` cannot be excluded.
inline std::optional<Spectrum> airlight_in_closed_form(std::span<const ScatteringLobe> lobes,
                                                       const Spectrum& extinction, const AirlightStretch& stretch,
                                                       double relative_error = 1e-11) {
  constexpr int most = 65;
  int order = 1;
  for (const ScatteringLobe& part : lobes) {
    const int needed = airlight_order(part.lobe);
    if (needed == 0 || needed > most) return std::nullopt;
    order = std::max(order, needed);
  }
  if (stretch.diverges) return divergent(lobes);
  Spectrum radiance;
  if (!(stretch.span > 0.0)) return radiance;
  const double v0 = stretch.start, v1 = stretch.start * std::exp(stretch.span);
  if (!(v0 > 1e-100 && v1 < 1e100)) return std::nullopt;
  std::array<Bounded, most> space;
  const std::span<Bounded> moments(space.data(), static_cast<std::size_t>(order));
  for (std::size_t c = 0; c < channel_count; ++c) {
    if (c == 0 || extinction[c] != extinction[c - 1]) airlight_moments(extinction[c] * stretch.aside, v0, v1, moments);
    Bounded sum;
    for (const ScatteringLobe& part : lobes) sum = sum + part.scattering[c] * airlight_of(part.lobe, moments);
    if (!(sum.error <= relative_error * sum.value && std::isfinite(sum.value))) return std::nullopt;
    radiance[c] = 2.0 / stretch.aside * std::exp(-extinction[c] * stretch.path) * sum.value;
  }
  return radiance;
}

/// Radiance that a lamp of 1 W/sr, shining alike in all directions, scatters into the ray's origin from the lit stretch
/// of it, through a homogeneous medium: the closed form where it holds 11 digits, else panels. Relative error below
/// 1e-10 for lobes with |g| <= 0.9999, any extinction >= 0, any lengths [m], for tables as `knots` says; infinite where
/// the lamp stands on the stretch.
inline Spectrum airlight(std::span<const ScatteringLobe> lobes, const Spectrum& extinction, const LampAside& lamp,
                         const Interval& lit, TableKnotPanels knots = TableKnotPanels::split) {
  const AirlightStretch stretch = AirlightStretch::of(lamp, lit);
  if (const auto closed = airlight_in_closed_form(lobes, extinction, stretch)) return *closed;
  return airlight_by_panels(lobes, extinction, stretch, EvenFalloff{}, knots);
}

}  // namespace tyndall
