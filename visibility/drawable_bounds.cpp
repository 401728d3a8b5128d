#include "visibility/drawable_bounds.hpp"

namespace triptych {

namespace {
constexpr size_t most_placements = 32;
constexpr size_t most_pieces = 256;

std::span<const Placement> placements_of(const Skeleton& skeleton, DrawableId id) {
  const Drawable& drawable = skeleton.drawables[id];
  return std::span(skeleton.placements).subspan(drawable.first_placement, drawable.placement_count);
}

DrawableBounds bounds_of(const BoxProjector& projector, std::span<const LatticeBox> boxes) {
  DrawableBounds bounds;
  for (const LatticeBox& box : boxes) {
    const ScreenBounds found = projector.bounds(box);
    if (found.kind == ScreenBounds::Kind::unbounded) return {found.kind, {}};
    if (found.kind == ScreenBounds::Kind::off_screen) continue;
    bounds.kind = found.kind;
    bounds.rectangles.push_back(found.rectangle);
  }
  return bounds;
}
}  // namespace

LatticeBox placed_box(const Skeleton& skeleton, const Placement& placement, const LatticeBox& local,
                      const LatticeBox& within) {
  const uint32_t lattice = skeleton.chunks[placement.chunk].lattice;
  LatticeBox box = local;
  if (lattice != 0 || placement.transform != 0) {
    const Box of_mesh = skeleton.lattices[lattice].box(local);
    const Box outer = skeleton.lattice().box(within);
    const Affine& transform = skeleton.transforms[placement.transform];
    Box placed;
    for (int i = 0; i < 8; ++i) placed.extend(transform * glm::dvec4(of_mesh.corner(i), 1));
    // The outer box's side stands where a transform leaves no number.
    placed = {glm::max(outer.lo, placed.lo), glm::min(outer.hi, placed.hi)};
    if (placed.empty()) return within;
    box = skeleton.lattice().enclosing(placed);
  }
  // A step for rounding in the transform.
  box = {glm::max(within.lo, box.lo - 1), glm::min(within.hi, box.hi + 1)};
  return box.empty() ? within : box;
}

void append_piece_boxes(const Skeleton& skeleton, const Placement& placement, const LatticeBox& node_box,
                        std::vector<LatticeBox>& boxes) {
  const std::span<const LatticeBox> pieces = skeleton.pieces_of(placement.chunk);
  // Whatever rounding does, pieces stay in the box that stands for them where they are too many.
  const LatticeBox whole = placed_box(skeleton, placement, skeleton.chunks[placement.chunk].box, node_box);
  if (pieces.size() == 1) {
    boxes.push_back(whole);
  } else {
    for (const LatticeBox& piece : pieces) boxes.push_back(placed_box(skeleton, placement, piece, whole));
  }
}

bool has_pieces(const Skeleton& skeleton, DrawableId id) {
  const auto placements = placements_of(skeleton, id);
  size_t pieces = 0;
  for (const Placement& placement : placements) pieces += skeleton.pieces_of(placement.chunk).size();
  return pieces > placements.size() && pieces <= most_pieces;
}

DrawableBounds placement_bounds(const Skeleton& skeleton, const BoxProjector& projector, DrawableId id) {
  const LatticeBox& node_box = skeleton.scene_nodes[skeleton.drawables[id].scene_node].box;
  const auto placements = placements_of(skeleton, id);
  const DrawableBounds whole = bounds_of(projector, std::span(&node_box, 1));
  if (whole.kind == ScreenBounds::Kind::off_screen || placements.size() > most_placements) return whole;
  std::vector<LatticeBox> boxes;
  for (const Placement& placement : placements)
    boxes.push_back(placed_box(skeleton, placement, skeleton.chunks[placement.chunk].box, node_box));
  return bounds_of(projector, boxes);
}

DrawableBounds drawable_bounds(const Skeleton& skeleton, const BoxProjector& projector, DrawableId id) {
  if (!has_pieces(skeleton, id)) return placement_bounds(skeleton, projector, id);
  const LatticeBox& node_box = skeleton.scene_nodes[skeleton.drawables[id].scene_node].box;
  std::vector<LatticeBox> boxes;
  for (const Placement& placement : placements_of(skeleton, id))
    append_piece_boxes(skeleton, placement, node_box, boxes);
  return bounds_of(projector, boxes);
}

}  // namespace triptych
