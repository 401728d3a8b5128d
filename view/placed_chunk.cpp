#include "view/placed_chunk.hpp"

#include "scene/affine.hpp"
#include "scene/ray.hpp"

#include <algorithm>
#include <array>
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

namespace {

/// A ray on the lattice of a chunk, where lengths along it are the same.
struct LatticeRay {
  glm::dvec3 from, way;
};

/// What a ray passes from where it comes in, of a closed surface: backs less fronts, and the nearest back.
struct Passed {
  int winding = 0;
  double along = infinite;
  uint32_t chunk = no_id, triangle = 0;
};

std::array<glm::dvec3, 3> corners_of(const Chunk& chunk, uint32_t triangle) {
  const auto corner = [&](size_t k) {
    return glm::dvec3(chunk.vertices[chunk.indices[size_t{3} * triangle + k]].point);
  };
  return {corner(0), corner(1), corner(2)};
}

void pass(const LatticeRay& ray, double least, const ClosedRun& run, const Chunk& chunk, Passed& passed) {
  for (uint32_t i = run.first_triangle; i < run.first_triangle + run.triangle_count; ++i) {
    const auto [a, b, c] = corners_of(chunk, i);
    const auto hit = meet_triangle(ray.from, ray.way, a, b, c);
    if (!hit || hit->along < least) continue;
    const bool is_back = glm::dot(glm::cross(b - a, c - a), ray.way) > 0;
    passed.winding += is_back ? 1 : -1;
    if (!is_back || hit->along >= passed.along) continue;
    passed.along = hit->along;
    passed.chunk = run.chunk;
    passed.triangle = i;
  }
}

/// The cut surface that the chunk shows: the back behind it is the chunk's.
std::optional<ChunkHit> meet_cap(const PlacedRay& ray, const LatticeRay& on_lattice, const Skeleton& skeleton,
                                 const Placement& placement, ChunkShelf& chunks) {
  if (!ray.entered || !(ray.enters < ray.most)) return std::nullopt;
  const ClosedSurfaces& closed = skeleton.closed;
  const auto cap_of = [&](std::span<const ClosedRun> runs) -> std::optional<ChunkHit> {
    Passed passed;
    for (const ClosedRun& run : runs) {
      const LatticeBox& box = skeleton.chunks[run.chunk].box;
      const RaySpan span(on_lattice.from, on_lattice.way, ray.least, infinite);
      if (!span.meets({glm::dvec3(box.lo), glm::dvec3(box.hi)})) continue;
      pass(on_lattice, ray.least, run, *chunks.get(run.chunk), passed);
    }
    if (passed.winding <= 0 || passed.chunk != placement.chunk) return std::nullopt;
    return ChunkHit{ray.enters, passed.triangle, -ray.entered->normal};
  };
  const ClosedRun alone{placement.chunk, 0, closed.in_chunk(placement.chunk), 0};
  if (const auto hit = cap_of({&alone, 1})) return hit;
  for (const uint32_t run : closed.runs_in(placement.chunk)) {
    const DividedBody& body = closed.bodies[closed.runs[run].body];
    if (const auto hit = cap_of(std::span(closed.runs).subspan(body.first_run, body.run_count))) return hit;
  }
  return std::nullopt;
}

}  // namespace

std::optional<ChunkHit> meet(const PlacedRay& ray, const Skeleton& skeleton, const Placement& placement,
                             const Affine& transform, ChunkShelf& chunks) {
  const ChunkInfo& info = skeleton.chunks[placement.chunk];
  const Lattice& lattice = skeleton.lattices[info.lattice];
  const Box placed = placed_box(transform, lattice.box(info.box));
  // The back behind a cut surface may be cut away.
  if (!RaySpan(ray.from, ray.way, ray.least, ray.entered ? infinite : ray.most).meets(placed))
    return std::nullopt;
  const glm::dmat3 linear(transform);
  if (glm::determinant(linear) == 0) return std::nullopt;  // it is flat, and has no area to be seen
  const glm::dmat3 inverse = glm::inverse(linear);
  const LatticeRay on_lattice{(inverse * (ray.from - transform[3]) - lattice.origin) / lattice.step,
                              inverse * ray.way / lattice.step};
  if (const auto cap = meet_cap(ray, on_lattice, skeleton, placement, chunks)) return cap;
  if (!RaySpan(ray.from, ray.way, ray.least, ray.most).meets(placed)) return std::nullopt;
  const std::shared_ptr<const Chunk> chunk = chunks.get(placement.chunk);
  std::optional<ChunkHit> found;
  double nearest = ray.most;
  for (uint32_t i = 0; i < chunk->triangle_count(); ++i) {
    const auto [a, b, c] = corners_of(*chunk, i);
    const auto hit = meet_triangle(on_lattice.from, on_lattice.way, a, b, c);
    if (!hit || hit->along < ray.least || hit->along >= nearest) continue;
    nearest = hit->along;
    const glm::dvec3 across = glm::normalize(glm::cross(linear * (b - a), linear * (c - a)));
    found = ChunkHit{nearest, i, glm::dot(across, ray.way) > 0 ? -across : across};
  }
  return found;
}

}  // namespace triptych
