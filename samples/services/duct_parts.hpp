// Parts of ventilation ducts. Each runs along x from 0, its height along y; a quarter bend is a corner at the
// origin, from -x to y.
#pragma once

#include "samples/services/object_scene.hpp"

namespace triptych {

/// A straight piece with a flange at each end.
MeshParts rectangular_duct(const glm::dvec3& colour, double width, double height, double length);
/// Turns within its width, which lies along y here.
MeshParts rectangular_bend(const glm::dvec3& colour, double width, double height);
double rectangular_bend_radius(double width);
MeshParts rectangular_reducer(const glm::dvec3& colour, double width, double height, double to_width,
                              double length);
MeshParts duct_end_cap(const glm::dvec3& colour, double width, double height);
/// Hangs below a duct, from y = 0 down to -height; a branch leaves along x through its side.
MeshParts duct_take_off(const glm::dvec3& colour, double width, double height);
/// The wool around a straight piece.
MeshParts duct_insulation(double width, double height, double length);
/// A rail below the origin on two threaded rods of a length.
MeshParts duct_hanger(double width, double rods);

MeshParts round_duct(const glm::dvec3& colour, double diameter, double length);
MeshParts round_bend(const glm::dvec3& colour, double diameter);
double round_bend_radius(double diameter);
MeshParts round_coupling(const glm::dvec3& colour, double diameter);
/// 0.4 m along x, with a branch to z.
MeshParts round_tee(const glm::dvec3& colour, double diameter, double branch);
MeshParts round_end_cap(const glm::dvec3& colour, double diameter);
/// A strap around the duct and one rod.
MeshParts duct_strap(double diameter, double rod);
/// Corrugated, straight.
MeshParts flexible_duct(double diameter, double length);

/// Controls the flow: from a rectangular duct at x = 0 to a round one at x = 0.9.
MeshParts volume_box(const glm::dvec3& colour, double width, double height, double diameter);
MeshParts fire_damper(const glm::dvec3& colour, double width, double height);
MeshParts silencer(const glm::dvec3& colour, double width, double height, double length);

}  // namespace triptych
