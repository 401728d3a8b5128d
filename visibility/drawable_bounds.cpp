#include "visibility/drawable_bounds.hpp"

namespace triptych {

namespace {
constexpr size_t max_placements = 32;
constexpr size_t max_pieces = 256;

ScreenBounds::Kind append_bounds(const BoxProjector& projector, std::span<const LatticeBox> boxes,
                                 std::vector<ScreenRectangle>& rectangles) {
  const size_t before = rectangles.size();
  for (const LatticeBox& box : boxes) {
    const ScreenBounds found = projector.bounds(box);
    if (found.kind == ScreenBounds::Kind::rectangle) rectangles.push_back(found.rectangle);
    if (found.kind != ScreenBounds::Kind::unbounded) continue;
    rectangles.resize(before);
    return found.kind;
  }
  return rectangles.size() > before ? ScreenBounds::Kind::rectangle : ScreenBounds::Kind::off_screen;
}
}  // namespace

bool has_pieces(const Hierarchy& hierarchy, DrawableId id) {
  const PlacedDrawable placed = hierarchy.placed(id);
  return placed.pieces.size() > placed.placements.size() && placed.pieces.size() <= max_pieces;
}

ScreenBounds::Kind append_placement_bounds(const Hierarchy& hierarchy, const BoxProjector& projector,
                                           DrawableId id, std::vector<ScreenRectangle>& rectangles) {
  const ScreenBounds whole = projector.bounds(hierarchy.scene_node_of(id).box);
  if (whole.kind == ScreenBounds::Kind::off_screen) return whole.kind;
  const std::span<const LatticeBox> boxes = hierarchy.placed(id).placements;
  if (boxes.size() <= max_placements) return append_bounds(projector, boxes, rectangles);
  if (whole.kind == ScreenBounds::Kind::rectangle) rectangles.push_back(whole.rectangle);
  return whole.kind;
}

ScreenBounds::Kind append_drawable_bounds(const Hierarchy& hierarchy, const BoxProjector& projector,
                                          DrawableId id, std::vector<ScreenRectangle>& rectangles) {
  if (!has_pieces(hierarchy, id)) return append_placement_bounds(hierarchy, projector, id, rectangles);
  return append_bounds(projector, hierarchy.placed(id).pieces, rectangles);
}

DrawableBounds placement_bounds(const Hierarchy& hierarchy, const BoxProjector& projector, DrawableId id) {
  DrawableBounds bounds;
  bounds.kind = append_placement_bounds(hierarchy, projector, id, bounds.rectangles);
  return bounds;
}

DrawableBounds drawable_bounds(const Hierarchy& hierarchy, const BoxProjector& projector, DrawableId id) {
  DrawableBounds bounds;
  bounds.kind = append_drawable_bounds(hierarchy, projector, id, bounds.rectangles);
  return bounds;
}

}  // namespace triptych
