// Where a drawable may appear on the screen: piece by piece, each closer than its scene node's box.
#pragma once

#include "lod/hierarchy.hpp"
#include "visibility/screen_bounds.hpp"

#include <vector>

namespace triptych {

/// Whether it is tested by more boxes than its placements': its chunks are in several pieces, and all of
/// them in at most 256.
bool has_pieces(const Hierarchy& hierarchy, DrawableId id);

/// Appends what the occlusion test draws for a drawable: of each placement on the screen a rectangle; of a
/// drawable of more than 32 placements one of its scene node's box. Returns `unbounded` where any box is,
/// `off_screen` where all are (then nothing is appended), and `rectangle` where the rectangles hold together.
ScreenBounds::Kind append_placement_bounds(const Hierarchy& hierarchy, const BoxProjector& projector,
                                           DrawableId id, std::vector<ScreenRectangle>& rectangles);

/// The same of each piece on the screen, if it has pieces; append_placement_bounds() otherwise.
ScreenBounds::Kind append_drawable_bounds(const Hierarchy& hierarchy, const BoxProjector& projector,
                                          DrawableId id, std::vector<ScreenRectangle>& rectangles);

/// The same two, for those who look at one drawable.
struct DrawableBounds {
  ScreenBounds::Kind kind = ScreenBounds::Kind::off_screen;
  std::vector<ScreenRectangle> rectangles;
};
DrawableBounds placement_bounds(const Hierarchy& hierarchy, const BoxProjector& projector, DrawableId id);
DrawableBounds drawable_bounds(const Hierarchy& hierarchy, const BoxProjector& projector, DrawableId id);

}  // namespace triptych
