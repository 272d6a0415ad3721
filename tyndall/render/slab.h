#pragma once
// Light through a plane-parallel slab: reflectance, transmittance and exit radiance, all orders of scattering.
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tyndall/medium/medium.h"
#include "tyndall/number/instruction_set.h"

namespace tyndall {

/// A slab 0 <= y <= thickness of `medium`, black outside (or a Lambertian ground of albedo `ground` below), no
/// refraction. Light enters the top: a beam whose cosine to the normal is mu0 in (0, 1], or diffuse (isotropic radiance
/// over the upper hemisphere).
struct SlabRequest {
  Medium medium;           // profiles may vary with height only
  double thickness = 1.0;  // [m] > 0, or infinity
  bool diffuse = false;
  double mu0 = 1.0;
  double ground = 0.0;     // [0, 1]
  std::vector<double> mu;  // exit cosines (0, 1] at which radiance is wanted
  std::uint32_t paths = 1000000;
  std::uint64_t seed = 1;
  int threads = 0;  // 0: all
  InstructionSet instruction_set = best_instruction_set();
};

/// A mean over paths and its standard error, per channel. Paths are spread evenly in replicates that are independent of
/// each other (at least 128 of them above 128 paths); the error is told by how much those differ, infinite if there is
/// but one.
struct Estimate {
  Spectrum mean, standard_error;
};

/// Fractions of the flux on the face. reflection and transmission are azimuth-averaged and diffuse only: exit radiance
/// is I = R mu0 E / pi for the irradiance E of a surface facing the beam (van de Hulst 1980).
struct SlabResult {
  Estimate reflectance, transmittance_diffuse;
  Spectrum transmittance_direct;
  std::vector<Estimate> reflection, transmission;
};

/// What is wrong with a request, with the name of its member; none when it can be computed.
std::optional<Objection> slab_objection(const SlabRequest& request);

/// Monte Carlo over request.paths paths; where density does not vary with height, over as many for each channel that
/// differs from the others, so that a channel's numbers are bit by bit those of the grey slab of its coefficients. The
/// same request gives the same bits for any number of threads; across instruction sets the statistics agree, last bits
/// may differ. The request must have no objection.
SlabResult solve_slab(const SlabRequest& request);

}  // namespace tyndall
