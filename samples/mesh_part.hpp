// The triangles that scenes are made of.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace triptych {

/// Triangles of one colour. Positions in metres, y up.
struct MeshPart {
  glm::dvec3 colour{0.8};  ///< linear light, 0 to 1
  std::vector<glm::vec3> positions;
  std::vector<uint32_t> indices;
};

}  // namespace triptych
