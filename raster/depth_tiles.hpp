// The farthest depth of each tile of a picture: what is behind it is hidden in the whole tile.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace triptych {

/// Two levels: tiles of 8 × 8 pixels, and blocks of 8 × 8 tiles. Depths are reversed, so that the farthest is
/// the least; 0 where a pixel holds nothing. Pixels beyond the picture count nowhere.
///
/// Depths of a frame only grow, so a tile that is behind the times holds too little: it hides less than it
/// might, and never more. After Greene, Kass and Miller, *Hierarchical Z-buffer visibility* (1993).
class DepthTiles {
 public:
  static constexpr int tile = 8, tiles_of_block = 8, block = tile * tiles_of_block;

  DepthTiles(int width, int height);

  /// Nothing is drawn.
  void clear();
  /// Pixels, all inclusive, in which something may have been drawn. Threads may mark different rows of tiles.
  void mark(int left, int right, int bottom, int top);
  /// Looks at the marked tiles again. words: one a pixel, rows from bottom to top, with the bits of a
  /// positive float in their upper 32 bits (uint64_t), or no more than these (uint32_t).
  template <typename Word>
  void refresh(std::span<const Word> words);

  float farthest(int tile_x, int tile_y) const { return tiles_[at(tile_x, tile_y)]; }
  float farthest_of_block(int block_x, int block_y) const {
    return blocks_[static_cast<size_t>(block_y) * static_cast<size_t>(block_columns_) +
                   static_cast<size_t>(block_x)];
  }

 private:
  size_t at(int tile_x, int tile_y) const {
    return static_cast<size_t>(tile_y) * static_cast<size_t>(columns_) + static_cast<size_t>(tile_x);
  }
  template <typename Word>
  bool refresh_row(std::span<const Word> words, int tile_y);
  void refresh_blocks(int block_y);

  int width_, height_;
  int columns_, rows_;  ///< of tiles
  int block_columns_, block_rows_;
  std::vector<float> tiles_, blocks_;
  std::vector<uint8_t> marked_;      ///< of each tile
  std::vector<uint8_t> row_marked_;  ///< of each row of tiles
};

extern template void DepthTiles::refresh(std::span<const uint32_t>);
extern template void DepthTiles::refresh(std::span<const uint64_t>);

}  // namespace triptych
