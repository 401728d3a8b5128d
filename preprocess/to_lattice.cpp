#include "preprocess/to_lattice.hpp"

#include "scene/skeleton.hpp"
#include "simplify/surface.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <utility>

namespace triptych {

namespace {
bool has_area(const CornerTriangle& triangle, const glm::dmat3& linear) {
  const auto& [a, b, c] = triangle.corners;
  return glm::cross(linear * (b - a), linear * (c - a)) != glm::dvec3(0);
}

uint32_t palette_index(const MeshColors& colors, const CornerTriangle& triangle) {
  if (colors.flat == nullptr) return colors.materials[triangle.material];
  return colors.flat->at(colors.tint->flat(triangle.colors, triangle.material).value());
}
}  // namespace

glm::dmat3 normal_matrix(const glm::dmat3& linear) {
  const glm::dmat3 cofactors(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                             glm::cross(linear[0], linear[1]));
  return glm::determinant(linear) < 0 ? -cofactors : cofactors;
}

CornerNormals placed_normals(const CornerNormals& normals, const glm::dmat3& normal_matrix) {
  if (!std::ranges::all_of(normals, has_normal)) return {};
  CornerNormals placed;
  for (size_t i = 0; i < placed.size(); ++i)
    placed[i] = to_vertex_normal(normal_matrix * direction_of(normals[i]));
  return std::ranges::all_of(placed, has_normal) ? placed : CornerNormals{};
}

ToLattice::ToLattice(const Affine& transform, const Lattice& lattice, const MeshColors& colors)
    : transform_(transform),
      lattice_(lattice),
      colors_(colors),
      mirrors_(glm::determinant(glm::dmat3(transform)) < 0),
      of_normals_(normal_matrix(glm::dmat3(transform))) {}

LatticeTriangle ToLattice::operator()(const CornerTriangle& triangle) const {
  LatticeTriangle result;
  for (size_t i = 0; i < 3; ++i)
    result.corners[i] = lattice_.nearest(transform_ * glm::dvec4(triangle.corners[i], 1));
  if (colors_.of_corners()) result.corner_colors = (*colors_.tint)(triangle.colors, triangle.material);
  result.corner_normals = placed_normals(triangle.normals, of_normals_);
  if (!colors_.surfaces.empty() && colors_.surfaces[colors_.materials[triangle.material]].is_textured())
    result.coordinates = triangle.coordinates;
  result.light = triangle.light;
  if (mirrors_) {
    std::swap(result.corners[1], result.corners[2]);
    std::swap(result.corner_colors[1], result.corner_colors[2]);
    std::swap(result.corner_normals[1], result.corner_normals[2]);
    std::swap(result.coordinates[1], result.coordinates[2]);
    std::swap(result.light[1], result.light[2]);
  }
  const auto& [a, b, c] = result.corners;
  result.color = degenerate(a, b, c) && !has_area(triangle, glm::dmat3(transform_))
                     ? no_id
                     : palette_index(colors_, triangle);
  return result;
}

}  // namespace triptych
