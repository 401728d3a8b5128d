#include "measure/pixel_hit.hpp"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>
#include <limits>

namespace triptych {

namespace {

struct Ray {
  glm::dvec3 origin, direction;  ///< of depth 1 along the view axis
};

Ray ray_through(const View& view, int x, int y) {
  const Camera& camera = view.camera;
  const glm::dmat3 axes = glm::transpose(view.rotation());  // eye to model
  const glm::dvec3 across = axes[0] * (camera.left + (x + 0.5) / view.focal_x()) +
                            axes[1] * (camera.bottom + (view.height - y - 0.5) / view.focal_y());
  if (camera.orthographic()) return {camera.eye + across, -axes[2]};
  return {camera.eye, across - axes[2]};
}

/// Along the ray; infinite where it misses (Möller and Trumbore, Fast, minimum storage ray/triangle
/// intersection, 1997).
double depth_of(const Ray& ray, const std::array<glm::dvec3, 3>& corners) {
  constexpr double miss = std::numeric_limits<double>::infinity();
  const glm::dvec3 first = corners[1] - corners[0], second = corners[2] - corners[0];
  const glm::dvec3 across = glm::cross(ray.direction, second);
  const double determinant = glm::dot(first, across);
  if (determinant == 0) return miss;
  const glm::dvec3 from = ray.origin - corners[0];
  const double u = glm::dot(from, across) / determinant;
  const glm::dvec3 turned = glm::cross(from, first);
  const double v = glm::dot(ray.direction, turned) / determinant;
  if (!(u >= 0 && v >= 0 && u + v <= 1)) return miss;
  return glm::dot(second, turned) / determinant;
}

}  // namespace

std::optional<PixelHit> hit_at(const Pack& pack, DrawableId drawable, const View& view, int x, int y) {
  const Skeleton& skeleton = pack.skeleton();
  const Drawable& drawn = skeleton.drawables[drawable];
  const Ray ray = ray_through(view, x, y);
  double nearest = std::numeric_limits<double>::infinity();
  std::optional<PixelHit> hit;
  for (uint32_t i = 0; i < drawn.placement_count; ++i) {
    const Placement& placement = skeleton.placements[drawn.first_placement + i];
    const Chunk chunk = pack.read_chunk(placement.chunk);
    const Lattice& lattice = skeleton.lattices[skeleton.chunks[placement.chunk].lattice];
    std::vector<glm::dvec3> positions;
    for (const ChunkVertex& vertex : chunk.vertices)
      positions.push_back(skeleton.transforms[placement.transform] *
                          glm::dvec4(lattice.position(vertex.point), 1));
    for (uint32_t triangle = 0; triangle < chunk.triangle_count(); ++triangle) {
      const uint32_t* const indices = chunk.indices.data() + size_t{3} * triangle;
      const double depth =
          depth_of(ray, {positions[indices[0]], positions[indices[1]], positions[indices[2]]});
      if (!(depth >= view.camera.near && depth < nearest)) continue;
      nearest = depth;
      hit = PixelHit{i, triangle};
    }
  }
  return hit;
}

}  // namespace triptych
