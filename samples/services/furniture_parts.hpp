// Furniture of a hospital. Each piece stands on y = 0, centred over its footprint, its back towards -z.
#pragma once

#include "samples/services/object_scene.hpp"

#include <string>

namespace triptych {

struct FurnitureModel {
  std::string name;
  glm::dvec2 size{0};  ///< of its footprint: along x and z
  MakeMesh make;
};

/// A model of each; `variant` 0 to 3 tells similar ones apart.
FurnitureModel bed(int variant);
FurnitureModel bedside_table(int variant);
FurnitureModel chair(int variant);
FurnitureModel armchair(int variant);
FurnitureModel office_chair(int variant);
FurnitureModel stool(int variant);
FurnitureModel desk(int variant);
FurnitureModel table(int variant);
FurnitureModel cabinet(int variant);
FurnitureModel shelf(int variant);
FurnitureModel bench(int variant);
FurnitureModel couch(int variant);
FurnitureModel wash_basin(int variant);
FurnitureModel toilet(int variant);
FurnitureModel drip_stand(int variant);
FurnitureModel waste_bin(int variant);
FurnitureModel trolley(int variant);
FurnitureModel air_handler(int variant);
/// Stand on desks: the origin is the desk's top.
FurnitureModel monitor(int variant);
FurnitureModel keyboard(int variant);

}  // namespace triptych
