#pragma once
// A medium is a sum of species; this is what every dial compiles to and every outlet reads.
#include <string>
#include <vector>

#include "tyndall/color/spectrum.h"
#include "tyndall/medium/profile.h"
#include "tyndall/phase/law.h"

namespace tyndall {

/// One kind of particle: coefficients [1/m] per channel (>= 0) where its profile is 1, an angular law (tables may
/// differ by channel, see lowered_medium.h), and its place. The density is multiplied by every profile of the list: an
/// exponential haze inside a box is {exponential, box}; no profile is constant.
struct Species {
  std::string name;
  Spectrum scattering, absorption;
  Law<double> phase = Isotropic<double>{};
  std::vector<Profile> profiles;

  Spectrum extinction() const { return scattering + absorption; }
};

/// Species add without displacing each other, so media add by joining their lists.
struct Medium {
  std::vector<Species> species;
};

/// Product of the species' profiles at a point [m] and time [s].
inline double factor(const Species& species, const Vector& p, double time = 0.0) {
  double product = 1.0;
  for (const Profile& profile : species.profiles) product *= factor(profile, p, time);
  return product;
}
/// The same with noise at its mean of 1.
inline double mean_factor(const Species& species, const Vector& p) {
  double product = 1.0;
  for (const Profile& profile : species.profiles) product *= mean_factor(profile, p);
  return product;
}

/// Sums over the species at a point [1/m], noise at its mean.
inline Spectrum scattering_at(const Medium& medium, const Vector& p) {
  Spectrum total;
  for (const Species& s : medium.species) total += s.scattering * mean_factor(s, p);
  return total;
}
inline Spectrum absorption_at(const Medium& medium, const Vector& p) {
  Spectrum total;
  for (const Species& s : medium.species) total += s.absorption * mean_factor(s, p);
  return total;
}

/// Mean cosine of a law in each channel.
inline Spectrum mean_cosines(const Law<double>& law) {
  Spectrum out;
  const auto lobes = lower_channels(law);
  for (std::size_t c = 0; c < channel_count; ++c) out[c] = mean_cosine(lobes[c]);
  return out;
}

/// Mean cosine of the mixture per channel at a point, weighted by scattering; NaN where nothing scatters.
inline Spectrum mean_cosine_at(const Medium& medium, const Vector& p) {
  Spectrum weighted_sum;
  for (const Species& s : medium.species) weighted_sum += s.scattering * mean_cosines(s.phase) * mean_factor(s, p);
  return weighted_sum / scattering_at(medium, p);
}

/// Distance at which contrast has fallen to `contrast` (0.05: meteorological optical range; 0.02: Koschmieder) [m].
inline double visibility_of(double extinction, double contrast = 0.05) { return -std::log(contrast) / extinction; }

}  // namespace tyndall
