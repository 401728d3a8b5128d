#include "samples/services/part_tools.hpp"

#include "samples/solids.hpp"
#include "samples/sweep.hpp"

#include <cmath>
#include <glm/gtc/constants.hpp>

namespace triptych {

MeshPart part_of(const glm::dvec3& colour) {
  MeshPart part;
  part.colour = colour;
  return part;
}

void add_box(MeshPart& part, const glm::dvec3& low, const glm::dvec3& high) {
  append(part, box(low, high, part.colour));
}

void add_rod(MeshPart& part, const glm::dvec3& from, const glm::dvec3& to, double radius, size_t sides) {
  add_round(part, {{from, radius}, {to, radius}}, sides);
}

void add_turned(MeshPart& part, const glm::dvec3& base, int axis, const std::vector<glm::dvec2>& profile,
                size_t sides) {
  std::vector<Ring> rings;
  for (const glm::dvec2& step : profile) {
    glm::dvec3 centre = base;
    centre[axis] += step.x;
    rings.push_back({centre, step.y});
  }
  add_round(part, rings, sides);
}

namespace {

std::vector<SweepFrame> frames_between(double from, double to) {
  std::vector<SweepFrame> frames = straight_frames(to - from);
  for (SweepFrame& frame : frames) frame.centre.x += from;
  return frames;
}

}  // namespace

void add_tube(MeshPart& part, double from, double to, double outer, double inner, size_t sides) {
  add_hollow(part, frames_between(from, to), circle_profile(outer, sides), circle_profile(inner, sides));
}

void add_frame(MeshPart& part, double from, double to, const glm::dvec2& outer, const glm::dvec2& inner) {
  add_hollow(part, frames_between(from, to), rectangle_profile(outer.x, outer.y),
             rectangle_profile(inner.x, inner.y));
}

void add_torus(MeshPart& part, const glm::dvec3& centre, int axis, double radius, double thickness,
               size_t around, size_t sides) {
  glm::dvec3 normal(0), first(0);
  normal[axis] = 1;
  first[(axis + 1) % 3] = 1;
  const glm::dvec3 second = glm::cross(normal, first);
  std::vector<Outline> outlines;
  for (size_t i = 0; i < around; ++i) {
    const double turn = glm::two_pi<double>() * static_cast<double>(i) / static_cast<double>(around);
    const glm::dvec3 out = std::cos(turn) * first + std::sin(turn) * second;
    // Travelled along normal × out.
    outlines.push_back(
        placed_outline({centre + radius * out, normal, out}, circle_profile(thickness, sides)));
  }
  add_looped(part, outlines);
}

void add_hanger_rod(MeshPart& part, const glm::dvec3& foot, double length) {
  constexpr double rod = 0.006, nut = 0.011;
  add_rod(part, foot, foot + glm::dvec3(0, length, 0), rod, 6);
  add_rod(part, foot + glm::dvec3(0, 0.012, 0), foot + glm::dvec3(0, 0.024, 0), nut, 6);
}

size_t sides_of(double diameter) { return diameter < 0.018 ? 8 : diameter < 0.035 ? 12 : 16; }

}  // namespace triptych
