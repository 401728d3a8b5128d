// Small bodies that the parts of services and furniture are put together from.
#pragma once

#include "samples/mesh_part.hpp"

#include <glm/glm.hpp>
#include <vector>

namespace triptych {

MeshPart part_of(const glm::dvec3& colour);
void add_box(MeshPart& part, const glm::dvec3& low, const glm::dvec3& high);
/// From one point to the other, closed, without rings between: its triangles are as long as it is.
void add_rod(MeshPart& part, const glm::dvec3& from, const glm::dvec3& to, double radius, size_t sides = 8);
/// A body turned around an axis (0 x, 1 y, 2 z) through the base. Its profile: how far along, and the radius
/// there, never 0.
void add_turned(MeshPart& part, const glm::dvec3& base, int axis, const std::vector<glm::dvec2>& profile,
                size_t sides);
/// A hollow round body along x.
void add_tube(MeshPart& part, double from, double to, double outer, double inner, size_t sides);
/// A rectangular frame along x, such as a flange.
void add_frame(MeshPart& part, double from, double to, const glm::dvec2& outer, const glm::dvec2& inner);
/// A ring around an axis through the centre.
void add_torus(MeshPart& part, const glm::dvec3& centre, int axis, double radius, double thickness,
               size_t around, size_t sides);

/// Steel rod with a nut at its foot, hanging down from a height to the origin's.
void add_hanger_rod(MeshPart& part, const glm::dvec3& foot, double length);

/// Sides of a round pipe, 8 to 16: as modellers of services have them.
size_t sides_of(double diameter);

}  // namespace triptych
