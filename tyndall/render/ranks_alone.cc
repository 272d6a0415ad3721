// Ranks where the program was built without MPI: there are none.
#include "tyndall/document/fault.h"
#include "tyndall/render/ranks.h"

namespace tyndall {

struct Ranks::State {};

Ranks::Ranks() {
  throw Fault("mpirun", "a program that was built without MPI", "one that was built where libopenmpi-dev is installed");
}
Ranks::~Ranks() = default;
void Ranks::leave() {}
int Ranks::rank() const { return 0; }
int Ranks::size() const { return 1; }
std::string Ranks::first_text(const std::string& own) { return own; }
int Ranks::least(int own) { return own; }
TileHelpers& Ranks::helpers() { throw Fault("mpirun", "no MPI", "a build with it"); }
void Ranks::dismiss() {}
void Ranks::serve(const Scene&, const Geometry&, const RenderSettings&) {}

}  // namespace tyndall
