#include "tyndall/document/grid_reader.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "tyndall/document/fault.h"
#include "tyndall/document/openvdb_grid.h"
#include "tyndall/document/rehearsal.h"

namespace tyndall {
namespace {

/// What comes before the lists.
struct Head {
  std::int32_t bricks[3];
  double unit, origin[3], step[3][3];
  std::uint64_t blocks;
};

void put(double (&out)[3], const Vector& v) { out[0] = v.x, out[1] = v.y, out[2] = v.z; }
Vector vector_of(const double (&in)[3]) { return {in[0], in[1], in[2]}; }

}  // namespace

std::uint64_t bytes_of(const BrickGrid& grid) {
  return grid.voxels.size() * sizeof(std::uint16_t) + grid.block.size() * (sizeof(std::uint32_t) + 2 * sizeof(float));
}

std::string grid_bytes(const BrickGrid& grid) {
  Head head{};
  for (std::size_t a = 0; a < 3; ++a) {
    head.bricks[a] = grid.bricks[a];
    put(head.step[a], grid.step[a]);
  }
  head.unit = grid.unit;
  put(head.origin, grid.origin);
  head.blocks = grid.blocks();
  std::string out;
  const auto append = [&](const void* from, std::size_t size) { out.append(static_cast<const char*>(from), size); };
  out.reserve(sizeof head + grid.block.size() * sizeof(std::uint32_t) + grid.voxels.size() * sizeof(std::uint16_t));
  append(&head, sizeof head);
  append(grid.block.data(), grid.block.size() * sizeof(std::uint32_t));
  append(grid.voxels.data(), grid.voxels.size() * sizeof(std::uint16_t));
  return out;
}

BrickGrid grid_of_bytes(std::string_view bytes, const std::string& where) {
  const auto check = [&](bool good) {
    if (!good) throw Fault{where, "a file whose reader made no grid of it", "an OpenVDB file"};
  };
  Head head{};
  check(bytes.size() >= sizeof head);
  std::memcpy(&head, bytes.data(), sizeof head);
  bytes.remove_prefix(sizeof head);
  BrickGrid grid;
  std::uint64_t count = 1;
  for (std::size_t a = 0; a < 3; ++a) {
    check(head.bricks[a] >= 0 && head.bricks[a] <= most_grid_voxels_along / BrickGrid::edge + 2);
    grid.bricks[a] = head.bricks[a];
    count *= static_cast<std::uint64_t>(head.bricks[a]);
    grid.step[a] = vector_of(head.step[a]);
    check(is_finite(grid.step[a]));
  }
  grid.unit = head.unit;
  grid.origin = vector_of(head.origin);
  check(std::isfinite(grid.unit) && grid.unit > 0.0 && is_finite(grid.origin));
  check(count <= bytes.size() / sizeof(std::uint32_t) && head.blocks <= count);
  check(bytes.size() == count * sizeof(std::uint32_t) + head.blocks * BrickGrid::size * sizeof(std::uint16_t));
  grid.block.resize(count);
  grid.voxels.resize(head.blocks * BrickGrid::size);
  const std::size_t first = count * sizeof(std::uint32_t);
  if (count > 0) std::memcpy(grid.block.data(), bytes.data(), first);
  if (head.blocks > 0) std::memcpy(grid.voxels.data(), bytes.data() + first, bytes.size() - first);
  for (const std::uint32_t block : grid.block) check(block == BrickGrid::empty || block < head.blocks);
  for (const std::uint16_t half : grid.voxels) check(is_plain_half(half));
  grid.find_bounds();
  return grid;
}

GridFile read_grid(const std::filesystem::path& file, const std::string& name) {
  const std::string where = place(file.string());
  // What voxels unpack to, and room for 512^3 of them made of tiles: a small file must not ask for much.
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(file, error), megabytes = error ? 0 : size >> 20;
  RehearsalLimits limits;
  limits.seconds = 4 + static_cast<unsigned>(std::min<std::uintmax_t>(megabytes, 300));
  limits.memory = std::min<std::uint64_t>(limits.memory, (std::uint64_t{3} << 29) + (std::uint64_t{megabytes} << 26));
  const std::string bytes = performed(
      where, "an OpenVDB file", [&] { return grid_bytes(openvdb_grid(file, name)); }, limits);
  return file_of(grid_of_bytes(bytes, where));
}

}  // namespace tyndall
