// Prints examples/media/cloud_c1.csv: how a cloud of water droplets scatters at 680, 550 and 440 nm, by Mie's theory
// averaged over Deirmendjian's cloud C1 (1969, table 1.2): n(r) = r^6 exp(-1.5 r), r in micrometres, mode 4 um.
//
//   g++ -std=c++20 -O2 scripts/cloud_table.cc -o /tmp/cloud_table && /tmp/cloud_table > examples/media/cloud_c1.csv
//
// Scattering of a sphere: Bohren and Huffman 1983, chapter 4, with the logarithmic derivative by downward recurrence
// (Wiscombe 1980 for how many terms). Refractive index: Daimon and Masumura 2007 (20 C), absorption of Hale and Querry
// 1973. To stderr: two figures of Wiscombe 1979 (m = 0.75, x = 10: Qsca 2.232265, g 0.896473; m = 1.33 - 1e-5i, x =
// 100: 2.096594, 0.868959), then the mean cosines of the three columns.
#include <cmath>
#include <complex>
#include <cstdio>
#include <numbers>
#include <vector>

namespace {

using Complex = std::complex<double>;
constexpr double pi = std::numbers::pi;

struct Sphere {
  std::vector<Complex> a, b;  // from n = 1
};

// m = n - ik in Wiscombe's convention; the sums below want n + ik.
Sphere mie(double x, Complex m) {
  const auto terms = static_cast<std::size_t>(x + 4.05 * std::cbrt(x) + 2.0);
  const Complex y = m * x;
  // Far enough above |y| for the start to be forgotten: 16 more terms leave 1e-5 at x = 100.
  const double most = std::max(static_cast<double>(terms), std::abs(y));
  const auto start = static_cast<std::size_t>(most + 12.0 * std::cbrt(most) + 16.0);
  std::vector<Complex> d(start + 1);  // psi'(y) / psi(y)
  for (std::size_t n = start; n > 0; --n) {
    const Complex k = static_cast<double>(n) / y;
    d[n - 1] = k - 1.0 / (d[n] + k);
  }
  Sphere out;
  double psi_before = std::cos(x), psi = std::sin(x), chi_before = -std::sin(x), chi = std::cos(x);
  for (std::size_t n = 1; n <= terms; ++n) {
    const double odd = 2.0 * static_cast<double>(n) - 1.0;
    const double psi_next = odd / x * psi - psi_before, chi_next = odd / x * chi - chi_before;
    const Complex xi(psi_next, -chi_next), xi_before(psi, -chi);
    const Complex p = d[n] / m + static_cast<double>(n) / x, q = m * d[n] + static_cast<double>(n) / x;
    out.a.push_back((p * psi_next - psi) / (p * xi - xi_before));
    out.b.push_back((q * psi_next - psi) / (q * xi - xi_before));
    psi_before = psi, psi = psi_next, chi_before = chi, chi = chi_next;
  }
  return out;
}

struct Efficiency {
  double scattering, mean_cosine;
};
Efficiency efficiency(const Sphere& s, double x) {
  double scattering = 0.0, asymmetry = 0.0;
  for (std::size_t i = 0; i < s.a.size(); ++i) {
    const double n = static_cast<double>(i + 1);
    scattering += (2.0 * n + 1.0) * (std::norm(s.a[i]) + std::norm(s.b[i]));
    asymmetry += (2.0 * n + 1.0) / (n * (n + 1.0)) * (s.a[i] * std::conj(s.b[i])).real();
    if (i + 1 < s.a.size()) {
      const Complex both = s.a[i] * std::conj(s.a[i + 1]) + s.b[i] * std::conj(s.b[i + 1]);
      asymmetry += n * (n + 2.0) / (n + 1.0) * both.real();
    }
  }
  return {2.0 / (x * x) * scattering, 2.0 * asymmetry / scattering};
}

// (|S1|^2 + |S2|^2) / 2 at an angle of cosine mu.
double intensity(const Sphere& s, double mu) {
  Complex s1, s2;
  double before = 0.0, now = 1.0;  // pi_(n-1), pi_n
  for (std::size_t i = 0; i < s.a.size(); ++i) {
    const double n = static_cast<double>(i + 1), tau = n * mu * now - (n + 1.0) * before;
    const double weight = (2.0 * n + 1.0) / (n * (n + 1.0));
    s1 += weight * (s.a[i] * now + s.b[i] * tau);
    s2 += weight * (s.a[i] * tau + s.b[i] * now);
    const double next = ((2.0 * n + 1.0) * mu * now - (n + 1.0) * before) / n;
    before = now, now = next;
  }
  return 0.5 * (std::norm(s1) + std::norm(s2));
}

double water_index(double micrometres) {
  constexpr double a[] = {.5684027565, .1726177391, .02086189578, .1130748688};
  constexpr double b[] = {.005101829712, .01821153936, .02620722293, 10.69792721};
  const double squared = micrometres * micrometres;
  double sum = 1.0;
  for (int i = 0; i < 4; ++i) sum += a[i] * squared / (squared - b[i]);
  return std::sqrt(sum);
}

}  // namespace

