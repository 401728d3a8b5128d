// Chunks where they are placed: kept once they were read, and met by rays.
#pragma once

#include "scene/chunk.hpp"
#include "scene/pack.hpp"
#include "scene/poses.hpp"
#include "scene/section.hpp"

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <tsl/robin_map.h>

namespace triptych {

/// Keeps the chunks that were asked for last. For one thread; the pack must outlive it.
class ChunkShelf {
 public:
  explicit ChunkShelf(const Pack& pack) : pack_(pack) {}
  /// Error for a damaged chunk.
  std::shared_ptr<const Chunk> get(uint32_t number);

 private:
  const Pack& pack_;
  tsl::robin_map<uint32_t, std::shared_ptr<const Chunk>> chunks_;
  uint64_t kept_triangles_ = 0;
};

/// Points from + t · way, model space, with least <= t < most.
struct PlacedRay {
  glm::dvec3 from{0}, way{0};
  double least = 0, most = 0;
  std::optional<SectionPlane> entered = std::nullopt;  ///< the side of a section at which it begins
  double enters = 0;                                   ///< where it meets that side
};

/// The part of a ray from `least` on that a section keeps, up to infinity. Faces that lie in a side are
/// there, as on the screen.
PlacedRay kept_part(const glm::dvec3& from, const glm::dvec3& way, double least, const SectionSides& section);

/// Where a ray meets a chunk.
struct ChunkHit {
  double along = 0;  ///< t
  uint32_t triangle = 0;
  glm::dvec3 normal{0};  ///< of the surface there, against the ray; length 1
};

/// The nearest triangle of a placement that the ray meets. Where a section opens what is solid (a closed
/// surface, Skeleton::closed, whichever chunks it was divided among), the ray meets the cut surface at its
/// beginning, and the triangle is the back behind it: of the placement of that one's chunk. Reads chunks
/// where the ray meets their boxes. transform: the placement's in the frame.
std::optional<ChunkHit> meet(const PlacedRay& ray, const Skeleton& skeleton, const Placement& placement,
                             const Affine& transform, ChunkShelf& chunks);

/// Of a placement in a frame with these poses (poses_of()).
inline Affine placed_transform(const Skeleton& skeleton, const Poses* poses, const Placement& placement) {
  const Affine& always = skeleton.transforms[placement.transform];
  return poses ? poses->transform(placement.transform, always) : always;
}

/// A corner's position, model space.
inline glm::dvec3 placed_position(const Skeleton& skeleton, const Placement& placement,
                                  const Affine& transform, const Chunk& chunk, uint32_t vertex) {
  const Lattice& lattice = skeleton.lattices[skeleton.chunks[placement.chunk].lattice];
  const glm::dvec3 position = lattice.position(chunk.vertices[vertex].point);
  return placement.transform == 0 ? position : transform * glm::dvec4(position, 1);
}

}  // namespace triptych
