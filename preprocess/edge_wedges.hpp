// Which triangles around an edge bound the same solid there.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <utility>
#include <vector>

namespace triptych {

/// A triangle at an edge from `low` to `high`: its third corner, and which way it passes the edge.
struct EdgeTriangle {
  glm::ivec3 apex;
  bool forward = false;  ///< from low to high
  uint32_t number = 0;
};

/// Around an edge, solids are wedges: each lies between the backs of two triangles with nothing in between.
/// The numbers of those pairs; triangles that bound no such wedge are in none, nor are such of which several
/// lie upon each other: what is found does not depend on their order. Where two solids touch in a face, their
/// triangles lie in one plane, back to back, and each belongs to its own. Exact, for coordinates within
/// ±2^29. Sorts `triangles` around the edge.
std::vector<std::pair<uint32_t, uint32_t>> wedges_at(const glm::ivec3& low, const glm::ivec3& high,
                                                     std::span<EdgeTriangle> triangles);

}  // namespace triptych
