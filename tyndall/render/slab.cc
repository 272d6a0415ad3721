#include "tyndall/render/slab.h"

#include <algorithm>
#include <cmath>

#include "tyndall/medium/lowered_medium.h"
#include "tyndall/render/parallel.h"
#include "tyndall/render/slab_kernel.h"
#include "tyndall/render/slab_layered.h"

namespace tyndall {
namespace {

constexpr std::uint32_t block_paths = 8192;

SlabLobe slab_lobe(const WeightedLobe<double>& part, const Spectrum& scattering) {
  SlabLobe out{lobe_record(part), {}};
  for (std::size_t c = 0; c < channel_count; ++c) out.scattering[c] = static_cast<float>(scattering[c] * part.weight);
  return out;
}

bool all_channels_alike(const Medium& medium) {
  const auto alike = [](const Spectrum& x) { return x == Spectrum::grey(x[0]); };
  return std::all_of(medium.species.begin(), medium.species.end(),
                     [&](const Species& s) { return alike(s.scattering) && alike(s.absorption); });
}

bool same_everywhere(const LoweredMedium& medium) {
  return std::all_of(medium.species.begin(), medium.species.end(),
                     [](const LoweredSpecies& s) { return s.is_constant(); });
}

/// Transmittance of the unscattered light; for diffuse light 2 int_0^1 T(mu) mu dmu by the midpoint rule in u = mu^2,
/// which the factor e^(-tau/mu) makes smooth at 0.
Spectrum direct(const SlabRequest& request, const LoweredMedium& medium) {
  if (std::isinf(request.thickness)) return {};
  std::vector<Stretch> stretches;
  const auto along = [&](double mu) {
    const Ray ray{{0.0, request.thickness, 0.0}, {std::sqrt((1.0 - mu) * (1.0 + mu)), -mu, 0.0}};
    return transmittance(medium, ray, request.thickness / mu, stretches);
  };
  if (!request.diffuse) return along(request.mu0);
  constexpr int nodes = 20000;
  Spectrum total;
  for (int i = 0; i < nodes; ++i) total += along(std::sqrt((i + 0.5) / nodes));
  return total / static_cast<double>(nodes);
}

Estimate estimate(const std::vector<double>& sum, const std::vector<double>& squares, std::size_t at, int channels,
                  double paths) {
  Estimate e;
  for (std::size_t c = 0; c < channel_count; ++c) {
    const std::size_t i = at + (channels == 1 ? 0 : c);
    e.mean[c] = sum[i] / paths;
    const double variance = std::max(0.0, squares[i] / paths - e.mean[c] * e.mean[c]);
    e.standard_error[c] = std::sqrt(variance / std::max(1.0, paths - 1.0));
  }
  return e;
}

}  // namespace

std::string slab_objection(const SlabRequest& request) {
  const LoweredMedium medium = lower(request.medium);
  for (const LoweredSpecies& s : medium.species) {
    if (!s.is_layered()) return "a slab's medium may vary with height only, not in boxes, spheres or noise";
    if ((s.heights.bounded() || !s.form.empty()) && std::isinf(request.thickness)) {
      return "a medium that ends at some height has no infinite slab: give a thickness";
    }
    if (s.decay != 0.0 && std::isinf(request.thickness)) {
      return "a medium that thickens without end downward has no infinite slab: give a thickness";
    }
  }
  if (std::isinf(request.thickness)) {
    if (request.ground > 0.0) return "an infinite slab has no ground";
    Spectrum scattering, absorption;
    for (const LoweredSpecies& s : medium.species) scattering += s.scattering, absorption += s.absorption;
    for (std::size_t c = 0; c < channel_count; ++c) {
      if (scattering[c] > 0.0 && absorption[c] == 0.0) {
        return "an infinite slab that absorbs nothing reflects everything, after paths without end: give a thickness, "
               "or some absorption";
      }
    }
  }
  return {};
}

SlabResult solve_slab(const SlabRequest& request) {
  const LoweredMedium medium = lower(request.medium);
  const bool homogeneous = same_everywhere(medium);
  const int channels = homogeneous && all_channels_alike(request.medium) ? 1 : static_cast<int>(channel_count);
  const int mu_count = static_cast<int>(request.mu.size());
  const std::size_t tallies = slab_tally_count(channels, mu_count);
  const std::size_t blocks = (request.paths + block_paths - 1) / block_paths;
  std::vector<std::vector<double>> sums(blocks, std::vector<double>(tallies)), squares = sums;

  std::vector<SlabLobe> lobes;
  Spectrum extinction, scattering;
  for (const LoweredSpecies& s : medium.species) {
    extinction += s.extinction;
    scattering += s.scattering;
    for (std::size_t i = 0; i < s.lobe_count; ++i)
      lobes.push_back(slab_lobe(medium.lobes[s.first_lobe + i], s.scattering));
  }
  // Depth is counted in mean free paths of the thickest channel, whatever the units of the medium.
  const double unit = largest(extinction) > 0.0 ? largest(extinction) : 1.0;
  for (SlabLobe& lobe : lobes) {
    for (float& x : lobe.scattering) x = static_cast<float>(x / unit);
  }
  const std::vector<float> mu(request.mu.begin(), request.mu.end());
  const SlabKernel kernel = choose_kernel<SlabKernel>(request.instruction_set, slab_baseline, slab_avx2, slab_avx512);

  for_each_block(blocks, thread_count(request.threads), [&](std::size_t block, int) {
    const auto first = static_cast<std::uint32_t>(block * block_paths);
    const std::uint32_t count = std::min(block_paths, request.paths - first);
    if (!homogeneous) {
      trace_layered_slab(request, medium, first, count, sums[block], squares[block]);
      return;
    }
    SlabTask task{channels,
                  lobes.data(),
                  static_cast<int>(lobes.size()),
                  {},
                  {},
                  static_cast<float>(request.thickness * unit),
                  request.diffuse ? 0.0f : static_cast<float>(request.mu0),
                  static_cast<float>(request.ground),
                  mu.data(),
                  mu_count,
                  request.seed,
                  first,
                  count};
    for (std::size_t c = 0; c < channel_count; ++c) {
      task.extinction[c] = static_cast<float>(extinction[c] / unit);
      task.scattering[c] = static_cast<float>(scattering[c] / unit);
    }
    kernel(&task, sums[block].data(), squares[block].data());
  });

  // Blocks are added in their order, so that the bits do not depend on the threads.
  std::vector<double> sum(tallies), square(tallies);
  for (std::size_t block = 0; block < blocks; ++block) {
    for (std::size_t i = 0; i < tallies; ++i) sum[i] += sums[block][i], square[i] += squares[block][i];
  }
  const auto at = [&](std::size_t group) {
    return estimate(sum, square, group * static_cast<std::size_t>(channels), channels, request.paths);
  };
  SlabResult result{at(0), at(1), direct(request, medium), {}, {}};
  for (std::size_t m = 0; m < request.mu.size(); ++m) {
    result.reflection.push_back(at(2 + 2 * m));
    result.transmission.push_back(at(3 + 2 * m));
  }
  return result;
}

}  // namespace tyndall
