// The farthest depth of each tile of a picture: what is behind it is hidden in the whole tile.
#pragma once

#include "raster/fill_triangle.hpp"
#include "raster/pixel_plane.hpp"
#include "raster/simd/kernels.hpp"

#include <cstdint>
#include <vector>

namespace triptych {

/// Two levels: tiles of 8 × 8 pixels, and blocks of 8 × 8 tiles. Depths are reversed, so that the farthest is
/// the least; 0 where a pixel holds nothing. Pixels beyond the picture count nowhere.
///
/// Depths of a frame only grow, so a tile that is behind the times holds too little: it hides less than it
/// might, and never more. After Greene, Kass and Miller, *Hierarchical Z-buffer visibility* (1993).
class DepthTiles {
 public:
  static constexpr int tile = tile_side, block = block_side, tiles_of_block = block / tile;

  DepthTiles(int width, int height);

  /// Nothing is drawn.
  void clear();
  // Threads may work at different rows of tiles.
  /// Rows of pixels, inclusive, in which something is going to be drawn.
  void touch_rows(int bottom, int top);
  /// Pixels, all inclusive, in which something may have been drawn; their rows are touched.
  void mark(int left, int right, int bottom, int top);
  /// Looks at the marked tiles of some rows of pixels again; last: the picture's last one, or the last of a
  /// row of tiles. depths: the bits of positive floats.
  void refresh_rows(const PixelPlane& depths, int first, int last);
  /// Looks at the blocks again whose rows were touched: by one thread, when the rows are refreshed.
  void refresh_blocks();
  /// For kernels, which mark and refresh by themselves.
  void hand_out(FillTarget& target);
  void hand_out(DepthSource& source) const;

  float farthest(int tile_x, int tile_y) const { return tiles_[at(tile_x, tile_y)]; }
  float farthest_of_block(int block_x, int block_y) const {
    return blocks_[static_cast<size_t>(block_y) * static_cast<size_t>(block_columns_) +
                   static_cast<size_t>(block_x)];
  }

 private:
  size_t at(int tile_x, int tile_y) const {
    return static_cast<size_t>(tile_y) * static_cast<size_t>(columns_) + static_cast<size_t>(tile_x);
  }
  void refresh_row(const PixelPlane& depths, int tile_y);
  void refresh_row_of_blocks(int block_y);

  int width_, height_;
  int columns_, rows_;  ///< of tiles
  int block_columns_, block_rows_;
  /// Some more of them than there are: kernels read whole vectors.
  std::vector<float> tiles_;
  std::vector<float> blocks_;
  std::vector<uint8_t> marked_;         ///< of each tile
  std::vector<uint8_t> row_touched_;    ///< of each row of tiles: not refreshed since
  std::vector<uint8_t> block_touched_;  ///< of each row of blocks
};

}  // namespace triptych
