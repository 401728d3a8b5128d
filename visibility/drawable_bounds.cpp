#include "visibility/drawable_bounds.hpp"

namespace triptych {

namespace {
constexpr size_t max_placements = 32;
constexpr size_t max_pieces = 256;

ScreenBounds::Kind append_bounds(const BoxProjector& projector, std::span<const LatticeBox> boxes,
                                 const ExtentTester* tester, std::vector<ScreenRectangle>& rectangles) {
  using Kind = ScreenBounds::Kind;
  const size_t before = rectangles.size();
  Kind kind = Kind::off_screen;
  for (const LatticeBox& box : boxes) {
    const ScreenBounds found = projector.bounds(box, tester);
    if (found.kind == Kind::unbounded) {
      rectangles.resize(before);
      return found.kind;
    }
    if (found.kind == Kind::rectangle) {
      rectangles.push_back(found.rectangle);
      kind = Kind::rectangle;
    } else if (found.kind == Kind::hidden && kind == Kind::off_screen) {
      kind = Kind::hidden;
    }
  }
  return kind;
}
}  // namespace

bool has_pieces(const Hierarchy& hierarchy, DrawableId id) {
  const PlacedDrawable placed = hierarchy.placed(id);
  return placed.pieces.size() > placed.placements.size() && placed.pieces.size() <= max_pieces;
}

ScreenBounds::Kind append_placement_bounds(const Hierarchy& hierarchy, const BoxProjector& projector,
                                           DrawableId id, const ExtentTester* tester,
                                           std::vector<ScreenRectangle>& rectangles) {
  const LatticeBox& whole = hierarchy.scene_node_of(id).box;
  const std::span<const LatticeBox> boxes = hierarchy.placed(id).placements;
  if (boxes.size() > max_placements) return append_bounds(projector, {&whole, 1}, tester, rectangles);
  if (boxes.size() > 1 && projector.is_off_screen(whole)) return ScreenBounds::Kind::off_screen;
  return append_bounds(projector, boxes, tester, rectangles);
}

ScreenBounds::Kind append_drawable_bounds(const Hierarchy& hierarchy, const BoxProjector& projector,
                                          DrawableId id, std::vector<ScreenRectangle>& rectangles) {
  if (!has_pieces(hierarchy, id))
    return append_placement_bounds(hierarchy, projector, id, nullptr, rectangles);
  return append_bounds(projector, hierarchy.placed(id).pieces, nullptr, rectangles);
}

DrawableBounds placement_bounds(const Hierarchy& hierarchy, const BoxProjector& projector, DrawableId id) {
  DrawableBounds bounds;
  bounds.kind = append_placement_bounds(hierarchy, projector, id, nullptr, bounds.rectangles);
  return bounds;
}

DrawableBounds drawable_bounds(const Hierarchy& hierarchy, const BoxProjector& projector, DrawableId id) {
  DrawableBounds bounds;
  bounds.kind = append_drawable_bounds(hierarchy, projector, id, bounds.rectangles);
  return bounds;
}

}  // namespace triptych
