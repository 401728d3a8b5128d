#include "raster/depth_tiles.hpp"

#include "raster/instruction_set.hpp"

#include <algorithm>
#include <bit>
#include <limits>

namespace triptych {

namespace {

int divide_up(int a, int b) { return (a + b - 1) / b; }

/// What vectors may read beyond the last tile.
constexpr size_t spare = 16;

/// Positive floats are ordered as their bits are.
uint32_t least_bits(const uint32_t* depths, size_t stride, int width, int height) {
  uint32_t least = std::numeric_limits<uint32_t>::max();
  for (int y = 0; y < height; ++y, depths += stride)
    least = std::min(least, *std::min_element(depths, depths + width));
  return least;
}

}  // namespace

DepthTiles::DepthTiles(int width, int height)
    : width_(width),
      height_(height),
      columns_(divide_up(width, tile)),
      rows_(divide_up(height, tile)),
      block_columns_(divide_up(columns_, tiles_of_block)),
      block_rows_(divide_up(rows_, tiles_of_block)),
      tiles_(static_cast<size_t>(columns_) * static_cast<size_t>(rows_) + spare),
      blocks_(static_cast<size_t>(block_columns_) * static_cast<size_t>(block_rows_)),
      marked_(tiles_.size()),
      row_touched_(static_cast<size_t>(rows_)),
      block_touched_(static_cast<size_t>(block_rows_)) {}

void DepthTiles::clear() {
  std::fill(tiles_.begin(), tiles_.end(), 0.0f);
  std::fill(blocks_.begin(), blocks_.end(), 0.0f);
  std::fill(marked_.begin(), marked_.end(), uint8_t{0});
  std::fill(row_touched_.begin(), row_touched_.end(), uint8_t{0});
  std::fill(block_touched_.begin(), block_touched_.end(), uint8_t{0});
}

void DepthTiles::touch_rows(int bottom, int top) {
  std::fill(row_touched_.begin() + bottom / tile, row_touched_.begin() + top / tile + 1, uint8_t{1});
  std::fill(block_touched_.begin() + bottom / block, block_touched_.begin() + top / block + 1, uint8_t{1});
}

void DepthTiles::mark(int left, int right, int bottom, int top) {
  const int first = left / tile, last = right / tile;
  for (int y = bottom / tile; y <= top / tile; ++y) {
    uint8_t* const row = marked_.data() + at(0, y);
    std::fill(row + first, row + last + 1, uint8_t{1});
  }
}

void DepthTiles::hand_out(FillTarget& target) {
  target.tiles = tiles_.data();
  target.marked = marked_.data();
  target.columns = columns_;
}

void DepthTiles::hand_out(DepthSource& source) const {
  source.tiles = tiles_.data();
  source.columns = columns_;
  source.blocks = blocks_.data();
  source.block_columns = block_columns_;
}

void DepthTiles::refresh_row(const PixelPlane& depths, int tile_y) {
  uint8_t& touched = row_touched_[static_cast<size_t>(tile_y)];
  if (!touched) return;
  touched = 0;
  const RasterKernels* const kernels = raster_kernels(instruction_set());
  const int height = std::min(tile, height_ - tile_y * tile);
  const uint32_t* const row = depths.row(tile_y * tile).data();
  for (int x = 0; x < columns_; ++x) {
    if (!marked_[at(x, tile_y)]) continue;
    marked_[at(x, tile_y)] = 0;
    const int width = std::min(tile, width_ - x * tile);
    const bool whole = width == tile && height == tile && kernels != nullptr;
    const uint32_t bits =
        whole ? kernels->least_of_tile(row + x * tile, depths.stride())
              : least_bits(row + x * tile, static_cast<size_t>(depths.stride()), width, height);
    tiles_[at(x, tile_y)] = std::bit_cast<float>(bits);
  }
}

void DepthTiles::refresh_row_of_blocks(int block_y) {
  const int first = block_y * tiles_of_block, end = std::min(first + tiles_of_block, rows_);
  float* const blocks = blocks_.data() + static_cast<size_t>(block_y) * static_cast<size_t>(block_columns_);
  std::fill(blocks, blocks + block_columns_, std::numeric_limits<float>::infinity());
  for (int y = first; y < end; ++y) {
    for (int x = 0; x < columns_; ++x) {
      float& least = blocks[x / tiles_of_block];
      least = std::min(least, farthest(x, y));
    }
  }
}

void DepthTiles::refresh_rows(const PixelPlane& depths, int first, int last) {
  for (int y = first / tile; y <= last / tile; ++y) refresh_row(depths, y);
}

void DepthTiles::refresh_blocks() {
  for (int y = 0; y < block_rows_; ++y) {
    uint8_t& touched = block_touched_[static_cast<size_t>(y)];
    if (touched) refresh_row_of_blocks(y);
    touched = 0;
  }
}

}  // namespace triptych
