// Densities, cumulative distributions and samples of a sum of lobes, a register of floats at a time. Compiled once per
// instruction set (cmake/kernels.cmake).
#include "tyndall/phase/phase_kernel.h"

#include <xmmintrin.h>

#include <algorithm>
#include <vector>

#include "tyndall/number/lane_table.h"
#include "tyndall/phase/mie_hazy.h"
#include "tyndall/phase/mie_murky.h"
#include "tyndall/phase/nishita_murky.h"
#include "tyndall/phase/quantile_start.h"
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

// The lobe in pairs, made where it is used, so that the compiler sees that both halves have the same parameters.
template <template <class> class L>
L<LanePair> in(const L<Lanes>& lobe, std::type_identity<LanePair>) {
  L<LanePair> pair;
  for_each_parameter(pair, lobe, []<class To, class From>(To& x, const From& y) { x = To(y); });
  return pair;
}
template <template <class> class L>
const L<Lanes>& in(const L<Lanes>& lobe, std::type_identity<Lanes>) {
  return lobe;
}

// One pass over the arrays for each lobe, so that what belongs to the lobe is computed once. Everything is inlined
// (flatten): a register that crosses a call goes through memory, and what belongs to the lobe would not leave the loop.
template <class L, class Evaluate>
[[gnu::flatten]] void add_lobe(const PhaseKernelCall& call, int k, L lobe, Evaluate evaluate) {
  const float share = call.lobes[k].weight;
  for_blocks(call.count, [&]<class T>(std::size_t first, std::size_t lanes, std::type_identity<T> number) {
    const Deflection<T> d{load(call.mu, first, lanes, number), load(call.one_minus, first, lanes, number),
                          load(call.one_plus, first, lanes, number)};
    const T term = T(share) * evaluate(in(lobe, number), d);
    store(k == 0 ? term : load(call.value, first, lanes, number) + term, call.value, first, lanes);
  });
}

