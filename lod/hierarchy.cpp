#include "lod/hierarchy.hpp"

#include <algorithm>
#include <cassert>
#include <glm/vec4.hpp>
#include <utility>

namespace triptych {

namespace {
constexpr size_t block_boxes = 4096;

size_t pieces_of(const Skeleton& skeleton, std::span<const Placement> placements) {
  size_t pieces = 0;
  for (const Placement& placement : placements) pieces += skeleton.pieces_of(placement.chunk).size();
  return pieces;
}
}  // namespace

Hierarchy::Hierarchy(const Skeleton& skeleton)
    : skeleton_(skeleton),
      placed_(skeleton.drawables.size()),
      poses_(skeleton.moving ? skeleton.drawables.size() : 0, 0) {}

bool Hierarchy::moves(DrawableId id) const {
  return skeleton_.moving && skeleton_.moving->node_of[skeleton_.drawables[id].scene_node] != no_id;
}

PlacedDrawable Hierarchy::placed(DrawableId id, const Poses* poses) const {
  const Boxes& boxes = room(id);
  if (moves(id)) {
    assert(poses != nullptr);
    if (std::exchange(poses_[id], poses->number()) != poses->number()) place(id, boxes, poses);
  }
  const std::span wholes(boxes.first, boxes.placements);
  if (boxes.pieces == 0) return {wholes, wholes};
  return {wholes, std::span(boxes.first + boxes.placements, boxes.pieces)};
}

std::pair<size_t, size_t> Hierarchy::placed_counts(DrawableId id) const {
  const Boxes& boxes = room(id);
  return {boxes.placements, std::max(boxes.placements, boxes.pieces)};
}

/// The boxes of the placements, followed by those of the pieces where there are more pieces than placements:
/// computed, but for those of what moves.
Hierarchy::Boxes& Hierarchy::room(DrawableId id) const {
  Boxes& boxes = placed_[id];
  if (boxes.first != nullptr) return boxes;
  const size_t placements = placements_of(id).size(), pieces = pieces_of(skeleton_, placements_of(id));
  const bool in_pieces = pieces > placements;
  boxes = {allocate(placements + (in_pieces ? pieces : 0)), static_cast<uint32_t>(placements),
           in_pieces ? static_cast<uint32_t>(pieces) : 0};
  if (!moves(id)) place(id, boxes, nullptr);
  return boxes;
}

void Hierarchy::place(DrawableId id, const Boxes& room, const Poses* poses) const {
  const std::span<const Placement> placements = placements_of(id);
  LatticeBox node_box = scene_node_of(id).box;
  if (poses) node_box = poses->box(skeleton_.lattice(), skeleton_.drawables[id].scene_node, node_box);
  LatticeBox* const boxes = room.first;
  LatticeBox* piece_box = boxes + placements.size();
  Affine transform(1);
  for (size_t i = 0; i < placements.size(); ++i) {
    const Placement& placement = placements[i];
    const auto placed_in = [&](const LatticeBox& local, const LatticeBox& within) {
      if (!poses) return placed_box(skeleton_, placement, local, within);
      return placed_box(skeleton_, skeleton_.chunks[placement.chunk].lattice, transform, local, within);
    };
    if (poses) transform = poses->transform(placement.transform, Affine(1));
    boxes[i] = placed_in(skeleton_.chunks[placement.chunk].box, node_box);
    if (room.pieces == 0) continue;
    const std::span<const LatticeBox> of_chunk = skeleton_.pieces_of(placement.chunk);
    // Whatever rounding does, pieces stay in their placement's box, which replaces them where they are too
    // many.
    for (const LatticeBox& piece : of_chunk)
      *piece_box++ = of_chunk.size() == 1 ? boxes[i] : placed_in(piece, boxes[i]);
  }
}

LatticeBox* Hierarchy::allocate(size_t count) const {
  if (count > left_) {
    left_ = std::max(count, block_boxes);
    blocks_.push_back(std::make_unique<LatticeBox[]>(left_));
    next_ = blocks_.back().get();
  }
  left_ -= count;
  return std::exchange(next_, next_ + count);
}

}  // namespace triptych
