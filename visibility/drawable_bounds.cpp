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

/// What is known of two lists of boxes together.
ScreenBounds::Kind joined(ScreenBounds::Kind one, ScreenBounds::Kind other) {
  using Kind = ScreenBounds::Kind;
  for (const Kind kind : {Kind::unbounded, Kind::rectangle, Kind::hidden}) {
    if (one == kind || other == kind) return kind;
  }
  return Kind::off_screen;
}

/// Of the boxes of placements, of which there are `boxes_of(i)` of placement i, without those that are gone.
template <typename BoxesOf>
ScreenBounds::Kind append_bounds_without(const BoxProjector& projector, std::span<const LatticeBox> boxes,
                                         const ExtentTester* tester, std::span<const PlacementRun> gone,
                                         size_t placements, const BoxesOf& boxes_of,
                                         std::vector<ScreenRectangle>& rectangles) {
  if (gone.empty()) return append_bounds(projector, boxes, tester, rectangles);
  const size_t before = rectangles.size();
  ScreenBounds::Kind kind = ScreenBounds::Kind::off_screen;
  size_t next = 0;
  for (size_t i = 0; i < placements; ++i) {
    const size_t count = boxes_of(i);
    while (!gone.empty() && gone.front().end <= i) gone = gone.subspan(1);
    if (gone.empty() || i < gone.front().first)
      kind = joined(kind, append_bounds(projector, boxes.subspan(next, count), tester, rectangles));
    next += count;
  }
  if (kind == ScreenBounds::Kind::unbounded) rectangles.resize(before);
  return kind;
}

size_t count_of(std::span<const PlacementRun> runs) {
  size_t count = 0;
  for (const PlacementRun& run : runs) count += run.end - run.first;
  return count;
}

}  // namespace

bool has_pieces(const Hierarchy& hierarchy, DrawableId id) {
  const auto [placements, pieces] = hierarchy.placed_counts(id);
  return pieces > placements && pieces <= max_pieces;
}

ScreenBounds::Kind append_placement_bounds(const Hierarchy& hierarchy, const BoxProjector& projector,
                                           DrawableId id, const ExtentTester* tester,
                                           std::vector<ScreenRectangle>& rectangles,
                                           std::span<const PlacementRun> gone) {
  const LatticeBox whole = projector.box(hierarchy.skeleton().drawables[id].scene_node);
  const std::span<const LatticeBox> boxes = hierarchy.placed(id, projector.poses()).placements;
  const size_t shown = boxes.size() - count_of(gone);
  if (shown > max_placements) return append_bounds(projector, {&whole, 1}, tester, rectangles);
  if (shown > 1 && projector.is_off_screen(whole)) return ScreenBounds::Kind::off_screen;
  return append_bounds_without(
      projector, boxes, tester, gone, boxes.size(), [](size_t) { return size_t{1}; }, rectangles);
}

ScreenBounds::Kind append_drawable_bounds(const Hierarchy& hierarchy, const BoxProjector& projector,
                                          DrawableId id, std::vector<ScreenRectangle>& rectangles,
                                          std::span<const PlacementRun> gone) {
  if (!has_pieces(hierarchy, id))
    return append_placement_bounds(hierarchy, projector, id, nullptr, rectangles, gone);
  const std::span<const Placement> placements = hierarchy.placements_of(id);
  const auto pieces_of = [&](size_t i) { return hierarchy.skeleton().pieces_of(placements[i].chunk).size(); };
  return append_bounds_without(projector, hierarchy.placed(id, projector.poses()).pieces, nullptr, gone,
                               placements.size(), pieces_of, rectangles);
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
