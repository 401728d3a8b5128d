// The building itself: slabs, walls, doors, windows, stairs; everything but furniture.
#pragma once

#include "samples/building/floor_plan.hpp"
#include "samples/building/obj_furniture.hpp"

#include <string>
#include <vector>

namespace triptych {

/// A mesh and where it stands: once, in building coordinates, or often, in its own.
struct ShellObject {
  std::string name;
  std::vector<MeshPart> parts;
  std::vector<glm::dmat4> places;
};

/// Slabs, ceilings and skirtings are one object a room, walls one a piece between two rooms; doors, windows
/// and stairs are shared. Every body is closed.
std::vector<ShellObject> make_shell(const FloorPlan& plan);

/// Railings around the openings of a floor: what people do not walk through, besides walls and door leaves.
std::vector<Rect> railing_footprints(const Rect& hole);

}  // namespace triptych
