#include "tyndall/document/openvdb_grid.h"

#include <openvdb/openvdb.h>

#include <cmath>
#include <exception>
#include <limits>
#include <new>
#include <string_view>
#include <vector>

#include "tyndall/document/fault.h"
#include "tyndall/document/grid_reader.h"
#include "tyndall/document/spelling.h"

namespace tyndall {
namespace {

/// The numbers of a tree that are not 0, leaf by leaf and tile by tile, active or not: the voxels from `low` to `high`,
/// both included, have that value.
template <class Tree, class Visit>
void for_each_value(const Tree& tree, Visit&& visit) {
  for (auto at = tree.cbeginValueAll(); at; ++at) {
    const auto x = static_cast<double>(*at);
    if (x == 0.0) continue;
    openvdb::CoordBBox box;
    at.getBoundingBox(box);
    visit(BrickGrid::Index{box.min().x(), box.min().y(), box.min().z()},
          BrickGrid::Index{box.max().x(), box.max().y(), box.max().z()}, x);
  }
}

class GridReader {
 public:
  explicit GridReader(std::string where) : where_(std::move(where)) {}

  template <class Grid>
  BrickGrid read(const Grid& grid) const {
    check_number(static_cast<double>(grid.background()));
    if (grid.background() != 0) {
      throw fault("a grid whose background is not 0, so that it has no end", "a background of 0");
    }
    constexpr int most = std::numeric_limits<int>::max(), least = std::numeric_limits<int>::min();
    BrickGrid::Index low{most, most, most}, high{least, least, least};
    double greatest = 0.0, voxels = 0.0;
    for_each_value(grid.tree(), [&](const BrickGrid::Index& from, const BrickGrid::Index& to, double x) {
      check_number(x);
      greatest = std::max(greatest, x);
      double here = 1.0;
      for (std::size_t a = 0; a < 3; ++a) {
        low[a] = std::min(low[a], from[a]);
        high[a] = std::max(high[a], to[a]);
        here *= static_cast<double>(to[a]) - static_cast<double>(from[a]) + 1.0;
      }
      voxels += here;
    });
    if (!(greatest > 0.0)) return {};
    check_extent(low, high, voxels);
    BrickGridMaker maker(low, high, greatest);
    for_each_value(grid.tree(), [&](const BrickGrid::Index& from, const BrickGrid::Index& to, double x) {
      for (int k = from[2]; k <= to[2]; ++k) {
        for (int j = from[1]; j <= to[1]; ++j) {
          for (int i = from[0]; i <= to[0]; ++i) maker.set({i, j, k}, x);
        }
      }
      if (maker.blocks() * BrickGrid::size * sizeof(std::uint16_t) > most_grid_bytes) throw too_large();
    });
    const openvdb::math::Transform& transform = grid.transform();
    const auto stands = [&](double i, double j, double k) {
      const openvdb::Vec3d p = transform.indexToWorld(openvdb::Vec3d(i, j, k));
      return Vector{p.x(), p.y(), p.z()};
    };
    const Vector origin = stands(0, 0, 0), x = stands(1, 0, 0) - origin, y = stands(0, 1, 0) - origin,
                 z = stands(0, 0, 1) - origin;
    const double volume = dot(x, cross(y, z));
    if (!is_finite(origin) || !std::isfinite(volume) || !(std::fabs(volume) > 0.0)) {
      throw fault("a transform that gives voxels no volume", "one that can be undone");
    }
    return maker.finish(origin, x, y, z);
  }

  Fault fault(std::string found, std::string expected) const { return {where_, std::move(found), std::move(expected)}; }

 private:
  void check_number(double x) const {
    if (!std::isfinite(x)) throw fault("a voxel that is not finite", "finite numbers");
    if (x < 0.0) throw fault("a voxel below 0", "a density of at least 0");
  }

  Fault too_large() const {
    return fault("a grid too large", "at most " + std::to_string(most_grid_bytes >> 20) + " MB of voxels, " +
                                         std::to_string(most_grid_voxels_along) + " along each axis");
  }

  void check_extent(const BrickGrid::Index& low, const BrickGrid::Index& high, double voxels) const {
    double bricks = 1.0;
    for (std::size_t a = 0; a < 3; ++a) {
      const double along = static_cast<double>(high[a]) - static_cast<double>(low[a]) + 1.0;
      if (along > most_grid_voxels_along || std::abs(static_cast<double>(low[a])) > 1e9) throw too_large();
      bricks *= along / BrickGrid::edge + 2.0;
    }
    const double bytes = voxels * sizeof(std::uint16_t) + bricks * 3 * sizeof(std::uint32_t);
    if (bytes > static_cast<double>(most_grid_bytes)) throw too_large();
  }

  std::string where_;
};

/// The one grid that is meant.
std::string chosen(openvdb::io::File& file, const std::string& name, const GridReader& reader) {
  std::vector<std::string> names;
  for (auto at = file.beginName(); at != file.endName(); ++at) names.push_back(at.gridName());
  if (names.empty()) throw reader.fault("no grids", "one");
  if (name.empty()) {
    if (names.size() == 1) return names.front();
    throw reader.fault("several grids, of which none is named",
                       "a \"name\": " + one_of("", {names.begin(), names.end()}));
  }
  if (std::ranges::find(names, name) != names.end()) return name;
  throw reader.fault("no grid " + in_quotes(name), one_of(name, {names.begin(), names.end()}));
}

BrickGrid grid_of(const std::filesystem::path& path, const std::string& name, const GridReader& reader) {
  openvdb::initialize();
  openvdb::io::File file(path.string());
  file.setCopyMaxBytes(0);
  file.open(false);  // all at once, not as voxels are asked for
  const std::string grid_name = chosen(file, name, reader);
  const openvdb::GridBase::ConstPtr head = file.readGridMetadata(grid_name);
  if (head->getGridClass() == openvdb::GRID_LEVEL_SET) {
    throw reader.fault("a level set, which says where a surface is", "a fog volume");
  }
  const bool is_float = head->isType<openvdb::FloatGrid>(), is_double = head->isType<openvdb::DoubleGrid>();
  if (!is_float && !is_double) {
    throw reader.fault("a grid of another kind than numbers (" + printable(head->valueType(), 40) + ")",
                       "a grid of float, half or double");
  }
  if (!head->transform().isLinear()) throw reader.fault("a grid with a bent transform", "an affine one");
  const openvdb::GridBase::Ptr grid = file.readGrid(grid_name);
  if (is_float) return reader.read(*openvdb::gridConstPtrCast<openvdb::FloatGrid>(grid));
  return reader.read(*openvdb::gridConstPtrCast<openvdb::DoubleGrid>(grid));
}

}  // namespace

BrickGrid openvdb_grid(const std::filesystem::path& file, const std::string& name) {
  const GridReader reader(place(file.string()));
  try {
    return grid_of(file, name, reader);
  } catch (const Fault&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception&) {  // its text may quote the file
    throw reader.fault("a file that OpenVDB cannot read", "an OpenVDB file (.vdb)");
  }
}

}  // namespace tyndall
