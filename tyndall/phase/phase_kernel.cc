// Densities, cumulative distributions and samples of a sum of lobes, a register of floats at a time. Compiled once per
// instruction set (cmake/kernels.cmake).
#include "tyndall/phase/phase_kernel.h"

#include "tyndall/number/lanes.h"
#include "tyndall/phase/mie_hazy.h"
#include "tyndall/phase/mie_murky.h"
#include "tyndall/phase/nishita_murky.h"
#include "tyndall/phase/sum_inverse.h"

namespace tyndall {
namespace TYNDALL_KERNEL_NAMESPACE {

constexpr std::size_t width = Lanes::size;

// The hazy and murky laws have an inverse of their own, many times quicker than the general one.
template <template <class> class L>
bool is_law_of(const PhaseKernelCall& call) {
  const LobeSum<float> lobes = L<float>{}.lower();
  if (call.lobe_count != static_cast<int>(lobes.size())) return false;
  for (std::size_t k = 0; k < lobes.size(); ++k) {
    const LobeRecord own = lobe_record(lobes[k]), &given = call.lobes[k];
    if (given.kind != own.kind || given.weight != own.weight || given.parameters[0] != own.parameters[0]) return false;
  }
  return true;
}

// Calls block(first, lanes) for each full register and once more for what is left over.
template <class Block>
void for_blocks(std::size_t count, Block block) {
  std::size_t i = 0;
  for (; i + width <= count; i += width) block(i, width);
  if (i < count) block(i, count - i);
}

Lanes load(const float* from, std::size_t first, std::size_t lanes) {
  if (lanes == width) return Lanes::load_unaligned(from + first);
  alignas(64) float padded[width];
  for (std::size_t i = 0; i < width; ++i) padded[i] = from[first + (i < lanes ? i : 0)];
  return Lanes::load_aligned(padded);
}

void store(const Lanes& x, float* to, std::size_t first, std::size_t lanes) {
  if (lanes == width) {
    x.store_unaligned(to + first);
    return;
  }
  alignas(64) float padded[width];
  x.store_aligned(padded);
  for (std::size_t i = 0; i < lanes; ++i) to[first + i] = padded[i];
}

// One pass over the arrays for each lobe, so that what belongs to the lobe is computed once.
template <class Evaluate>
void add_up(const PhaseKernelCall& call, Evaluate evaluate) {
  for (int k = 0; k < call.lobe_count; ++k) {
    const Lanes weight(call.lobes[k].weight);
    std::visit(
        [&](const auto& lobe) {
          for_blocks(call.count, [&](std::size_t first, std::size_t lanes) {
            const Deflection<Lanes> d{load(call.mu, first, lanes), load(call.one_minus, first, lanes),
                                      load(call.one_plus, first, lanes)};
            const Lanes term = weight * evaluate(lobe, d);
            store(k == 0 ? term : load(call.value, first, lanes) + term, call.value, first, lanes);
          });
        },
        lobe_of<Lanes>(call.lobes[k]));
  }
}

template <class Inverse>
void sample_all(const PhaseKernelCall& call, Inverse inverse) {
  for_blocks(call.count, [&](std::size_t first, std::size_t lanes) {
    const Deflection<Lanes> d = inverse(load(call.xi, first, lanes));
    store(d.mu, call.sampled_mu, first, lanes);
    store(d.one_minus, call.sampled_one_minus, first, lanes);
    store(d.one_plus, call.sampled_one_plus, first, lanes);
  });
}

void sample_lobes(const PhaseKernelCall& call) {
  if (call.lobe_count == 1) {
    std::visit([&](const auto& lobe) { sample_all(call, [&](const Lanes& xi) { return lobe.sample(xi); }); },
               lobe_of<Lanes>(call.lobes[0]));
  } else if (is_law_of<MieHazy>(call)) {
    sample_all(call, [](const Lanes& xi) { return MieHazy<Lanes>{}.sample(xi); });
  } else if (is_law_of<MieMurky>(call)) {
    sample_all(call, [](const Lanes& xi) { return MieMurky<Lanes>{}.sample(xi); });
  } else if (is_law_of<NishitaMurky>(call)) {
    sample_all(call, [](const Lanes& xi) { return NishitaMurky<Lanes>{}.sample(xi); });
  } else {
    LobeSum<Lanes> lobes;
    for (int k = 0; k < call.lobe_count; ++k)
      lobes.push_back({Lanes(call.lobes[k].weight), lobe_of<Lanes>(call.lobes[k])});
    sample_all(call, [&](const Lanes& xi) { return sample(lobes, xi); });
  }
}

void run(const PhaseKernelCall& call) {
  switch (call.task) {
    case PhaseTask::density:
      add_up(call, [](const auto& lobe, const Deflection<Lanes>& d) { return lobe.density(d); });
      break;
    case PhaseTask::cdf:
      add_up(call, [](const auto& lobe, const Deflection<Lanes>& d) { return lobe.cdf(d); });
      break;
    case PhaseTask::sample:
      sample_lobes(call);
      break;
  }
}

}  // namespace TYNDALL_KERNEL_NAMESPACE

extern "C" void TYNDALL_KERNEL_ENTRY(const PhaseKernelCall* call) { TYNDALL_KERNEL_NAMESPACE::run(*call); }

}  // namespace tyndall
