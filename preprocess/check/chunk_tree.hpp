// The triangles of one chunk of a pack with a search tree over them (Embree): nearest distances, and where
// lines first meet them. Shares nothing with the build.
#pragma once

#include "scene/chunk.hpp"

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

struct RTCDeviceTy;
struct RTCSceneTy;

namespace triptych {

/// Distance from a point to a triangle, which may be degenerate.
double distance_to_triangle(const glm::dvec3& point, const glm::dvec3& a, const glm::dvec3& b,
                            const glm::dvec3& c);

/// A transform with what a search in its chunk's own space needs.
struct Placing {
  explicit Placing(const Affine& transform);
  Affine transform;
  glm::dmat3 linear, inverse;
  double stretch;  ///< a distance in model space is at most this much longer in the chunk's space; infinite
                   ///< if singular
};

/// A chunk's triangles with a search tree over them.
class ChunkTree {
 public:
  ChunkTree(RTCDeviceTy* device, const Chunk& chunk, const Lattice& lattice);
  ~ChunkTree();
  ChunkTree(const ChunkTree&) = delete;
  ChunkTree& operator=(const ChunkTree&) = delete;

  /// The least of `best` and the distance from the point (model space) to the placed chunk. Where it is at
  /// most `floor`, any value up to `floor` may be returned.
  double distance(const Placing& placing, const glm::dvec3& point, double best, double floor) const;

  /// Where a line meets the placed chunk.
  struct Hit {
    double along = 0;       ///< the point is origin + along · direction
    uint32_t triangle = 0;  ///< index into the chunk's triangles
  };
  /// The first one at `from` or beyond; nullopt where there is none, and for a placing that flattens space.
  /// origin and direction: model space, direction of any length but 0.
  std::optional<Hit> first_hit(const Placing& placing, const glm::dvec3& origin, const glm::dvec3& direction,
                               double from) const;

  size_t triangle_count() const { return indices_.size() / 3; }
  const std::vector<glm::dvec3>& positions() const { return positions_; }
  const std::vector<uint32_t>& indices() const { return indices_; }
  /// Index into the palette.
  uint32_t color(uint32_t triangle) const { return colors_[triangle]; }

 private:
  RTCSceneTy* scene_;
  std::vector<glm::dvec3> positions_;  ///< in the chunk's space, exact
  std::vector<uint32_t> indices_;
  std::vector<uint32_t> colors_;  ///< by triangle
  glm::dvec3 center_;
  double extent_;
  /// Of the tree's floats, a power of two near the extent, so that their squares are finite.
  double unit_ = 1;
};

}  // namespace triptych
