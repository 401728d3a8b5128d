#include "view/placed_chunk.hpp"

#include "scene/affine.hpp"
#include "scene/ray.hpp"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace triptych {

namespace {
constexpr uint64_t most_kept_triangles = 500'000;
}  // namespace

std::shared_ptr<const Chunk> ChunkShelf::get(uint32_t number) {
  const auto known = chunks_.find(number);
  if (known != chunks_.end()) return known->second;
  if (kept_triangles_ > most_kept_triangles) {
    chunks_.clear();
    kept_triangles_ = 0;
  }
  auto read = std::make_shared<const Chunk>(pack_.read_chunk(number));
  kept_triangles_ += read->triangle_count();
  return chunks_.emplace(number, std::move(read)).first->second;
}

std::optional<ChunkHit> meet(const PlacedRay& ray, const Skeleton& skeleton, const Placement& placement,
                             ChunkShelf& chunks) {
  const Affine& transform = skeleton.transforms[placement.transform];
  const ChunkInfo& info = skeleton.chunks[placement.chunk];
  const Lattice& lattice = skeleton.lattices[info.lattice];
  const RaySpan span(ray.from, ray.way, ray.least, ray.most);
  if (!span.meets(placed_box(transform, lattice.box(info.box)))) return std::nullopt;
  const glm::dmat3 linear(transform);
  if (glm::determinant(linear) == 0) return std::nullopt;  // it is flat, and has no area to be seen
  // On the chunk's own lattice, where lengths along the ray are the same.
  const glm::dmat3 inverse = glm::inverse(linear);
  const glm::dvec3 from = (inverse * (ray.from - transform[3]) - lattice.origin) / lattice.step;
  const glm::dvec3 way = inverse * ray.way / lattice.step;
  const std::shared_ptr<const Chunk> chunk = chunks.get(placement.chunk);
  std::optional<ChunkHit> found;
  double nearest = ray.most;
  for (uint32_t i = 0; i < chunk->triangle_count(); ++i) {
    const auto corner = [&](size_t k) {
      return glm::dvec3(chunk->vertices[chunk->indices[3 * i + k]].point);
    };
    const auto hit = meet_triangle(from, way, corner(0), corner(1), corner(2));
    if (!hit || hit->along < ray.least || hit->along >= nearest) continue;
    nearest = hit->along;
    found = ChunkHit{nearest, i};
  }
  return found;
}

}  // namespace triptych
