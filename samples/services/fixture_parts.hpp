// What ends services in a room or hangs beside them: luminaires, diffusers, sprinklers, trays, sockets. What
// belongs into a ceiling has its origin in the ceiling's lower face; what belongs on a wall has it at the
// wall, and faces z.
#pragma once

#include "samples/services/object_scene.hpp"

namespace triptych {

/// Louvres across a tray; `width` along x.
MeshParts luminaire(double width, double depth);
MeshParts downlight();
MeshParts emergency_light();
/// Nested square cones with a box and a collar for a round duct above.
MeshParts square_diffuser(double size);
/// Slats in a frame, facing down, with a box of a height above.
MeshParts ceiling_grille(double width, double depth, double box);
MeshParts sprinkler();
MeshParts smoke_detector();
MeshParts loudspeaker();

/// A cable ladder along x with rungs, and some cables.
MeshParts cable_tray(double width, double length, int cables);
MeshParts cable_tray_bend(double width);
double cable_tray_bend_radius(double width);
MeshParts junction_box();

MeshParts double_socket();
MeshParts light_switch();
MeshParts thermostat();
MeshParts fire_extinguisher();
MeshParts distribution_board(double width, double height);
/// Bed-head trunking of a length along x, with outlets.
MeshParts supply_rail(double length);
/// With columns, valves and brackets; along x, against the wall.
MeshParts radiator(double length, double height);
MeshParts fan_coil(double length);

}  // namespace triptych
