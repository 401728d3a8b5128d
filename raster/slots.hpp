// What the low word of a pixel names, and which of two things at one depth wins.
#pragma once

#include "lod/draw_rank.hpp"
#include "raster/chunk_geometry.hpp"
#include "raster/pixel_plane.hpp"
#include "visibility/vertex_terms.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace triptych {

/// A stretch of a chunk's triangles as it was drawn.
struct DrawnRange {
  DrawRank rank;                ///< of the drawable
  uint32_t part = 0;            ///< counts the drawable's draw items
  uint32_t first_triangle = 0;  ///< of the chunk
  uint32_t triangle_count = 0;
  uint32_t first_slot = 0;
  int32_t front = 0;         ///< outward_front()
  uint32_t cut = 0;          ///< SectionPlace::cut
  bool caps = false;         ///< what shows are the caps of its triangles
  bool transparent = false;  ///< each of its triangles is set up by itself
  bool cut_out = false;      ///< its triangles have holes where their texture says so
  const RasterChunk* chunk = nullptr;
  PlacedLattice placed = {};
};

/// Numbers the triangles of a frame in the order of drawing: a slot each. Where depths are equal, slots are
/// compared by what they stand for, so that the picture is a function of what was drawn, and not of the
/// order.
class SlotTable {
 public:
  /// max_slots: so many are numbered before compact() is needed; at least the pixels of the buffer, plus one.
  explicit SlotTable(uint64_t max_slots) : max_slots_(max_slots) {}

  void clear();
  /// How many more triangles can be numbered.
  uint64_t left() const { return max_slots_ - next_slot_; }
  /// Numbers them; their first slot. Precondition: triangle_count <= left().
  uint32_t add(DrawnRange range);
  /// Gives new, low numbers to the slots of pixels that hold something (whose depth is not 0), and forgets
  /// the others.
  void compact(const PixelPlane& depths, PixelPlane& slots);

  struct Triangle {
    const DrawnRange* range;
    uint32_t triangle;  ///< of the chunk
  };
  Triangle find(uint32_t slot) const;
  /// The same, for who finds many that are near each other. range: where the last one was found; any number
  /// at first.
  Triangle find(uint32_t slot, size_t& range) const;
  /// Whether compact() was called since clear().
  bool is_compacted() const { return compacted_ > 0; }
  /// Whether the first wins over the second at equal depth: that of the higher layer (the lower number), then
  /// the lower draw rank, part, triangle, and its cap before the triangle.
  bool precedes(uint32_t slot, uint32_t other) const;

 private:
  struct Kept {
    uint32_t range, triangle;
  };
  size_t range_of(uint32_t slot) const;
  Kept name_of(uint32_t slot) const;

  uint64_t max_slots_, next_slot_ = 0;
  std::vector<Kept> kept_;  ///< by slot: those that compact() has renumbered
  size_t compacted_ = 0;    ///< ranges before this one are named by kept_ alone
  std::vector<DrawnRange> ranges_;
  std::vector<uint32_t> scratch_;
};

}  // namespace triptych
