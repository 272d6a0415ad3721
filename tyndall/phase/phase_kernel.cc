// Densities, cumulative distributions and samples of a sum of lobes, a register of floats at a time. Compiled once per
// instruction set (cmake/kernels.cmake).
#include "tyndall/phase/phase_kernel.h"

#include <xmmintrin.h>

#include "tyndall/number/lane_pair.h"
#include "tyndall/phase/mie_hazy.h"
#include "tyndall/phase/mie_murky.h"
#include "tyndall/phase/nishita_murky.h"
#include "tyndall/phase/sum_inverse.h"

namespace tyndall {
namespace TYNDALL_KERNEL_NAMESPACE {

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

// Calls block(first, lanes, number) for each full pair of registers, then for each register, the last of them padded.
template <class Block>
void for_blocks(std::size_t count, Block block) {
  std::size_t i = 0;
  for (; i + LanePair::size <= count; i += LanePair::size) block(i, LanePair::size, std::type_identity<LanePair>{});
  for (; i < count; i += Lanes::size) block(i, std::min(Lanes::size, count - i), std::type_identity<Lanes>{});
}

Lanes load(const float* from, std::size_t first, std::size_t lanes, std::type_identity<Lanes>) {
  if (lanes == Lanes::size) return Lanes::load_unaligned(from + first);
  alignas(64) float padded[Lanes::size];
  for (std::size_t i = 0; i < Lanes::size; ++i) padded[i] = from[first + (i < lanes ? i : 0)];
  return Lanes::load_aligned(padded);
}
LanePair load(const float* from, std::size_t first, std::size_t, std::type_identity<LanePair>) {
  return {Lanes::load_unaligned(from + first), Lanes::load_unaligned(from + first + Lanes::size)};
}

void store(const Lanes& x, float* to, std::size_t first, std::size_t lanes) {
  if (lanes == Lanes::size) {
    x.store_unaligned(to + first);
    return;
  }
  alignas(64) float padded[Lanes::size];
  x.store_aligned(padded);
  for (std::size_t i = 0; i < lanes; ++i) to[first + i] = padded[i];
}
void store(const LanePair& x, float* to, std::size_t first, std::size_t) {
  x.a.store_unaligned(to + first);
  x.b.store_unaligned(to + first + Lanes::size);
}

// What is the same in all lanes, in pairs and in single registers.
template <template <class> class L>
struct BothWays {
  L<Lanes> single;
  L<LanePair> pair;
  const L<Lanes>& in(std::type_identity<Lanes>) const { return single; }
  const L<LanePair>& in(std::type_identity<LanePair>) const { return pair; }
};

// Calls visit(BothWays of the lobe that the record stands for).
template <class Visit>
void visit_lobe(const LobeRecord& record, Visit visit) {
  std::visit(
      [&]<template <class> class L>(const L<Lanes>& lobe) {
        visit(BothWays<L>{lobe, std::get<L<LanePair>>(lobe_of<LanePair>(record))});
      },
      lobe_of<Lanes>(record));
}

// One pass over the arrays for each lobe, so that what belongs to the lobe is computed once. Everything is inlined
// (flatten): a register that crosses a call goes through memory, and what belongs to the lobe would not leave the loop.
template <class Lobes, class Evaluate>
[[gnu::flatten]] void add_lobe(const PhaseKernelCall& call, int k, Lobes lobes, Evaluate evaluate) {
  const float share = call.lobes[k].weight;
  for_blocks(call.count, [&]<class T>(std::size_t first, std::size_t lanes, std::type_identity<T> number) {
    const Deflection<T> d{load(call.mu, first, lanes, number), load(call.one_minus, first, lanes, number),
                          load(call.one_plus, first, lanes, number)};
    const T term = T(share) * evaluate(lobes.in(number), d);
    store(k == 0 ? term : load(call.value, first, lanes, number) + term, call.value, first, lanes);
  });
}

template <class Evaluate>
void add_up(const PhaseKernelCall& call, Evaluate evaluate) {
  for (int k = 0; k < call.lobe_count; ++k)
    visit_lobe(call.lobes[k], [&](const auto& lobes) { add_lobe(call, k, lobes, evaluate); });
}

template <class Inverse>
[[gnu::flatten]] void sample_all(const PhaseKernelCall& call, Inverse inverse) {
  for_blocks(call.count, [&]<class T>(std::size_t first, std::size_t lanes, std::type_identity<T> number) {
    const Deflection<T> d = inverse(load(call.xi, first, lanes, number), number);
    store(d.mu, call.sampled_mu, first, lanes);
    store(d.one_minus, call.sampled_one_minus, first, lanes);
    store(d.one_plus, call.sampled_one_plus, first, lanes);
  });
}

template <template <class> class L>
void sample_law(const PhaseKernelCall& call) {
  sample_all(call, []<class T>(const T& xi, std::type_identity<T>) { return L<T>{}.sample(xi); });
}

void sample_lobes(const PhaseKernelCall& call) {
  if (call.lobe_count == 1) {
    visit_lobe(call.lobes[0], [&](const auto& lobes) {
      sample_all(call, [lobes](const auto& xi, auto number) { return lobes.in(number).sample(xi); });
    });
  } else if (is_law_of<MieHazy>(call)) {
    sample_law<MieHazy>(call);
  } else if (is_law_of<MieMurky>(call)) {
    sample_law<MieMurky>(call);
  } else if (is_law_of<NishitaMurky>(call)) {
    sample_law<NishitaMurky>(call);
  } else {
    LobeSum<Lanes> lobes;
    for (int k = 0; k < call.lobe_count; ++k)
      lobes.push_back({Lanes(call.lobes[k].weight), lobe_of<Lanes>(call.lobes[k])});
    LobeSum<LanePair> pairs;
    for (int k = 0; k < call.lobe_count; ++k)
      pairs.push_back({LanePair(call.lobes[k].weight), lobe_of<LanePair>(call.lobes[k])});
    sample_all(call, [&]<class T>(const T& xi, std::type_identity<T>) {
      if constexpr (std::is_same_v<T, Lanes>) {
        return sample(lobes, xi);
      } else {
        return sample(pairs, xi);
      }
    });
  }
}

void run(const PhaseKernelCall& call) {
  switch (call.task) {
    case PhaseTask::density:
      add_up(call, [](const auto& lobe, const auto& d) { return lobe.density(d); });
      break;
    case PhaseTask::cdf:
      add_up(call, [](const auto& lobe, const auto& d) { return lobe.cdf(d); });
      break;
    case PhaseTask::sample:
      sample_lobes(call);
      break;
  }
}

}  // namespace TYNDALL_KERNEL_NAMESPACE

extern "C" void TYNDALL_KERNEL_ENTRY(const PhaseKernelCall* call) {
  // What underflows becomes 0 at once (u^32 of backward directions): numbers below 1e-38 would cost hundreds of cycles.
  constexpr unsigned flush = 0x8040;
  const unsigned before = _mm_getcsr();
  _mm_setcsr(before | flush);
  TYNDALL_KERNEL_NAMESPACE::run(*call);
  _mm_setcsr(before);
}

}  // namespace tyndall
