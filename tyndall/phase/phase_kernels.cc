#include "tyndall/phase/phase_kernels.h"

#include <cassert>

namespace tyndall {
std::vector<LobeRecord> lobe_records(const LobeSum<float>& lobes) {
  std::vector<LobeRecord> out;
  for (const auto& part : lobes) out.push_back(lobe_record(part));
  return out;
}

std::optional<QuantileStart> quantile_start(const LobeSum<float>& lobes) {
  if (lobes.size() == 1) {
    const Lobe<float>& only = lobes.front().lobe;
    const bool searched =
        std::holds_alternative<DraineLobe<float>>(only) || std::holds_alternative<FournierForandLobe<float>>(only);
    if (!searched) return std::nullopt;
  }
  for (const auto& part : lobes) {
    // A law with kinks: the curve between two knots of ours knows nothing of them.
    if (std::holds_alternative<TableLobe<float>>(part.lobe)) return std::nullopt;
  }
  return QuantileStart::of(lobes_as<double>(lobes));
}

PhaseArrays::PhaseArrays(const LobeSum<float>& lobes, InstructionSet set)
    : kept_(lobes),
      start_(quantile_start(kept_)),
      lobes_(lobe_records(kept_)),
      run_(choose_kernel<PhaseKernelFunction>(set, phase_kernel_baseline, phase_kernel_avx2, phase_kernel_avx512)) {
  assert(!lobes.empty());
}

PhaseKernelCall PhaseArrays::call(PhaseTask task, std::size_t count) const {
  PhaseKernelCall call{};
  call.task = task;
  call.lobes = lobes_.data();
  call.lobe_count = static_cast<int>(lobes_.size());
  call.count = count;
  return call;
}

void PhaseArrays::value(PhaseTask task, const DeflectionArrays& at, std::span<float> out) const {
  assert(at.mu.size() == out.size() && at.one_minus.size() == out.size() && at.one_plus.size() == out.size());
  PhaseKernelCall values = call(task, out.size());
  values.mu = at.mu.data();
  values.one_minus = at.one_minus.data();
  values.one_plus = at.one_plus.data();
  values.value = out.data();
  run_(&values);
}

void PhaseArrays::density(const DeflectionArrays& at, std::span<float> out) const {
  value(PhaseTask::density, at, out);
}

void PhaseArrays::cdf(const DeflectionArrays& at, std::span<float> out) const { value(PhaseTask::cdf, at, out); }

void PhaseArrays::sample(std::span<const float> xi, const DeflectionResults& out) const {
  assert(out.mu.size() == xi.size() && out.one_minus.size() == xi.size() && out.one_plus.size() == xi.size());
  PhaseKernelCall samples = call(PhaseTask::sample, xi.size());
  samples.xi = xi.data();
  samples.start = start_ ? &*start_ : nullptr;
  samples.sampled_mu = out.mu.data();
  samples.sampled_one_minus = out.one_minus.data();
  samples.sampled_one_plus = out.one_plus.data();
  run_(&samples);
}

}  // namespace tyndall
