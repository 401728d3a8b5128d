// Parts of pipes and what belongs to them. Each runs along x from 0; a quarter bend is a corner at the
// origin, from -x to y; what sits on a pipe is centred there.
#pragma once

#include "samples/services/object_scene.hpp"

namespace triptych {

MeshParts pipe(const glm::dvec3& colour, double diameter, double length);
MeshParts pipe_elbow(const glm::dvec3& colour, double diameter);
double pipe_elbow_radius(double diameter);
/// A branch leaves along y.
MeshParts pipe_tee(const glm::dvec3& colour, double diameter, double branch);
/// A sleeve; of large pipes two flanges with bolts.
MeshParts pipe_joint(const glm::dvec3& colour, double diameter);
MeshParts pipe_insulation(double diameter, double length);
/// A ring around the pipe on one rod up along y.
MeshParts pipe_clamp(double diameter, double rod);
/// A ring around the pipe on a bracket from a wall behind it, towards -y.
MeshParts pipe_bracket(double diameter);
/// A rail of a length along z with two rods up.
MeshParts trapeze(double length, double rods);
/// With a hand wheel above.
MeshParts gate_valve(double diameter);
/// With a lever.
MeshParts ball_valve(double diameter);
MeshParts pressure_gauge();
/// Base at y = 0, pipes along x.
MeshParts pump(double size);
/// Stands on y = 0.
MeshParts tank(double diameter, double height);

}  // namespace triptych
