// The triangles that scenes are made of.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace triptych {

/// Triangles of one material. Positions in metres, y up.
struct MeshPart {
  glm::dvec3 colour{0.8};  ///< linear light, 0 to 1
  std::vector<glm::vec3> positions;
  std::vector<uint32_t> indices;
  double alpha = 1;  ///< by how much it covers what lies behind
  /// Of positions, linear, red, green, blue and 255; multiplied by the colour. Empty if they have none.
  std::vector<std::array<uint8_t, 4>> vertex_colours = {};
  /// Shading normals of positions, of unit length. Empty if they have none.
  std::vector<glm::vec3> normals = {};
  /// Of positions, on the images below, from their upper left corners; empty if it has none.
  std::vector<glm::vec2> texture_places = {};
  std::string texture = {};  ///< file of an image that the colour is multiplied by, beside the scene's
  bool cut_out = false;      ///< where the image's alpha is less than a half, there is nothing
  glm::dvec3 emission{0};    ///< light of its own
  std::string emission_texture = {};  ///< file of an image that that is multiplied by
};

}  // namespace triptych
