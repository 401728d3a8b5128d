// A skeleton as frames walk it: the scene graph, and the boxes of what is placed in it, computed once.
#pragma once

#include "scene/placed_box.hpp"
#include "scene/poses.hpp"
#include "scene/skeleton.hpp"

#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace triptych {

/// Where a drawable's geometry may be, on the model's lattice.
struct PlacedDrawable {
  std::span<const LatticeBox> placements;  ///< one box per placement
  /// One box per piece of each placement's chunk, placement by placement, in the order of
  /// Skeleton::pieces_of(). The same boxes as `placements` where every chunk is in one piece.
  std::span<const LatticeBox> pieces;
};

/// One skeleton, which must outlive it. For one thread.
class Hierarchy {
 public:
  explicit Hierarchy(const Skeleton& skeleton);

  const Skeleton& skeleton() const { return skeleton_; }
  const SceneNode& scene_node_of(DrawableId id) const {
    return skeleton_.scene_nodes[skeleton_.drawables[id].scene_node];
  }
  std::span<const Placement> placements_of(DrawableId id) const {
    const Drawable& drawable = skeleton_.drawables[id];
    return std::span(skeleton_.placements).subspan(drawable.first_placement, drawable.placement_count);
  }
  /// Boxes that hold every vertex that is drawn, within the scene node's. Computed when they are first asked
  /// for, and kept. poses: FrameView::poses, which must be given where anything moves; the boxes of what does
  /// are kept until they are asked for with others.
  PlacedDrawable placed(DrawableId id, const Poses* poses = nullptr) const;
  /// How many boxes placed() has: of placements, and of pieces.
  std::pair<size_t, size_t> placed_counts(DrawableId id) const;

 private:
  struct Boxes {
    LatticeBox* first = nullptr;          ///< of the placements, then of the pieces; null until asked for
    uint32_t placements = 0, pieces = 0;  ///< pieces: 0 where there are no more of them than placements
  };
  bool moves(DrawableId id) const;
  Boxes& room(DrawableId id) const;
  void place(DrawableId id, const Boxes& room, const Poses* poses) const;
  LatticeBox* allocate(size_t count) const;

  const Skeleton& skeleton_;
  mutable std::vector<Boxes> placed_;  ///< for each drawable
  /// For each drawable the poses that its boxes are of (Poses::number()); empty where nothing moves.
  mutable std::vector<uint64_t> poses_;
  mutable std::vector<std::unique_ptr<LatticeBox[]>> blocks_;
  mutable LatticeBox* next_ = nullptr;
  mutable size_t left_ = 0;
};

}  // namespace triptych
