#include "tyndall/phase/phase_kernels.h"

#include <cassert>

namespace tyndall {
std::vector<LobeRecord> lobe_records(const LobeSum<float>& lobes) {
  std::vector<LobeRecord> out;
  for (const auto& part : lobes) out.push_back(lobe_record(part));
  return out;
}

PhaseArrays::PhaseArrays(const LobeSum<float>& lobes, InstructionSet set)
    : lobes_(lobe_records(lobes)),
      run_(choose_kernel<PhaseKernelFunction>(set, phase_kernel_baseline, phase_kernel_avx2, phase_kernel_avx512)) {
  assert(!lobes.empty());
}

void PhaseArrays::density(const DeflectionArrays& at, std::span<float> out) const {
  assert(at.mu.size() == out.size() && at.one_minus.size() == out.size() && at.one_plus.size() == out.size());
  PhaseKernelCall call{};
  call.task = PhaseTask::density;
  call.lobes = lobes_.data();
  call.lobe_count = static_cast<int>(lobes_.size());
  call.count = out.size();
  call.mu = at.mu.data();
  call.one_minus = at.one_minus.data();
  call.one_plus = at.one_plus.data();
  call.value = out.data();
  run_(&call);
}

void PhaseArrays::cdf(const DeflectionArrays& at, std::span<float> out) const {
  assert(at.mu.size() == out.size() && at.one_minus.size() == out.size() && at.one_plus.size() == out.size());
  PhaseKernelCall call{};
  call.task = PhaseTask::cdf;
  call.lobes = lobes_.data();
  call.lobe_count = static_cast<int>(lobes_.size());
  call.count = out.size();
  call.mu = at.mu.data();
  call.one_minus = at.one_minus.data();
  call.one_plus = at.one_plus.data();
  call.value = out.data();
  run_(&call);
}

void PhaseArrays::sample(std::span<const float> xi, const DeflectionResults& out) const {
  assert(out.mu.size() == xi.size() && out.one_minus.size() == xi.size() && out.one_plus.size() == xi.size());
  PhaseKernelCall call{};
  call.task = PhaseTask::sample;
  call.lobes = lobes_.data();
  call.lobe_count = static_cast<int>(lobes_.size());
  call.count = xi.size();
  call.xi = xi.data();
  call.sampled_mu = out.mu.data();
  call.sampled_one_minus = out.one_minus.data();
  call.sampled_one_plus = out.one_plus.data();
  run_(&call);
}

}  // namespace tyndall
