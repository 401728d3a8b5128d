// What is drawn in one frame, pixel by pixel: depth, and the triangle that it is of.
#pragma once

#include "base/threads.hpp"
#include "raster/cap_fill.hpp"
#include "raster/depth_tiles.hpp"
#include "raster/fill.hpp"
#include "raster/geometry_stage.hpp"

#include <functional>
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
  int32_t front = 0;     ///< DrawnRange::front
  uint32_t cut = 0;      ///< DrawnRange::cut
  bool cut_out = false;  ///< DrawnRange::cut_out
  std::span<const LatticeBox> pieces;
};

/// Triangles of a closed surface that a section may cut, and where surfaces begin and end among such.
struct PlacedCapRun {
  PlacedStretch stretch;  ///< cut: that of the whole surface
  bool is_drawn;          ///< or only counts
  bool is_first, is_last;
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
  /// Draws the cut surfaces of closed surfaces, whose runs follow each other, all of each.
  void draw_caps(const GeometryTerms& terms, std::span<const PlacedCapRun> runs, CapCounters& counters);

  int width() const { return width_; }
  int height() const { return height_; }
  /// Of a pixel; 0 where nothing is.
  float depth(int x, int y) const;
  /// The slots of a row's pixels; without meaning where nothing is. Equal ones are the same triangle.
  std::span<const uint32_t> slots(int y) const { return slots_.row(y); }
  /// The bits of their depths; 0 where nothing is.
  std::span<const uint32_t> depths(int y) const { return depths_.row(y); }
  /// The farthest depths of tiles, of what is drawn so far.
  const DepthTiles& tiles() const { return tiles_; }
  /// For kernels that test boxes.
  DepthSource source() const;
  /// Null where nothing is. Not of a buffer that keeps depth alone.
  std::optional<SlotTable::Triangle> triangle(int x, int y) const;
  /// Calls body(first, last) for bands of rows, both included, each by the thread that had it last time,
  /// where side_by_side; else one after the other here.
  void for_each_band(bool side_by_side, const std::function<void(int32_t, int32_t)>& body) const;
  SlotTable::Triangle find(uint32_t slot) const { return table_.find(slot); }
  SlotTable::Triangle find(uint32_t slot, size_t& range) const { return table_.find(slot, range); }
  const SlotTable& table() const { return table_; }
  /// Whether slots have other numbers by now than in the order of drawing.
  bool is_renumbered() const { return table_.is_compacted(); }

 private:
  DrawnRange& number(const PlacedStretch& stretch, uint32_t first, uint32_t count, bool caps = false);
  /// The batch's triangles. Returns whether it is worth several threads.
  bool make_batch(const GeometryTerms& terms, const DepthSource& drawn);
  void draw_batch(const GeometryTerms& terms);
  void draw_cap_batch(const GeometryTerms& terms, CapCounters& counters);
  void sort_large();
  void fill_rows(int32_t first, int32_t last);
  FillTarget target();

  int width_, height_;
  bool depth_alone_;
  mutable ThreadAffinity affinity_;
  PixelPlane depths_;
  PixelPlane slots_;  ///< empty where depth_alone_
  DepthTiles tiles_;
  std::optional<DepthTiles> nothing_;  ///< tiles of an empty buffer
  SlotTable table_;
  struct BatchEntry {
    DrawnRange range;
    std::span<const LatticeBox> pieces;
  };
  std::vector<BatchEntry> batch_;
  std::vector<CapRun> cap_runs_;  ///< of the batch, where it is one of caps
  uint64_t batch_triangles_ = 0;
  std::vector<StretchTriangles> triangles_;  ///< of the batch, at least as many as it has entries
  /// The large ones among them, nearest first: what lies behind them is found hidden by tiles.
  struct LargeTriangle {
    float depth;
    const FillTriangle* triangle;
  };
  std::vector<LargeTriangle> large_;
};

}  // namespace triptych
