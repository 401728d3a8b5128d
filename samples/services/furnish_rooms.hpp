// Furniture in the rooms of a hospital: away from doors, along walls, in rows.
#pragma once

#include "samples/services/hospital_plan.hpp"
#include "samples/services/object_scene.hpp"

namespace triptych {

void furnish_room(ObjectScene& scene, const HospitalRoom& room, Random random);

}  // namespace triptych
