// Parts of walls, floors, ceilings, doors. A wall runs along x from 0, from the floor up, around z = 0; what
// fills an opening is centred at its foot.
#pragma once

#include "samples/rect.hpp"
#include "samples/services/object_scene.hpp"

namespace triptych {

/// Holes in x and height; inside, skirtings on both sides between those that reach the floor.
MeshParts wall(double length, double height, double thickness, const std::vector<Rect>& holes, bool facade);
/// Slab and floor covering, from the origin to x and z.
MeshParts floor_slab(double width, double depth, const glm::dvec3& covering);
/// Panels on a grid of bars, from the origin to x and z.
MeshParts suspended_ceiling(double width, double depth);
MeshParts door_frame();
/// Open by a quarter turn: the hinge is at the origin, the leaf along z.
MeshParts door_leaf(int variant);
MeshParts window_frame();
/// Two flights and a landing in a stairwell of this size, from the origin.
MeshParts stair(double width, double depth);

}  // namespace triptych
