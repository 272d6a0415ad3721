#pragma once
// The lobe of Fournier and Forand, for particles of many sizes in water.
#include <array>
#include <numbers>
#include <tuple>

#include "tyndall/phase/cdf_inverse.h"

namespace tyndall {

/// Fournier and Forand 1994 in the form of Fournier and Jonasz 1999 (Mobley, Sundman and Boss 2002, eq. 4): with
/// v = sin^2(t/2), d = 4 v / (3 (n - 1)^2) = scale v and nu = (3 - slope)/2,
///   p = [nu (1 - d) - (1 - d^nu) + (d (1 - d^nu) - nu (1 - d))/v] / (4 pi (1 - d)^2 d^nu) + tail (3 mu^2 - 1) / (16
///   pi).
/// -1 < nu < 0, scale >= 4; tail = (1 - D^nu)/((D - 1) D^nu) with D = scale, the value at straight back.
///
/// p grows as v^(-nu - 1) toward t = 0 without bound, though its integral does not. So 1 - F is multiplied by
/// (1 + core (1 - v)/v)^(-1 - nu), which flattens the peak inside v = core = 1e-18 (t < 2e-9 rad), leaves what is a
/// thousandth of a degree off to 1e-8, and keeps the integral 1.
template <class T>
struct FournierForandLobe {
  T nu = T(-0.3);
  T scale = T(133.0);
  T tail = T(0.0);

  static FournierForandLobe of(const T& n, const T& slope) {
    const T nu = named("nu", T(0.5) * (T(3.0) - slope));
    const T scale = named("scale", T(4.0 / 3.0) / ((n - T(1.0)) * (n - T(1.0))));
    const T size = named("size", exp(-nu * log(scale)));  // D^-nu
    return {nu, scale, named("tail", (size - T(1.0)) / (scale - T(1.0)))};
  }
  static constexpr auto members() {
    return std::tuple{&FournierForandLobe::nu, &FournierForandLobe::scale, &FournierForandLobe::tail};
  }

  T density(const Deflection<T>& d) const { return passage(d).density; }
  T cdf(const Deflection<T>& d) const { return passage(d).below; }
  T survival(const Deflection<T>& d) const { return passage(d).above; }
  /// F, 1 - F and p together: what costs is common to all three.
  Passage<T> passage(const Deflection<T>& d) const {
    const T u = T(0.5) * d.one_plus;
    const Core c = core_at(T(0.5) * d.one_minus, u);
    const T v = c.v;
    const Powers p = powers(v);
    // Without the core: F = u b less tail/8 mu (1 - mu^2), u = 1 - v, 1 - F = (1 - b) + v b and that; 4 pi p = (b - u
    // k)/v + the tail, with b - u k = (b - k) + v k.
    const T bulge = named("bulge", T(0.5) * tail * (u - v));
    const T above = named("over_all", fma(p.b, v, fma(bulge * u, v, p.rest)));
    const T below = u * (p.b - bulge * v);
    const T lobe = named("lobe", fma(p.difference, c.inverse, p.k));
    const T outside = inverse_four_pi<T>() * fma(T(0.25) * tail, fma(T(3.0) * d.mu, d.mu, T(-1.0)), lobe);
    const T reach = named("reach", inverse_four_pi<T>() * above);
    // Innermost, where `inside` counts, 1 - F is a straight line.
    const auto straight = c.inside < T(1.0);
    const T over = named("over", above * c.factor);
    return {select(straight, T(1.0) - over * c.inside, fma(above, T(1.0) - c.factor, below)), over * c.inside,
            c.factor * select(straight, reach * c.inverse, fma(reach, c.slope, outside))};
  }

  /// From where the ends of F would put it: ahead 1 - F = d^m, m = -nu, in the flattened core proportional to v, and
  /// behind F = u scale^(m - 1).
  Deflection<T> sample(const T& xi) const {
    const T m = -nu, reach = T(log_odds_reach<T>), tiny = T(least_share<T>);
    const T log_scale = named("log_scale", log(scale)), above = named("log_above", log(max(T(1.0) - xi, tiny)));
    const T core_ahead = m * log_scale - above - (T(1.0) - m) * T(log_core);
    const T ahead = named("ahead", max(T(0.0), min(log_scale - above / m, core_ahead)));
    const T behind = named("behind", min(T(0.0), log(max(xi, tiny)) + (T(1.0) - m) * log_scale));
    return inverse_of_cdf(*this, xi, -reach, reach, max(-reach, min(reach, ahead + behind)), is_double<T> ? 24 : 13);
  }

