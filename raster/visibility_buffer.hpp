// What is drawn in one frame, pixel by pixel: depth, and the triangle that it is of.
#pragma once

#include "raster/depth_tiles.hpp"
#include "raster/fill.hpp"
#include "raster/geometry_stage.hpp"

#include <optional>
#include <span>
#include <variant>
#include <vector>

namespace triptych {

/// Something to draw: a stretch of a chunk, placed.
struct PlacedStretch {
  DrawRank rank;
  uint32_t part = 0;  ///< counts the drawable's stretches
  const RasterChunk* chunk = nullptr;
  uint32_t first_triangle = 0, triangle_count = 0;
  PlacedLattice placed = {};
  std::span<const LatticeBox> pieces;
};

/// Reversed depth of width × height pixels, rows from bottom to top; besides, unless it keeps depth alone,
/// the slot of the triangle that shows. What it holds is a function of the set drawn: not of order, batches
/// or threads.
class VisibilityBuffer {
 public:
  VisibilityBuffer(int width, int height, bool depth_alone, uint64_t max_slots);

  void clear();
  /// Draws, with all threads; returns when all is drawn.
  void draw(const GeometryTerms& terms, std::span<const PlacedStretch> stretches);

  int width() const { return width_; }
  int height() const { return height_; }
  /// Of a pixel; 0 where nothing is.
  float depth(int x, int y) const;
  /// The pixels, row by row; those of the other kind are empty. A word has the depth's bits above.
  std::span<const uint32_t> depths() const { return depths_; }
  std::span<const VisibilityWord> words() const { return words_; }
  /// The farthest depths of tiles, of what is drawn so far.
  const DepthTiles& tiles() const { return tiles_; }
  /// Null where nothing is. Not of a buffer that keeps depth alone.
  std::optional<SlotTable::Triangle> triangle(int x, int y) const;
  /// The words of a row: equal slots are the same triangle; 0 where nothing is.
  std::span<const VisibilityWord> row(int y) const {
    return std::span(words_).subspan(index(0, y), static_cast<size_t>(width_));
  }
  SlotTable::Triangle find(uint32_t slot) const { return slots_.find(slot); }

 private:
  size_t index(int x, int y) const {
    return static_cast<size_t>(y) * static_cast<size_t>(width_) + static_cast<size_t>(x);
  }
  void number(const PlacedStretch& stretch, uint32_t first, uint32_t count);
  void draw_batch(const GeometryTerms& terms);
  void fill_rows(int32_t first, int32_t last);
  /// Kernels: null where they cannot be used.
  void fill_depths(const WindowTriangle& triangle, int32_t first, int32_t last, const RasterKernels* kernels);
  void fill_words(const WindowTriangle& triangle, int32_t first, int32_t last, const RasterKernels* kernels);

  int width_, height_;
  bool depth_alone_;
  std::vector<VisibilityWord> words_;  ///< empty where depth_alone_
  std::vector<uint32_t> depths_;       ///< empty where not
  DepthTiles tiles_;
  SlotTable slots_;
  struct BatchEntry {
    DrawnRange range;
    std::span<const LatticeBox> pieces;
  };
  std::vector<BatchEntry> batch_;
  uint64_t batch_triangles_ = 0;
  std::vector<StretchTriangles> triangles_;  ///< of the batch, at least as many as it has entries
};

}  // namespace triptych
