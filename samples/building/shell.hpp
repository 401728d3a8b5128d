// The building itself: slabs, walls, doors, windows, stairs; everything but furniture.
#pragma once

#include "samples/building/floor_plan.hpp"
#include "samples/mesh_part.hpp"

#include <optional>
#include <string>
#include <vector>

namespace triptych {

/// A mesh and where it stands: once, in building coordinates, or often, in its own.
struct ShellObject {
  std::string name;
  std::vector<MeshPart> parts;
  std::vector<glm::dmat4> places;
  std::optional<int> storey;  ///< of one with a single place; nullopt: it is outside

  /// The storey of one of its places.
  std::optional<int> storey_of(const glm::dmat4& place) const;
};

/// Slabs, ceilings and skirtings are one object per room, walls one for each piece between two rooms; doors,
/// windows and stairs are shared. Every body is closed.
std::vector<ShellObject> make_shell(const FloorPlan& plan);

/// Railings around the openings of a floor: what people do not walk through, besides walls and door leaves.
std::vector<Rect> railing_footprints(const Rect& hole);

}  // namespace triptych
