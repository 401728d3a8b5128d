#include "visibility/drawable_bounds.hpp"

namespace triptych {

namespace {
constexpr uint32_t most_rectangles = 32;
}

LatticeBox placement_box(const Skeleton& skeleton, const Placement& placement, const LatticeBox& node_box) {
  const ChunkInfo& chunk = skeleton.chunks[placement.chunk];
  LatticeBox box = chunk.box;
  if (chunk.lattice != 0 || placement.transform != 0) {
    const Box of_mesh = skeleton.lattices[chunk.lattice].box(chunk.box);
    const Box of_node = skeleton.lattice().box(node_box);
    const Affine& transform = skeleton.transforms[placement.transform];
    Box placed;
    for (int i = 0; i < 8; ++i) placed.extend(transform * glm::dvec4(of_mesh.corner(i), 1));
    // The node's side stands where a transform leaves no number.
    placed = {glm::max(of_node.lo, placed.lo), glm::min(of_node.hi, placed.hi)};
    if (placed.empty()) return node_box;
    box = skeleton.lattice().enclosing(placed);
  }
  // A step for rounding in the transform.
  box = {glm::max(node_box.lo, box.lo - 1), glm::min(node_box.hi, box.hi + 1)};
  return box.empty() ? node_box : box;
}

DrawableBounds drawable_bounds(const Skeleton& skeleton, const BoxProjector& projector, DrawableId id) {
  const Drawable& drawable = skeleton.drawables[id];
  const LatticeBox& node_box = skeleton.scene_nodes[drawable.scene_node].box;
  const ScreenBounds whole = projector.bounds(node_box);
  DrawableBounds bounds;
  if (whole.kind == ScreenBounds::Kind::off_screen) return bounds;
  if (drawable.placement_count > most_rectangles) {
    bounds.kind = whole.kind;
    if (whole.kind == ScreenBounds::Kind::rectangle) bounds.rectangles.push_back(whole.rectangle);
    return bounds;
  }
  for (uint32_t i = 0; i < drawable.placement_count; ++i) {
    const Placement& placement = skeleton.placements[drawable.first_placement + i];
    const ScreenBounds piece = projector.bounds(placement_box(skeleton, placement, node_box));
    if (piece.kind == ScreenBounds::Kind::unbounded) return {piece.kind, {}};
    if (piece.kind == ScreenBounds::Kind::off_screen) continue;
    bounds.kind = piece.kind;
    bounds.rectangles.push_back(piece.rectangle);
  }
  return bounds;
}

}  // namespace triptych
