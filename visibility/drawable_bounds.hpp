// Where a drawable may appear on the screen: piece by piece, each closer than its scene node's box.
#pragma once

#include "scene/skeleton.hpp"
#include "visibility/screen_bounds.hpp"

#include <vector>

namespace triptych {

/// On the model's lattice, within the scene node's box: holds every vertex that the placement draws, and one
/// step more on each side. Fragments are held to it.
LatticeBox placement_box(const Skeleton& skeleton, const Placement& placement, const LatticeBox& node_box);

/// What the occlusion test draws for a drawable.
struct DrawableBounds {
  /// Unbounded where any piece is, off the screen where all are; otherwise the rectangles hold together.
  ScreenBounds::Kind kind = ScreenBounds::Kind::off_screen;
  std::vector<ScreenRectangle> rectangles;
};

/// Of each placement on the screen a rectangle; of a drawable of more than 32 placements one of its scene
/// node's box.
DrawableBounds drawable_bounds(const Skeleton& skeleton, const BoxProjector& projector, DrawableId id);

}  // namespace triptych
