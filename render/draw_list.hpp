// Drawables as OpenGL draws them: one indirect command and one record a placement, in the order
// given, and the bounds of its pieces.
#pragma once

#include "render/device_scene.hpp"
#include "scene/camera.hpp"
#include "visibility/screen_bounds.hpp"

#include <glm/mat4x3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

namespace triptych {

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

/// Places chunks under one view. Positions are taken relative to the cell of the eye (ClipSpace::reference)
/// on the chunk's own lattice, in integers, so that precision does not depend on where the model stands.
class DrawListBuilder {
 public:
  DrawListBuilder(const Skeleton& skeleton, const View& view);

  struct DrawList {
    std::vector<DrawRecord> records;
    std::vector<BoundRecord> bounds;
    std::vector<DrawCommand> commands;
    uint64_t triangles = 0;
  };
  /// The chunks must be loaded.
  void append(const DeviceScene& scene, std::span<const DrawableId> drawables, DrawList& list);
  const ClipSpace& clip() const { return clip_; }

 private:
  struct PlacedLattice {
    bool known = false;
    glm::vec4 rows[3];
    glm::ivec3 cell;
  };
  const PlacedLattice& place(uint32_t transform, uint32_t lattice);
  BoundRecord bound(const LatticeBox& box) const;

  const Skeleton& skeleton_;
  View view_;
  ClipSpace clip_;
  glm::dmat3 rotation_;
  BoxProjector projector_;
  std::vector<PlacedLattice> placed_;  ///< by transform, for the lattice it was last asked with
  std::vector<uint32_t> placed_with_lattice_;
  std::vector<LatticeBox> boxes_;
};

}  // namespace triptych
