#pragma once
// The processes that make a picture together.
#include <functional>
#include <optional>
#include <string>

#include "tyndall/number/instruction_set.h"
#include "tyndall/render/ranks.h"

namespace tyndall {

/// This process and those that mpirun started with it; by itself where there are none.
class Company {
 public:
  Company();

  /// The one that tells people things and writes files.
  bool chief() const { return !ranks_ || ranks_->rank() == 0; }
  /// The others, for RenderHooks: null where there are none. Chief only, once per render.
  TileHelpers* helpers() { return ranks_ ? &ranks_->helpers() : nullptr; }
  /// Chief, after each render.
  void dismiss();
  /// Those who are not chief: computes until dismissed. Deaf to Ctrl-C, which is the chief's to heed.
  void serve(const Scene& scene, const Geometry& geometry, const RenderSettings& settings);

  /// The least instruction set of all processors. The chief warns where they differ: the picture's last bits then
  /// depend on who computed what.
  InstructionSet common_instruction_set(bool quiet);

  /// Every process takes the same step. Where one of them fails, all end together: alone by what was thrown, in company
  /// with the message of the first and exit code 2.
  void together(const std::function<void()>& step);
  /// Ends all, as together(), where `text` is not the same in all processes.
  void agree_on(const std::string& text, const std::string& what);
  /// Nothing is left to do with the others. A process that ends otherwise ends them all.
  void leave();

 private:
  std::optional<Ranks> ranks_;
};

}  // namespace tyndall
