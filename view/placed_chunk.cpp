#include "view/placed_chunk.hpp"

#include "scene/affine.hpp"
#include "scene/ray.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <utility>
#include <vector>

namespace triptych {

namespace {
constexpr uint64_t most_kept_triangles = 500'000;
constexpr double infinite = std::numeric_limits<double>::infinity();
}  // namespace

PlacedRay kept_part(const glm::dvec3& from, const glm::dvec3& way, double least,
                    const SectionSides& section) {
  constexpr double in_a_side = 1e-6;  // of the distance
  PlacedRay ray{from, way, least, infinite};
  for (const SectionPlane& side : section.all()) {
    const double at_start = side.distance(from), slope = glm::dot(side.normal, way);
    const double along = -at_start / slope;
    if (slope > 0 && along > ray.least) {
      ray.least = along * (1 - in_a_side);
      ray.entered = side;
      ray.enters = along;
    } else if (slope < 0) {
      ray.most = std::min(ray.most, along * (1 + in_a_side));
    } else if (slope == 0 && at_start < 0) {
      ray.most = -infinite;
    }
  }
  return ray;
}

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
  const std::vector<bool> outward = ray.entered ? chunk->outward() : std::vector<bool>();
  std::optional<ChunkHit> found;
  double nearest = ray.most;
  // Backs less fronts of what is solid, from where the ray comes in; and the nearest of the backs.
  int winding = 0;
  std::pair<double, uint32_t> back{infinite, 0};
  for (uint32_t i = 0; i < chunk->triangle_count(); ++i) {
    const auto corner = [&](size_t k) {
      return glm::dvec3(chunk->vertices[chunk->indices[3 * i + k]].point);
    };
    const auto hit = meet_triangle(from, way, corner(0), corner(1), corner(2));
    if (!hit || hit->along < ray.least) continue;
    if (ray.entered && outward[i]) {
      const bool is_back = glm::dot(glm::cross(corner(1) - corner(0), corner(2) - corner(0)), way) > 0;
      winding += is_back ? 1 : -1;
      if (is_back) back = std::min(back, {hit->along, i});
    }
    if (hit->along >= nearest) continue;
    nearest = hit->along;
    const glm::dvec3 across =
        glm::normalize(glm::cross(linear * (corner(1) - corner(0)), linear * (corner(2) - corner(0))));
    found = ChunkHit{nearest, i, glm::dot(across, ray.way) > 0 ? -across : across};
  }
  if (winding > 0 && ray.enters < ray.most) return ChunkHit{ray.enters, back.second, -ray.entered->normal};
  return found;
}

}  // namespace triptych
