#pragma once
// The blocks that a picture is made in.
#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "tyndall/render/film.h"
#include "tyndall/sampling/random_stream.h"

namespace tyndall {

inline constexpr int tile_size = 16;  // pixels a side, at most

struct Tile {
  int x0, y0, x1, y1;
  int pixel_count() const { return (x1 - x0) * (y1 - y0); }
};

/// Calls visit(x, y) for the pixels of a tile, row by row.
template <class Visit>
void for_each_pixel(const Tile& tile, Visit visit) {
  for (int y = tile.y0; y < tile.y1; ++y)
    for (int x = tile.x0; x < tile.x1; ++x) visit(x, y);
}

/// All tiles of a film; order 0: by rows, otherwise shuffled by this number.
inline std::vector<Tile> tiles_of(int width, int height, std::uint32_t order) {
  std::vector<Tile> tiles;
  for (int y = 0; y < height; y += tile_size) {
    for (int x = 0; x < width; x += tile_size)
      tiles.push_back({x, y, std::min(x + tile_size, width), std::min(y + tile_size, height)});
  }
  if (order != 0) {
    RandomStream random(order, 0, 0);
    for (std::size_t i = tiles.size(); i > 1; --i)
      std::swap(tiles[i - 1], tiles[static_cast<std::size_t>(random.next() * static_cast<double>(i))]);
  }
  return tiles;
}

}  // namespace tyndall
