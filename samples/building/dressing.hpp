// What makes the furnished building worth showing: textures on its surfaces, glass in its windows, lamps,
// curtains and blinds, pictures.
#pragma once

#include "samples/building/furnisher.hpp"
#include "samples/building/furniture_catalog.hpp"
#include "samples/building/shell.hpp"

#include <glm/glm.hpp>
#include <vector>

namespace triptych {

/// A lamp's light: it shines from a point in all directions.
struct LampLight {
  glm::dvec3 position{0};
  int storey = 0;
};

/// What all of them have: as a panel of 3,700 lumen.
inline constexpr double lamp_candela = 295;
inline constexpr glm::dvec3 lamp_colour{1.0, 0.95, 0.86};

struct Dressing {
  std::vector<ShellObject> objects;  ///< shared meshes and where they are
  std::vector<LampLight> lights;
};

/// Gives the shell its textures and its windows their glass. Images are named by write_dressing_images().
void dress_shell(std::vector<ShellObject>& shell);

/// Whether a piece in its place is a lamp at a ceiling, in whose place the dressing has its own.
bool is_ceiling_lamp(const FurniturePiece& piece, const FurniturePlacement& placement);

/// Lamps at the ceilings, pictures on walls, and curtains or blinds before windows, where the furniture
/// leaves them room.
Dressing make_dressing(const FloorPlan& plan, const Furniture& furniture,
                       const std::vector<FurniturePlacement>& placements, const Random& random);

}  // namespace triptych
