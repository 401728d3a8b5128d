// Drawables as OpenGL draws them: one indirect command and one record a placement, in the order
// given, and the bounds of its pieces.
#pragma once

#include "base/epoch_marks.hpp"
#include "lod/representation.hpp"
#include "visibility/screen_bounds.hpp"

#include <glm/vec4.hpp>
#include <optional>
#include <span>
#include <vector>

namespace triptych {

/// Where a chunk lies in the device's buffers; nowhere where it is not there.
struct ChunkRange {
  uint32_t first_index = 0, index_count = 0, base_vertex = 0;
  bool loaded() const { return index_count > 0; }
};

/// What the vertex stage reads for one placement; laid out as the shader has it.
struct DrawRecord {
  glm::vec4 rows[3];
  glm::ivec3 cell;
  uint32_t item;
  uint32_t first_bound;  ///< of the chunk's pieces, which follow each other
  uint32_t unused[3];
};
static_assert(sizeof(DrawRecord) == 80);

/// DepthBound of a piece in window coordinates (pixels): for each of the planes its slopes and what there is
/// at (0, 0), which the vertex stage passes on as they are. Last, `nearest`.
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

  /// Empties it and keeps its room.
  void clear();
};

/// Places chunks under one frame view at a time. Positions are taken relative to the cell of the eye
/// (ClipSpace::reference) on the chunk's own lattice, in integers, so that precision does not depend on where
/// the model stands. Keeps its room from frame to frame.
class DrawListBuilder {
 public:
  explicit DrawListBuilder(const Skeleton& skeleton);

  void begin(const FrameView& view);
  /// ranges: of each chunk where it lies in device memory; those that are not loaded are left out.
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
  std::vector<PlacedLattice> placed_;  ///< by transform, for the lattice that it was last asked with
};

}  // namespace triptych