  /// By the trapezoidal rule in the log-odds s of the deflection, where the integrand is smooth and falls off
  /// exponentially on both sides. Absolute error 1e-10 in double for l <= 40, 1e-6 in float for l <= 8.
  T moment(int l) const {
    if (l == 0) return T(1.0);
    // From where 1e-34 of the sphere is left ahead (the slowest peak, nu = -0.05, has 1e-11 of its light there) to the
    // same behind, where e^-32 is enough.
    const double step = is_double<T> ? 1.0 / 16.0 : 1.0 / 4.0, behind = 32.0, ahead = 78.0;
    const auto add = [&](const std::array<T, 2>& state) -> std::array<T, 2> {
      const T s = named("s", state[0]);
      const Deflection<T> d = Deflection<T>::from_ends(T(2.0) / (T(1.0) + exp(s)), T(2.0) / (T(1.0) + exp(-s)));
      const T share = named("share", density(d) * d.one_minus * d.one_plus);
      return {s + T(step), fma(share, legendre(l, d), state[1])};
    };
    const int turns = static_cast<int>((behind + ahead) / step) + 1;
    return T(std::numbers::pi * step) * iterate(turns, std::array<T, 2>{T(-behind), T(0.0)}, add)[1];
  }

 private:
  static constexpr double core = 1e-18, log_core = -41.44653167389282;
  /// `factor` flattens the peak; slope is d ln(factor)/dv. Inside v = 1e-29 all is straight: v stays there, and
  /// `inside` is the share of it. inverse is 1/v.
  struct Core {
    T v, inverse, factor, slope, inside;
  };
  Core core_at(const T& v, const T& u) const {
    const T least = T(1e-29), kept = named("v", max(v, least)), inverse = named("inverse_v", T(1.0) / kept);
    const T near = named("near", T(core) * inverse), q = named("q", fma(near, u, T(1.0)));
    return {kept, inverse, named("core_factor", exp(-(T(1.0) + nu) * log(q))),
            named("core_slope", (T(1.0) + nu) * (near / q) * inverse), min(T(1.0), v * T(1e29))};
  }

  static T legendre(int l, const Deflection<T>& d) {
    T before(1.0), here = d.mu;
    for (int k = 1; k < l; ++k) {
      const T next = named("legendre", fma(T((2.0 * k + 1.0) / (k + 1.0)) * d.mu, here, T(-k / (k + 1.0)) * before));
      before = here;
      here = next;
    }
    return here;
  }

  /// What d = scale v enters by, with m = -nu: power = d^m, b = (d^m - 1)/(d - 1) and k = (m d^m - b)/(d - 1), which
  /// are smooth at d = 1 (there by the binomial series); rest = 1 - b and difference = b - k are small with d.
  struct Powers {
    T b, k, rest, difference;
  };
  Powers powers(const T& v) const {
    const T m = -nu;
    const T d = named("d", scale * v), off = named("off", d - T(1.0));
    // ln d keeps its digits near 1 as 2 artanh(off / (2 + off)).
    const T z = named("z", off / (T(2.0) + off)), z2 = named("z2", z * z);
    T series = T(is_double<T> ? 1.0 / 19.0 : 1.0 / 9.0);
    for (int odd = is_double<T> ? 17 : 7; odd > 1; odd -= 2) series = fma(series, z2, T(1.0 / odd));
    const auto near_one = abs(off) < T(0.25);
    const T logarithm = named("log_d", select(near_one, T(2.0) * fma(series * z2, z, z), log(d)));

    // b = sum B_j off^j and k = sum B_j (j + 1)/(j + 2) (1 + m) off^j, B_j = binom(m, j + 1).
    constexpr int terms = is_double<T> ? 14 : 8;
    std::array<T, terms> binomial;
    binomial[0] = m;
    for (int j = 1; j < terms; ++j)
      binomial[j] = named("binomial", binomial[j - 1] * (m - T(static_cast<double>(j))) * T(1.0 / (j + 1.0)));
    T b_series = binomial[terms - 1], k_series = T(terms / (terms + 1.0)) * binomial[terms - 1];
    for (int j = terms - 2; j >= 0; --j) {
      b_series = fma(b_series, off, binomial[j]);
      k_series = fma(k_series, off, T((j + 1.0) / (j + 2.0)) * binomial[j]);
    }
    const auto close = abs(off) < T(is_double<T> ? 0.08 : 0.12);
    const T over = named("over", T(1.0) / select(close, T(1.0), off));
    const T power = named("power", exp(m * logarithm));
    const T b = named("b", select(close, b_series, expm1(m * logarithm) * over));
    const T k = named("k", select(close, (T(1.0) + m) * k_series, fma(m, power, -b) * over));
    const T rest = named("rest", select(close, T(1.0) - b, (d - power) * over));
    return {b, k, rest, named("difference", select(close, b - k, fma(b, d, -m * power) * over))};
  }
};

}  // namespace tyndall
