#include "raster/depth_tiles.hpp"

#include "base/threads.hpp"

#include <algorithm>
#include <bit>
#include <limits>

namespace triptych {

namespace {

int divide_up(int a, int b) { return (a + b - 1) / b; }

uint32_t depth_bits(uint32_t word) { return word; }
uint32_t depth_bits(uint64_t word) { return static_cast<uint32_t>(word >> 32); }

/// Positive floats are ordered as their bits are. `whole`: a tile's width, known to the compiler.
template <int whole, typename Word>
uint32_t least_bits(const Word* words, size_t stride, int width, int height) {
  uint32_t least = std::numeric_limits<uint32_t>::max();
  for (int y = 0; y < height; ++y, words += stride) {
    for (int x = 0; x < (whole > 0 ? whole : width); ++x) least = std::min(least, depth_bits(words[x]));
  }
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
      tiles_(static_cast<size_t>(columns_) * static_cast<size_t>(rows_)),
      blocks_(static_cast<size_t>(block_columns_) * static_cast<size_t>(block_rows_)),
      marked_(tiles_.size()),
      row_marked_(static_cast<size_t>(rows_)) {}

void DepthTiles::clear() {
  std::fill(tiles_.begin(), tiles_.end(), 0.0f);
  std::fill(blocks_.begin(), blocks_.end(), 0.0f);
  std::fill(marked_.begin(), marked_.end(), uint8_t{0});
  std::fill(row_marked_.begin(), row_marked_.end(), uint8_t{0});
}

void DepthTiles::mark(int left, int right, int bottom, int top) {
  const int first = left / tile, last = right / tile;
  for (int y = bottom / tile; y <= top / tile; ++y) {
    row_marked_[static_cast<size_t>(y)] = 1;
    uint8_t* const row = marked_.data() + at(0, y);
    std::fill(row + first, row + last + 1, uint8_t{1});
  }
}

template <typename Word>
bool DepthTiles::refresh_row(std::span<const Word> words, int tile_y) {
  uint8_t& marked = row_marked_[static_cast<size_t>(tile_y)];
  if (!marked) return false;
  marked = 0;
  const auto stride = static_cast<size_t>(width_);
  const int height = std::min(tile, height_ - tile_y * tile);
  const Word* const row = words.data() + static_cast<size_t>(tile_y) * tile * stride;
  for (int x = 0; x < columns_; ++x) {
    if (!marked_[at(x, tile_y)]) continue;
    marked_[at(x, tile_y)] = 0;
    const int width = std::min(tile, width_ - x * tile);
    const uint32_t bits = width == tile ? least_bits<tile>(row + x * tile, stride, tile, height)
                                        : least_bits<0>(row + x * tile, stride, width, height);
    tiles_[at(x, tile_y)] = std::bit_cast<float>(bits);
  }
  return true;
}

void DepthTiles::refresh_blocks(int block_y) {
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

template <typename Word>
void DepthTiles::refresh(std::span<const Word> words) {
  const auto refresh_row_of_blocks = [&](size_t i) {
    const int block_y = static_cast<int>(i), first = block_y * tiles_of_block;
    bool changed = false;
    for (int y = first; y < std::min(first + tiles_of_block, rows_); ++y) changed |= refresh_row(words, y);
    if (changed) refresh_blocks(block_y);
  };
  // Waking other threads takes longer than a small picture.
  constexpr size_t worth_sharing = size_t{1} << 20;
  if (words.size() >= worth_sharing) {
    parallel_for(static_cast<size_t>(block_rows_), refresh_row_of_blocks);
  } else {
    for (int i = 0; i < block_rows_; ++i) refresh_row_of_blocks(static_cast<size_t>(i));
  }
}

template void DepthTiles::refresh(std::span<const uint32_t>);
template void DepthTiles::refresh(std::span<const uint64_t>);

}  // namespace triptych
