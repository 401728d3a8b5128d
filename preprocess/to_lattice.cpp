#include "preprocess/to_lattice.hpp"

#include "scene/skeleton.hpp"
#include "simplify/surface.hpp"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <utility>

namespace triptych {

namespace {
bool has_area(const CornerTriangle& triangle, const glm::dmat3& linear) {
  const auto& [a, b, c] = triangle.corners;
  return glm::cross(linear * (b - a), linear * (c - a)) != glm::dvec3(0);
}
}  // namespace

ToLattice::ToLattice(const Affine& transform, const Lattice& lattice, std::span<const uint32_t> colors,
                     const VertexTint* tint, std::span<const SurfaceMaterial> materials)
    : transform_(transform),
      lattice_(lattice),
      colors_(colors),
      tint_(tint),
      materials_(materials),
      mirrors_(glm::determinant(glm::dmat3(transform)) < 0) {}

LatticeTriangle ToLattice::operator()(const CornerTriangle& triangle) const {
  LatticeTriangle result;
  for (size_t i = 0; i < 3; ++i)
    result.corners[i] = lattice_.nearest(transform_ * glm::dvec4(triangle.corners[i], 1));
  if (tint_) result.corner_colors = (*tint_)(triangle.colors, triangle.material);
  if (!materials_.empty() && materials_[colors_[triangle.material]].is_textured())
    result.coordinates = triangle.coordinates;
  if (mirrors_) {
    std::swap(result.coordinates[1], result.coordinates[2]);
    std::swap(result.corners[1], result.corners[2]);
    std::swap(result.corner_colors[1], result.corner_colors[2]);
  }
  const auto& [a, b, c] = result.corners;
  result.color =
      degenerate(a, b, c) && !has_area(triangle, glm::dmat3(transform_)) ? no_id : colors_[triangle.material];
  return result;
}

}  // namespace triptych
