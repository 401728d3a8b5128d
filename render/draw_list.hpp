// Drawables as OpenGL draws them: one indirect command and one record per placement, in the order given, and
// the bounds of its pieces.
#pragma once

#include "base/epoch_marks.hpp"
#include "lod/representation.hpp"
#include "visibility/screen_bounds.hpp"

#include <glm/vec4.hpp>
#include <optional>
#include <span>
#include <vector>

namespace triptych {

/// Where a chunk lies in the device's buffers; empty if it is not loaded.
struct ChunkRange {
  uint32_t first_index = 0, index_count = 0, base_vertex = 0;
  bool loaded() const { return index_count > 0; }
};

/// What the vertex stage reads for one placement; the same layout as in the shader.
struct DrawRecord {
  glm::vec4 rows[3];
  glm::ivec3 cell;
  uint32_t item;
  uint32_t first_bound;  ///< of the chunk's first piece; those of the others follow
  uint32_t unused[3];
};
static_assert(sizeof(DrawRecord) == 80);

/// DepthBound of a piece in window coordinates (pixels): the slopes of each plane and its depth at (0, 0),
/// which the vertex stage passes on unchanged. Last, `nearest`.
struct BoundRecord {
  glm::vec4 x, y, at;
};
static_assert(sizeof(BoundRecord) == 48);

struct DrawCommand {
  uint32_t index_count, instance_count, first_index;
  int32_t base_vertex;
  uint32_t base_instance;
};

struct DrawList {
  std::vector<DrawRecord> records;
  std::vector<BoundRecord> bounds;
  std::vector<DrawCommand> commands;
  uint64_t triangles = 0;

  /// Empties it and keeps its memory.
  void clear();
};

/// Places chunks under one frame view at a time. Positions are taken relative to the cell of the eye
/// (ClipSpace::reference) on the chunk's own lattice, in integers, so that precision does not depend on where
/// the model stands. Reuses its memory from frame to frame.
class DrawListBuilder {
 public:
  explicit DrawListBuilder(const Skeleton& skeleton);

  void begin(const FrameView& view);
  /// ranges: for each chunk where it lies in device memory; chunks that are not loaded are left out.
  void append(std::span<const ChunkRange> ranges, std::span<const DrawItem> items, DrawList& list);

 private:
  struct PlacedLattice {
    uint32_t lattice = no_id;
    glm::vec4 rows[3];
    glm::ivec3 cell;
  };
  const PlacedLattice& place(uint32_t transform, uint32_t lattice);
  BoundRecord bound(const LatticeBox& box) const;

  const Skeleton& skeleton_;
  std::optional<FrameView> view_;
  std::optional<BoxProjector> projector_;
  EpochMarks is_placed_;               ///< transforms
  std::vector<PlacedLattice> placed_;  ///< by transform, for the lattice that it was last used with
};

}  // namespace triptych
