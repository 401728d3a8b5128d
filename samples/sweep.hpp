// Bodies that an outline makes when it moves: pipes, ducts and their bends, turned and tapered bodies.
#pragma once

#include "samples/mesh_part.hpp"

#include <glm/glm.hpp>
#include <vector>

namespace triptych {

/// The corners of a convex polygon, counter-clockwise for who looks against the direction of travel.
using Outline = std::vector<glm::dvec3>;

/// Joins outlines of equally many corners, and closes both ends: one closed surface, outward.
void add_lofted(MeshPart& part, const std::vector<Outline>& outlines);
/// Joins the last outline to the first instead: a ring, or a hollow body whose inside is travelled backwards.
void add_looped(MeshPart& part, const std::vector<Outline>& outlines);

/// Where an outline is, and how it is turned: u × v is the direction of travel; both of length 1.
struct SweepFrame {
  glm::dvec3 centre{0}, u{0, 1, 0}, v{0, 0, 1};
};
/// Corners in u and v, counter-clockwise.
using Profile = std::vector<glm::dvec2>;

Profile circle_profile(double radius, size_t sides);
/// `width` along u, `height` along v.
Profile rectangle_profile(double width, double height);
Outline placed_outline(const SweepFrame& frame, const Profile& profile);

/// Along x, from 0 to `length`.
std::vector<SweepFrame> straight_frames(double length);
/// A quarter circle that comes along x from (-radius, 0, 0) and leaves along y at (0, radius, 0), around the
/// corner at the origin, in so many steps.
std::vector<SweepFrame> bend_frames(double radius, size_t steps);

void add_solid(MeshPart& part, const std::vector<SweepFrame>& frames, const Profile& profile);
/// Two walls and both rims; the profiles have equally many corners.
void add_hollow(MeshPart& part, const std::vector<SweepFrame>& frames, const Profile& outer,
                const Profile& inner);

/// A circle of a round body, square to the body's line.
struct Ring {
  glm::dvec3 centre;
  double radius;
};
/// Circles of corners around the rings, joined, and closed at both ends.
void add_round(MeshPart& part, const std::vector<Ring>& rings, size_t sides);

}  // namespace triptych
