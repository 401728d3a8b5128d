// The services of a hospital's storey: what is above its suspended ceilings, in its shafts and on its walls.
//
// Heights above the floor, so that services pass each other: trays and pipes on racks in the corridors 3.0 m,
// branch ducts 3.33 m, pipes to rooms 3.53 m, the sprinklers' mains 3.62 m, main ducts 3.88 m.
#pragma once

#include "samples/services/hospital_plan.hpp"
#include "samples/services/object_scene.hpp"
#include "samples/services/runs.hpp"

namespace triptych {

namespace service_heights {
inline constexpr double rack = 3.0, branch = 3.33, room_pipes = 3.53, sprinkler_main = 3.62, main_duct = 3.88;
inline constexpr double main_height = 0.4, branch_height = 0.22;
}  // namespace service_heights

namespace service_systems {
extern const DuctSystem supply_air, return_air;
extern const PipeSystem heating_flow, heating_return, cooling_flow, cooling_return, cold_water, hot_water,
    oxygen, vacuum, medical_air, sprinklers, drain, conduit;
/// Side by side on each corridor's rack, from smaller z to larger.
const std::vector<PipeSystem>& on_the_rack();
}  // namespace service_systems

/// Where things run in a corridor, from its middle towards larger z.
double main_duct_offset(const DuctSystem& system);
double rack_offset(size_t pipe);
inline constexpr double tray_offsets[2] = {0.5, 0.92};

/// Mains along a corridor, with hangers and racks, luminaires and what else its ceiling carries.
void add_corridor_services(ObjectScene& scene, int storey, int corridor);
/// Risers, and their connections to the corridor's mains.
void add_shaft_services(ObjectScene& scene, const HospitalRoom& shaft);
/// Air, water, gases, power to a room.
void add_room_services(ObjectScene& scene, const HospitalRoom& room, Random random);

}  // namespace triptych
