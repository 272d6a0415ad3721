#pragma once
// A file of voxels that a description names (OpenVDB). A kind of member beside numbers and files of numbers; what reads
// files (floor 5) fills it in.
#include <cstdint>
#include <memory>
#include <string>

namespace tyndall {

struct BrickGrid;

/// A file by the name that was written, with one of its grids as it was when it was read. Copies share the grid. The
/// name may stand for a sequence of files (document/grid_sequence.h), of which one was read.
struct GridFile {
  std::string name;
  std::string path;  // where it was found, absolute
  std::shared_ptr<const BrickGrid> grid;
  std::uint64_t content = 0;  // digest of the grid; 0: not known
  std::string naming = "";    // of a sequence: the file that names it ...
  bool anywhere = false;      // ... and whether it may lie outside of that one's folder
  int number = 0;             // which was read

  /// The same voxels, wherever they came from.
  bool operator==(const GridFile& other) const {
    return grid == other.grid || (grid && other.grid && content != 0 && content == other.content);
  }
};

}  // namespace tyndall
