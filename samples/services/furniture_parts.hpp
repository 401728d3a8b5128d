// Furniture of a hospital. Each piece stands on y = 0, centred over its footprint, its back towards -z.
#pragma once

#include "samples/services/object_scene.hpp"

#include <string>

namespace triptych {

struct FurniturePiece {
  std::string name;
  glm::dvec2 size{0};  ///< of its footprint: along x and z
  MakeMesh make;
};

/// A model of each; `variant` 0 to 3 tells similar ones apart.
FurniturePiece bed(int variant);
FurniturePiece bedside_table(int variant);
FurniturePiece chair(int variant);
FurniturePiece armchair(int variant);
FurniturePiece office_chair(int variant);
FurniturePiece stool(int variant);
FurniturePiece desk(int variant);
FurniturePiece table(int variant);
FurniturePiece cabinet(int variant);
FurniturePiece shelf(int variant);
FurniturePiece bench(int variant);
FurniturePiece couch(int variant);
FurniturePiece wash_basin(int variant);
FurniturePiece toilet(int variant);
FurniturePiece drip_stand(int variant);
FurniturePiece waste_bin(int variant);
FurniturePiece trolley(int variant);
FurniturePiece air_handler(int variant);
/// Stand on desks: the origin is the desk's top.
FurniturePiece monitor(int variant);
FurniturePiece keyboard(int variant);

}  // namespace triptych
