// Where a drawable may appear on the screen: piece by piece, each closer than its scene node's box.
#pragma once

#include "scene/skeleton.hpp"
#include "visibility/screen_bounds.hpp"

#include <vector>

namespace triptych {

/// On the model's lattice: holds what is in `local`, a box of the placement's chunk, and one step more on
/// each side; within the box `within`, which holds all that the placement draws there.
LatticeBox placed_box(const Skeleton& skeleton, const Placement& placement, const LatticeBox& local,
                      const LatticeBox& within);

/// Of each piece of the placement's chunk a box that holds every vertex of it that the placement draws,
/// within the scene node's. Fragments of a piece are held to its box.
void append_piece_boxes(const Skeleton& skeleton, const Placement& placement, const LatticeBox& node_box,
                        std::vector<LatticeBox>& boxes);

/// What the occlusion test draws for a drawable.
struct DrawableBounds {
  /// Unbounded where any piece is, off the screen where all are; otherwise the rectangles hold together.
  ScreenBounds::Kind kind = ScreenBounds::Kind::off_screen;
  std::vector<ScreenRectangle> rectangles;
};

/// Whether it is tested by more boxes than its placements': its chunks are in several pieces, and all of
/// them in at most 256.
bool has_pieces(const Skeleton& skeleton, DrawableId id);

/// Of each placement on the screen a rectangle; of a drawable of more than 32 placements one of its scene
/// node's box.
DrawableBounds placement_bounds(const Skeleton& skeleton, const BoxProjector& projector, DrawableId id);

/// Of each piece on the screen a rectangle, if it has pieces; placement_bounds() otherwise.
DrawableBounds drawable_bounds(const Skeleton& skeleton, const BoxProjector& projector, DrawableId id);

}  // namespace triptych
