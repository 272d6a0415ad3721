#include "tyndall/phase/phase_kernels.h"

#include <cassert>

namespace tyndall {
namespace {

struct Parameters {
  LobeRecord& record;
  void operator()(const IsotropicLobe<float>&) const {}
  void operator()(const RayleighLobe<float>& lobe) const { record.parameters[0] = lobe.gamma; }
  void operator()(const HenyeyGreensteinLobe<float>& lobe) const {
    record.parameters[0] = lobe.g;
    record.parameters[1] = lobe.complement;
  }
  void operator()(const PowerLobe<float>& lobe) const { record.parameters[0] = static_cast<float>(lobe.n); }
};

}  // namespace

std::vector<LobeRecord> lobe_records(const LobeSum<float>& lobes) {
  std::vector<LobeRecord> out;
  for (const auto& part : lobes) {
    LobeRecord record{static_cast<int>(part.lobe.index()), part.weight, {}};
    std::visit(Parameters{record}, part.lobe);
    out.push_back(record);
  }
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
