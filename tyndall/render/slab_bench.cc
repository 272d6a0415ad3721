// Paths per second through a homogeneous slab, on one thread, for each instruction set: grey, and
// chromatic, where a path is a walk for each of the three channels.
#include <benchmark/benchmark.h>

#include "tyndall/render/slab.h"

namespace tyndall {
namespace {

SlabRequest cloud(bool chromatic, InstructionSet set) {
  SlabRequest request;
  const Spectrum scattering = chromatic ? Spectrum{{4.0, 8.0, 16.0}} : Spectrum::grey(8.0);
  request.medium.species.push_back({"", scattering, scattering * 0.001, HenyeyGreenstein<double>{0.85}, {}});
  request.paths = 100000;
  request.threads = 1;
  request.instruction_set = set;
  return request;
}

void slab(benchmark::State& state, bool chromatic, InstructionSet set) {
  const SlabRequest request = cloud(chromatic, set);
  for (auto _ : state) benchmark::DoNotOptimize(solve_slab(request));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(request.paths));
}

const bool registered = [] {
  for (const bool chromatic : {false, true}) {
    for (const InstructionSet set : {InstructionSet::baseline, InstructionSet::avx2, InstructionSet::avx512}) {
      if (set > best_instruction_set()) continue;
      const std::string name = "slab/" + std::string(chromatic ? "chromatic/" : "grey/") + std::string(name_of(set));
      benchmark::RegisterBenchmark(name.c_str(), slab, chromatic, set)->Unit(benchmark::kMillisecond);
    }
  }
  return true;
}();

}  // namespace
}  // namespace tyndall
