// What a hospital's storey is without its services: slabs, walls, doors, windows, suspended ceilings.
#pragma once

#include "samples/services/hospital_plan.hpp"
#include "samples/services/object_scene.hpp"

#include <vector>

namespace triptych {

void add_structure(ObjectScene& scene, const std::vector<HospitalRoom>& rooms, int storey);
/// Above the highest storey, and around the building.
void add_roof_and_ground(ObjectScene& scene, int storeys, Random random);

}  // namespace triptych
