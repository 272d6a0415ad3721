#include "tyndall/render/slab.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "tyndall/medium/lowered_medium.h"
#include "tyndall/render/parallel.h"
#include "tyndall/render/slab_kernel.h"
#include "tyndall/render/slab_layered.h"

namespace tyndall {
namespace {

constexpr std::uint32_t block_paths = 8192;

/// One channel of a homogeneous slab in the numbers of the kernel.
struct SlabChannel {
  std::vector<SlabLobe> lobes;
  float albedo = 0.0f, depth = 0.0f;
};

SlabChannel channel_of(const LoweredMedium& medium, double thickness, std::size_t c) {
  SlabChannel out;
  double extinction = 0.0, scattering = 0.0;
  for (const LoweredSpecies& s : medium.species) extinction += s.extinction[c], scattering += s.scattering[c];
  if (!(extinction > 0.0)) return out;
  out.albedo = static_cast<float>(scattering / extinction);
  out.depth = static_cast<float>(thickness * extinction);
  for (const LoweredSpecies& s : medium.species) {
    for (std::size_t i = 0; i < s.lobe_count; ++i) {
      const WeightedLobe<double>& part = medium.lobes[s.first_lobe + i];
      const float share = static_cast<float>(s.scattering[c] * part.weight / scattering);
      if (share > 0.0f) out.lobes.push_back({lobe_record(part), share});
    }
  }
  return out;
}

bool alike(const LoweredMedium& medium, std::size_t a, std::size_t b) {
  return std::all_of(medium.species.begin(), medium.species.end(), [&](const LoweredSpecies& s) {
    return s.scattering[a] == s.scattering[b] && s.absorption[a] == s.absorption[b];
  });
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

struct MeanAndError {
  double mean, standard_error;
};

/// Paths of a replicate: a power of two that leaves at least 128 replicates to tell the error by, where paths suffice.
std::uint32_t replicate_size(std::uint32_t paths) {
  return std::bit_floor(std::clamp(paths / 128, std::uint32_t{1}, largest_slab_replicate));
}

/// Adds up the replicates of all blocks. trace(first path, path count, paths of a replicate, sums) adds each path's
/// tallies to those of its replicate.
template <class Trace>
std::vector<MeanAndError> replicated(const SlabRequest& request, std::size_t tallies, const Trace& trace) {
  struct Moments {
    double sum = 0.0, of_squares = 0.0, by_size = 0.0;  // of the replicates' sums S: S, S^2, n S
  };
  const std::uint32_t each = replicate_size(request.paths);
  const std::size_t blocks = (std::size_t{request.paths} + block_paths - 1) / block_paths;
  std::vector<std::vector<Moments>> found(blocks);
  std::vector<double> sizes(blocks);
  for_each_block(blocks, thread_count(request.threads), [&](std::size_t block, int) {
    const auto first = static_cast<std::uint32_t>(block * block_paths);
    const std::uint32_t count = std::min(block_paths, request.paths - first);
    std::vector<double> sums((count + each - 1) / each * tallies);
    trace(first, count, each, sums.data());
    found[block].resize(tallies);
    for (std::uint32_t begin = 0; begin < count; begin += each) {
      const double n = std::min(each, count - begin);
      sizes[block] += n * n;
      for (std::size_t i = 0; i < tallies; ++i) {
        const double s = sums[begin / each * tallies + i];
        found[block][i].sum += s;
        found[block][i].of_squares += s * s;
        found[block][i].by_size += n * s;
      }
    }
  });
  // Blocks are added in their order, so that the bits do not depend on the threads.
  std::vector<Moments> total(tallies);
  double size = 0.0;
  for (std::size_t block = 0; block < blocks; ++block) {
    size += sizes[block];
    for (std::size_t i = 0; i < tallies; ++i) {
      total[i].sum += found[block][i].sum;
      total[i].of_squares += found[block][i].of_squares;
      total[i].by_size += found[block][i].by_size;
    }
  }
  // The variance of sum S / N is sum (S - n mean)^2 / (N^2 - sum n^2): replicates are independent, and the last may be
  // shorter than the others.
  const double paths = request.paths;
  std::vector<MeanAndError> out;
  for (const Moments& m : total) {
    const double mean = m.sum / paths;
    const double squares = m.of_squares - 2.0 * mean * m.by_size + mean * mean * size;
    const double rest = paths * paths - size;
    out.push_back({mean, rest > 0.0 ? std::sqrt(std::max(0.0, squares) / rest) : infinity});
  }
  return out;
}

}  // namespace

std::optional<Objection> slab_objection(const SlabRequest& request) {
  const LoweredMedium medium = lower(request.medium);
  for (const LoweredSpecies& s : medium.species) {
    if (!s.is_layered()) {
      return Objection{"medium", "a species in a box, a sphere or noise",
                       "species that vary with height only: a slab is flat"};
    }
    if ((s.heights.bounded() || !s.form.empty()) && std::isinf(request.thickness)) {
      return Objection{"thickness", "inf for a medium that ends at some height", "a thickness in metres"};
    }
    if (s.decay != 0.0 && std::isinf(request.thickness)) {
      return Objection{"thickness", "inf for a medium that thickens without end downward", "a thickness in metres"};
    }
  }
  if (std::isinf(request.thickness)) {
    if (request.ground > 0.0) {
      return Objection{"ground", "the ground of a slab that never ends", "no ground, or a thickness in metres"};
    }
    Spectrum scattering, absorption;
    for (const LoweredSpecies& s : medium.species) scattering += s.scattering, absorption += s.absorption;
    for (std::size_t c = 0; c < channel_count; ++c) {
      if (scattering[c] > 0.0 && absorption[c] == 0.0) {
        return Objection{"thickness", "inf for a medium that absorbs nothing, whose light would go on without end",
                         "a thickness in metres, or a medium with some absorption"};
      }
    }
  }
  return std::nullopt;
}

SlabResult solve_slab(const SlabRequest& request) {
  const LoweredMedium medium = lower(request.medium);
  const std::size_t groups = 2 + 2 * request.mu.size();
  std::vector<Estimate> estimates(groups);
  if (same_everywhere(medium)) {
    const std::vector<float> mu(request.mu.begin(), request.mu.end());
    const SlabKernel kernel = choose_kernel<SlabKernel>(request.instruction_set, slab_baseline, slab_avx2, slab_avx512);
    for (std::size_t c = 0; c < channel_count; ++c) {
      std::size_t same = 0;
      while (same < c && !alike(medium, same, c)) ++same;
      if (same < c) {
        for (Estimate& e : estimates) e.mean[c] = e.mean[same], e.standard_error[c] = e.standard_error[same];
        continue;
      }
      const SlabChannel channel = channel_of(medium, request.thickness, c);
      const auto found = replicated(request, groups, [&](auto first, auto count, auto each, double* sums) {
        const SlabTask task{channel.lobes.data(),
                            static_cast<int>(channel.lobes.size()),
                            channel.albedo,
                            channel.depth,
                            request.diffuse ? 0.0f : static_cast<float>(request.mu0),
                            static_cast<float>(request.ground),
                            mu.data(),
                            static_cast<int>(mu.size()),
                            request.seed,
                            first,
                            count,
                            each};
        kernel(&task, sums);
      });
      for (std::size_t i = 0; i < groups; ++i) {
        estimates[i].mean[c] = found[i].mean;
        estimates[i].standard_error[c] = found[i].standard_error;
      }
    }
  } else {
    const auto found = replicated(request, layered_tally_count(request.mu.size()),
                                  [&](auto first, auto count, auto each, double* sums) {
                                    trace_layered_slab(request, medium, first, count, each, sums);
                                  });
    for (std::size_t i = 0; i < found.size(); ++i) {
      estimates[i / channel_count].mean[i % channel_count] = found[i].mean;
      estimates[i / channel_count].standard_error[i % channel_count] = found[i].standard_error;
    }
  }
  SlabResult result{estimates[0], estimates[1], direct(request, medium), {}, {}};
  for (std::size_t m = 0; m < request.mu.size(); ++m) {
    result.reflection.push_back(estimates[2 + 2 * m]);
    result.transmission.push_back(estimates[3 + 2 * m]);
  }
  return result;
}

}  // namespace tyndall
