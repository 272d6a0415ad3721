#pragma once
// Laws over arrays, as many at a time as the processor has lanes: one kernel per instruction set, chosen at run time.
#include <optional>
#include <span>
#include <vector>

#include "tyndall/number/instruction_set.h"
#include "tyndall/phase/lobe_sum.h"
#include "tyndall/phase/phase_kernel.h"

namespace tyndall {

/// Deflections as three arrays of equal length.
struct DeflectionArrays {
  std::span<const float> mu, one_minus, one_plus;
};
struct DeflectionResults {
  std::span<float> mu, one_minus, one_plus;
};

/// A sum of lobes ready for the kernels. Float results are those of the same text in float, to a few roundings; they
/// differ between instruction sets in the last digits.
class PhaseArrays {
 public:
  /// `lobes` is not empty. Takes some milliseconds where sampling needs a search (Draine's, Fournier and Forand's lobe,
  /// sums of lobes), for which it is prepared. `set` must be one that this machine can run (best_instruction_set() and
  /// below).
  explicit PhaseArrays(const LobeSum<float>& lobes, InstructionSet set = best_instruction_set());

  /// Phase function at each deflection [1/sr]; all arrays of equal length.
  void density(const DeflectionArrays& at, std::span<float> out) const;
  /// Probability that mu is at most that of each deflection.
  void cdf(const DeflectionArrays& at, std::span<float> out) const;
  /// The deflection of each xi; xi is 0 or from 1e-12 to 1.
  void sample(std::span<const float> xi, const DeflectionResults& out) const;

 private:
  PhaseKernelCall call(PhaseTask task, std::size_t count) const;
  void value(PhaseTask task, const DeflectionArrays& at, std::span<float> out) const;

  LobeSum<float> kept_;  // owns the tables that the records refer to
  std::optional<QuantileStart> start_;
  std::vector<LobeRecord> lobes_;
  PhaseKernelFunction run_;
};

/// What speeds up the sampling of a sum of lobes; none where there is a closed form or nothing would be gained.
std::optional<QuantileStart> quantile_start(const LobeSum<float>& lobes);

/// The sum as plain numbers. Tables stay those of `lobes`, which must outlive the records.
std::vector<LobeRecord> lobe_records(const LobeSum<float>& lobes);

}  // namespace tyndall
