#include "samples/smooth.hpp"

#include <array>
#include <cmath>
#include <map>

namespace triptych {

MeshPart with_smooth_normals(const MeshPart& part, double crease_degrees) {
  const double crease = std::cos(glm::radians(crease_degrees));
  const size_t triangles = part.indices.size() / 3;
  std::vector<glm::dvec3> facets;  // normals, as long as twice the area
  std::map<std::array<float, 3>, std::vector<size_t>> at_place;
  const auto position = [&](size_t corner) { return part.positions[part.indices[corner]]; };
  const auto place = [&](size_t corner) {
    const glm::vec3 p = position(corner);
    return std::array{p.x, p.y, p.z};
  };
  for (size_t i = 0; i < triangles; ++i) {
    const glm::dvec3 a(position(3 * i)), b(position(3 * i + 1)), c(position(3 * i + 2));
    facets.push_back(glm::cross(b - a, c - a));
    for (size_t k = 0; k < 3; ++k) at_place[place(3 * i + k)].push_back(i);
  }
  MeshPart smooth{.colour = part.colour, .positions = {}, .indices = {}, .alpha = part.alpha};
  for (size_t corner = 0; corner < 3 * triangles; ++corner) {
    const glm::dvec3 own = facets[corner / 3];
    glm::dvec3 sum(0);
    for (const size_t other : at_place[place(corner)]) {
      const glm::dvec3& facet = facets[other];
      if (glm::dot(own, facet) >= crease * glm::length(own) * glm::length(facet)) sum += facet;
    }
    const double length = glm::length(sum);
    smooth.positions.push_back(position(corner));
    smooth.normals.emplace_back(length > 0 ? sum / length : glm::dvec3(0, 1, 0));
    smooth.indices.push_back(static_cast<uint32_t>(corner));
    if (!part.vertex_colours.empty())
      smooth.vertex_colours.push_back(part.vertex_colours[part.indices[corner]]);
  }
  return smooth;
}

}  // namespace triptych
