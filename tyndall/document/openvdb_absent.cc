#include "tyndall/document/fault.h"
#include "tyndall/document/openvdb_grid.h"

namespace tyndall {

BrickGrid openvdb_grid(const std::filesystem::path& file, const std::string&) {
  throw Fault{place(file.string()), "a grid, which this program is built without",
              "a program built with OpenVDB (Debian: libopenvdb-dev and libboost-dev)"};
}

}  // namespace tyndall