template <class Evaluate>
void add_up(const PhaseKernelCall& call, Evaluate evaluate) {
  for (int k = 0; k < call.lobe_count; ++k)
    std::visit([&](const auto& lobe) { add_lobe(call, k, lobe, evaluate); }, lobe_of<Lanes>(call.lobes[k]));
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

// Quantiles of a sum of lobes from its table of starts (quantile_start.h), a block at a time: what the text for one
// number does at once is done here in passes, one for each lobe, so that what belongs to the lobe stays in registers.
class Search {
 public:
  explicit Search(const PhaseKernelCall& call) : call_(call), start_(*call.start) {
    for (int k = 0; k < call.lobe_count; ++k) lobes_.push_back(lobe_of<Lanes>(call.lobes[k]));
  }

  void run() {
    for (std::size_t first = 0; first < call_.count; first += size) {
      const std::size_t count = std::min(size, call_.count - first);
      full_ = (count + LanePair::size - 1) / LanePair::size * LanePair::size;
      xi_ = call_.xi + first;
      if (count < full_) {
        std::copy_n(xi_, count, padded_);
        std::fill(padded_ + count, padded_ + full_, 0.5F);
        xi_ = padded_;
      }
      begin();
      for (int taken = 1;; ++taken) {
        pass_lobes();
        if (taken == start_.steps) break;
        step();
      }
      if (count == full_) {
        finish(call_.sampled_mu + first, call_.sampled_one_minus + first, call_.sampled_one_plus + first);
        continue;
      }
      finish(s_, one_minus_, one_plus_);
      std::copy_n(s_, count, call_.sampled_mu + first);
      std::copy_n(one_minus_, count, call_.sampled_one_minus + first);
      std::copy_n(one_plus_, count, call_.sampled_one_plus + first);
    }
  }

 private:
  static constexpr std::size_t size = 512;
  static LanePair at(const float* from, std::size_t i) { return load(from, i, size, std::type_identity<LanePair>{}); }
  static void put(const LanePair& x, float* to, std::size_t i) { store(x, to, i, size); }
  Deflection<LanePair> deflection(std::size_t i) const {
    return Deflection<LanePair>::from_ends(at(one_minus_, i), at(one_plus_, i));
  }
  Passage<LanePair> passage(std::size_t i) const { return {at(below_, i), at(above_, i), at(density_, i)}; }
  void go_to(const LanePair& s, std::size_t i) {
    put(s, s_, i);
    const Deflection<LanePair> d = QuantileStart::at_log_odds(s);
    put(d.one_minus, one_minus_, i);
    put(d.one_plus, one_plus_, i);
  }

  // In three loops: the shorter a loop's body, the more of its turns a processor works on at the same time.
  [[gnu::flatten]] void begin() {
    for (std::size_t i = 0; i < full_; i += LanePair::size) {
      const LanePair xi = at(xi_, i);
      put(QuantileStart::key(xi, LanePair(1.0) - xi), s_, i);
    }
    const QuantileStart::Table<LanePair> table(start_.columns);
    for (std::size_t i = 0; i < full_; i += LanePair::size) {
      const auto place = QuantileStart::place(table, at(s_, i));
      put(place.s, s_, i);
      put(place.rise, rise_, i);
      put(place.bend, bend_, i);
    }
    for (std::size_t i = 0; i < full_; i += LanePair::size) go_to(at(s_, i), i);
  }
  void pass_lobes() {
    for (std::size_t k = 0; k < lobes_.size(); ++k)
      std::visit([&](const auto& lobe) { pass(lobe, LanePair(call_.lobes[k].weight), k == 0); }, lobes_[k]);
  }
  template <class L>
  [[gnu::flatten]] void pass(const L& given, const LanePair& weight, bool is_first) {
    const L single = given;  // ours alone: no store can change it
    const auto lobe = in(single, std::type_identity<LanePair>{});
    for (std::size_t i = 0; i < full_; i += LanePair::size) {
      const Deflection<LanePair> d = deflection(i);
      const auto add = [&](const LanePair& term, float* to) {
        put(is_first ? weight * term : fma(weight, term, at(to, i)), to, i);
      };
      const Passage<LanePair> passage = passage_of(lobe, d);
      add(passage.below, below_);
      add(passage.above, above_);
      add(passage.density, density_);
    }
  }
  [[gnu::flatten]] void step() {
    for (std::size_t i = 0; i < full_; i += LanePair::size) {
      const LanePair xi = at(xi_, i);
      go_to(at(s_, i) + QuantileStart::step(xi, LanePair(1.0) - xi, deflection(i), passage(i)), i);
    }
  }
  [[gnu::flatten]] void finish(float* mu, float* one_minus, float* one_plus) {
    for (std::size_t i = 0; i < full_; i += LanePair::size) {
      const LanePair xi = at(xi_, i);
      const QuantileStart::Place<LanePair> from{at(s_, i), at(rise_, i), at(bend_, i)};
      const Deflection<LanePair> d = QuantileStart::last(xi, LanePair(1.0) - xi, from, deflection(i), passage(i));
      put(d.mu, mu, i);
      put(d.one_minus, one_minus, i);
      put(d.one_plus, one_plus, i);
    }
  }

  const PhaseKernelCall& call_;
  const QuantileStart& start_;
  std::vector<Lobe<Lanes>> lobes_;
  std::size_t full_ = 0;
  const float* xi_ = nullptr;
  alignas(64) float padded_[size], s_[size], rise_[size], bend_[size],
      one_minus_[size], one_plus_[size], below_[size], above_[size], density_[size];
};

void sample_lobes(const PhaseKernelCall& call) {
  if (call.lobe_count == 1 && call.start == nullptr) {
    std::visit(
        [&](const auto& lobe) {
          sample_all(call, [lobe](const auto& xi, auto number) { return in(lobe, number).sample(xi); });
        },
        lobe_of<Lanes>(call.lobes[0]));
  } else if (is_law_of<MieHazy>(call)) {
    sample_law<MieHazy>(call);
  } else if (is_law_of<MieMurky>(call)) {
    sample_law<MieMurky>(call);
  } else if (is_law_of<NishitaMurky>(call)) {
    sample_law<NishitaMurky>(call);
  } else if (call.start != nullptr) {
    Search(call).run();
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
