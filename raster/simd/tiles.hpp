// The farthest depths of tiles while triangles are filled. Included once by the
// file of each instruction set.
#pragma once

#include "raster/fill_triangle.hpp"
#include "raster/simd/row_depth.hpp"
#include "raster/simd/vector.hpp"

namespace triptych {
namespace {

constexpr int32_t tile = tile_side;

uint32_t least_of_tile(const uint32_t* depths, int32_t stride) {
  using Row [[gnu::vector_size(tile * 4)]] = uint32_t;  // positive floats are ordered as their bits are
  Row least;
  __builtin_memcpy(&least, depths, sizeof least);
  for (int32_t y = 1; y < tile; ++y) {
    Row row;
    __builtin_memcpy(&row, depths + int64_t{y} * stride, sizeof row);
    least = row < least ? row : least;
  }
  uint32_t result = least[0];
  for (int32_t x = 1; x < tile; ++x) result = least[x] < result ? least[x] : result;
  return result;
}

/// One row of tiles, and the rows of pixels in it that are filled.
struct TileRow {
  const FillTarget& target;
  int32_t index;
  int32_t bottom, top;  ///< pixels, inclusive

  float* tiles() const { return target.tiles + int64_t{index} * target.columns; }
  uint8_t* marked() const { return target.marked + int64_t{index} * target.columns; }

  /// Of so many tiles from the first on, at most `lanes`, those that do not
  /// hide the triangle: a bit each. Sums and products of floats are monotone in
  /// each operand: what they give at the outermost centres bounds, to the bit,
  /// what they give between. A limit only makes a triangle farther.
  [[gnu::always_inline]] uint32_t open(const FillTriangle& triangle, int32_t first, int32_t count) const {
    Floats nearest = splat(triangle.high);
    if (!triangle.precise) {
      const auto dy = static_cast<float>(centre(triangle.slope_y > 0 ? top : bottom) - triangle.first_y);
      const Ints column = (lane_numbers + first) * tile + (triangle.slope_x > 0 ? tile - 1 : 0);
      const Ints dx = column * 256 + (128 - triangle.first_x);
      nearest = clamped(triangle, (triangle.z + triangle.slope_y * dy) + triangle.slope_x * to_float(dx));
    }
    const auto not_behind = [&] {
      return bits((nearest >= (Floats)load(tiles() + first)) & (lane_numbers < count));
    };
    const uint32_t open = not_behind();
    bool refreshed = false;
    for (uint32_t rest = open; rest != 0; rest &= rest - 1) {
      const int32_t x = first + __builtin_ctz(rest);
      if (marked()[x]) refreshed |= refresh(x);
    }
    return refreshed ? not_behind() : open;
  }

  /// Tiles from first to last were drawn into.
  [[gnu::always_inline]] void mark(int32_t first, int32_t last) const {
    for (int32_t x = first; x <= last; ++x) marked()[x] = 1;
  }

 private:
  /// Only of tiles that lie within the picture.
  [[gnu::always_inline]] bool refresh(int32_t x) const {
    if (x * tile + tile > target.width || index * tile + tile > target.height) return false;
    const uint32_t least =
        least_of_tile(target.depths + int64_t{index} * tile * target.stride + x * tile, target.stride);
    __builtin_memcpy(tiles() + x, &least, sizeof least);
    marked()[x] = 0;
    return true;
  }
};

}  // namespace
}  // namespace triptych
