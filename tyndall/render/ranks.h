#pragma once
// One picture by several processes on one or more machines, started together by mpirun.
#include <cstdlib>
#include <memory>
#include <string>

#include "tyndall/render/render.h"
#include "tyndall/render/sampler.h"
#include "tyndall/render/tile.h"

namespace tyndall {

/// Whether this process was started by mpirun (or srun), so that there may be others.
inline bool started_with_others() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "PMIX_RANK"})
    if (std::getenv(name) != nullptr) return true;
  return false;
}

/// The processes of one mpirun. Rank 0 has the film and everything a person sees; the others take tiles from it, as
/// fast as each is, and give them back. A pixel's samples stay in their order, so the picture is that of one process.
/// When a process dies, mpirun ends them all; a checkpoint of rank 0 lacks at most what was under way.
class Ranks {
 public:
  /// Joins the others. At most one in a process. Throws Fault where this program was built without MPI.
  Ranks();
  /// Ends all processes, unless leave() was called.
  ~Ranks();
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  int rank() const;
  int size() const;

  /// From here on this rank needs nothing of the others and they nothing of it: it waits at the end until all are
  /// there.
  void leave();

  /// Every rank calls it with its own text; all get that of the lowest rank that has one, "" where none has.
  std::string first_text(const std::string& own);

  /// Every rank calls it; all get the least of their numbers.
  int least(int own);

  /// Rank 0, once: others' share of a render, for RenderHooks. They must be about to serve().
  TileHelpers& helpers();
  /// Rank 0, after render(): lets the others go.
  void dismiss();
  /// The other ranks: takes tiles until dismissed.
  void serve(const Scene& scene, const Geometry& geometry, const RenderSettings& settings);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace tyndall
