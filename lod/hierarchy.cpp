#include "lod/hierarchy.hpp"

#include <algorithm>
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

Hierarchy::Hierarchy(const Skeleton& skeleton) : skeleton_(skeleton), placed_(skeleton.drawables.size()) {}

PlacedDrawable Hierarchy::placed(DrawableId id) const {
  Boxes& boxes = placed_[id];
  if (boxes.first == nullptr) boxes = place(id);
  const std::span wholes(boxes.first, boxes.placements);
  if (boxes.pieces == 0) return {wholes, wholes};
  return {wholes, std::span(boxes.first + boxes.placements, boxes.pieces)};
}

/// The boxes of the placements, followed by those of the pieces where there are more pieces than placements.
Hierarchy::Boxes Hierarchy::place(DrawableId id) const {
  const std::span<const Placement> placements = placements_of(id);
  const LatticeBox& node_box = scene_node_of(id).box;
  const size_t pieces = pieces_of(skeleton_, placements);
  const bool in_pieces = pieces > placements.size();
  LatticeBox* const boxes = allocate(placements.size() + (in_pieces ? pieces : 0));
  LatticeBox* piece_box = boxes + placements.size();
  for (size_t i = 0; i < placements.size(); ++i) {
    const Placement& placement = placements[i];
    boxes[i] = placed_box(skeleton_, placement, skeleton_.chunks[placement.chunk].box, node_box);
    if (!in_pieces) continue;
    const std::span<const LatticeBox> of_chunk = skeleton_.pieces_of(placement.chunk);
    // Whatever rounding does, pieces stay in their placement's box, which replaces them where they are too
    // many.
    for (const LatticeBox& piece : of_chunk) {
      *piece_box++ = of_chunk.size() == 1 ? boxes[i] : placed_box(skeleton_, placement, piece, boxes[i]);
    }
  }
  return {boxes, static_cast<uint32_t>(placements.size()), in_pieces ? static_cast<uint32_t>(pieces) : 0};
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
