// Where a drawable may appear on the screen: piece by piece, each closer than its scene node's box.
#pragma once

#include "lod/hierarchy.hpp"
#include "scene/hidden_objects.hpp"
#include "visibility/screen_bounds.hpp"

#include <span>
#include <vector>

namespace triptych {

/// Whether the drawable is tested by more boxes than its placements': some chunk of it has several pieces,
/// and there are at most 256 pieces in all.
bool has_pieces(const Hierarchy& hierarchy, DrawableId id);

/// Appends what the occlusion test draws for a drawable: a rectangle for each placement on the screen, or,
/// for a drawable of more than 32 placements, one for its scene node's box. Returns `unbounded` where any
/// box is, `off_screen` where all are, and `rectangle` otherwise: what of the content is not hidden is within
/// the rectangles. Boxes that `tester`, if there is one, knows to be hidden have none; `hidden` where no
/// other is on the screen. `gone`: placements that are not there, ascending, which have no boxes either.
ScreenBounds::Kind append_placement_bounds(const Hierarchy& hierarchy, const BoxProjector& projector,
                                           DrawableId id, const ExtentTester* tester,
                                           std::vector<ScreenRectangle>& rectangles,
                                           std::span<const PlacementRun> gone = {});

/// The same for each piece on the screen, if has_pieces(); append_placement_bounds() otherwise. No tester is
/// asked.
ScreenBounds::Kind append_drawable_bounds(const Hierarchy& hierarchy, const BoxProjector& projector,
                                          DrawableId id, std::vector<ScreenRectangle>& rectangles,
                                          std::span<const PlacementRun> gone = {});

/// The same two, for callers that look at one drawable.
struct DrawableBounds {
  ScreenBounds::Kind kind = ScreenBounds::Kind::off_screen;
  std::vector<ScreenRectangle> rectangles;
};
DrawableBounds placement_bounds(const Hierarchy& hierarchy, const BoxProjector& projector, DrawableId id);
DrawableBounds drawable_bounds(const Hierarchy& hierarchy, const BoxProjector& projector, DrawableId id);

}  // namespace triptych
