// Meshes that are round by the normals of their vertices.
#pragma once

#include "model/model.hpp"

#include <glm/geometric.hpp>
#include <utility>

namespace triptych::test {

/// The mesh with shading normals: at each vertex the mean of those of all facets there, by area.
inline Mesh smoothed(Mesh mesh) {
  std::vector<glm::dvec3> sums(mesh.positions.size(), glm::dvec3(0));
  for (const Triangle& triangle : mesh.triangles) {
    const auto& [a, b, c] = triangle.vertices;
    const glm::dvec3 facet =
        glm::cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]);
    for (const uint32_t vertex : triangle.vertices) sums[vertex] += facet;
  }
  mesh.normals.clear();
  for (const glm::dvec3& sum : sums) mesh.normals.push_back(to_vertex_normal(sum));
  return mesh;
}

}  // namespace triptych::test