int main() {
  for (const auto& [x, m] : {std::pair{10.0, Complex(0.75, 0.0)}, std::pair{100.0, Complex(1.33, 1e-5)}}) {
    const Efficiency e = efficiency(mie(x, m), x);
    std::fprintf(stderr, "x = %g: Qsca %.6f, g %.6f\n", x, e.scattering, e.mean_cosine);
  }
  std::vector<double> angles;
  for (int i = 0; i < 10; ++i) angles.push_back(0.1 * i);
  for (int i = 0; i < 50; ++i) angles.push_back(std::round(100.0 * std::pow(10.0, i / 50.0)) / 100.0);
  for (int i = 10; i < 135; ++i) angles.push_back(i);
  for (int i = 0; i < 60; ++i) angles.push_back(135.0 + 0.5 * i);
  for (int i = 0; i < 75; ++i) angles.push_back(165.0 + 0.2 * i);
  angles.push_back(180.0);

  const double wavelengths[] = {0.68, 0.55, 0.44}, absorption[] = {2.5e-8, 2.0e-9, 1.1e-9};
  std::vector<double> columns[3];
  for (int c = 0; c < 3; ++c) {
    columns[c].assign(angles.size(), 0.0);
    const Complex m(water_index(wavelengths[c]), absorption[c]);
    const double wave_number = 2.0 * pi / wavelengths[c], last = wave_number * 25.0;
    double scattered = 0.0, forward = 0.0;
    for (double x = 0.1; x < last; x += 0.1) {  // trapezoids in r: both ends are all but 0
      const double r = x / wave_number, count = std::pow(r, 6.0) * std::exp(-1.5 * r);
      const Sphere sphere = mie(x, m);
      const Efficiency e = efficiency(sphere, x);
      scattered += count * e.scattering * r * r;
      forward += count * e.scattering * r * r * e.mean_cosine;
      for (std::size_t i = 0; i < angles.size(); ++i)
        columns[c][i] += count * intensity(sphere, std::cos(angles[i] * pi / 180.0));
    }
    // Integral over the sphere 1: int (|S1|^2 + |S2|^2)/2 dOmega = pi x^2 Qsca = pi (k r)^2 Qsca.
    for (double& x : columns[c]) x /= pi * wave_number * wave_number * scattered;
    std::fprintf(stderr, "%g um: n = %.5f, mean cosine %.5f\n", wavelengths[c], m.real(), forward / scattered);
  }
  std::printf("# Phase function [1/sr] of Deirmendjian's water cloud C1, made by scripts/cloud_table.cc\n");
  std::printf("angle, 680 nm, 550 nm, 440 nm\n");
  for (std::size_t i = 0; i < angles.size(); ++i)
    std::printf("%g, %.5g, %.5g, %.5g\n", angles[i], columns[0][i], columns[1][i], columns[2][i]);
}
