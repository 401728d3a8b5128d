// What a model's placed triangles look like from outside: corners, box, colours.
#pragma once

#include "import_support.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <utility>
#include <vector>

namespace triptych::test {

/// A triangle in the model's space, and its colour.
struct PlacedTriangle {
  std::array<glm::dvec3, 3> corners;
  glm::vec4 color;
};

inline std::vector<PlacedTriangle> placed_triangles(const Model& model) {
  std::vector<PlacedTriangle> placed;
  for (const Instance& instance : model.instances) {
    for (const CornerTriangle& triangle : triangles_of(model.meshes[instance.mesh])) {
      PlacedTriangle result{{}, model.materials[triangle.material].base_color};
      for (size_t i = 0; i < 3; ++i)
        result.corners[i] = instance.transform * glm::dvec4(triangle.corners[i], 1);
      placed.push_back(result);
    }
  }
  return placed;
}

using Box = std::pair<glm::dvec3, glm::dvec3>;

inline Box box_of(const Model& model) {
  Box box{glm::dvec3(std::numeric_limits<double>::max()), glm::dvec3(std::numeric_limits<double>::lowest())};
  for (const PlacedTriangle& triangle : placed_triangles(model)) {
    for (const glm::dvec3& corner : triangle.corners)
      box = {glm::min(box.first, corner), glm::max(box.second, corner)};
  }
  return box;
}

inline void expect_box(const Model& model, const glm::dvec3& low, const glm::dvec3& high,
                       double tolerance = 1e-6) {
  const Box box = box_of(model);
  const auto& [x, y, z] = std::tuple(box.first.x, box.first.y, box.first.z);
  EXPECT_LT(glm::length(box.first - low), tolerance) << x << " " << y << " " << z;
  EXPECT_LT(glm::length(box.second - high), tolerance)
      << box.second.x << " " << box.second.y << " " << box.second.z;
}

}  // namespace triptych::test
