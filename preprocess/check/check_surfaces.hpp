// Nearest distances to the surfaces of an open pack, by Embree's point queries. Shares nothing with the
// build.
#pragma once

#include "scene/pack.hpp"

#include <glm/mat3x3.hpp>
#include <limits>
#include <memory>
#include <mutex>
#include <unordered_map>
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

  size_t triangle_count() const { return indices_.size() / 3; }
  const std::vector<glm::dvec3>& positions() const { return positions_; }
  const std::vector<uint32_t>& indices() const { return indices_; }

 private:
  RTCSceneTy* scene_;
  std::vector<glm::dvec3> positions_;  ///< in the chunk's space, exact
  std::vector<uint32_t> indices_;
  glm::dvec3 center_;
  double extent_;
  /// Of the tree's floats, a power of two near the extent, so that their squares are finite.
  double unit_ = 1;
};

/// The surfaces of a pack's drawables and of their sources. Safe to use from several threads; keeps the trees
/// that were used last. Error for a chunk that is damaged.
class PackSurfaces {
 public:
  explicit PackSurfaces(const Pack& pack);
  ~PackSurfaces();

  /// The distance to the finest leaf drawables below a scene node, and to one drawable. `floor` as above.
  double distance_to_source(SceneNodeId scene_node, const glm::dvec3& point, double floor) const;
  double distance_to_drawable(DrawableId drawable, const glm::dvec3& point, double floor) const;

  /// The placements of the finest leaf drawables below a scene node.
  std::vector<uint32_t> source_placements(SceneNodeId scene_node) const;
  std::shared_ptr<const ChunkTree> tree(uint32_t chunk) const;
  const Skeleton& skeleton() const { return pack_.skeleton(); }
  const Placing& placing(uint32_t transform) const { return placings_[transform]; }

 private:
  double nearest_placement(const Drawable& drawable, const glm::dvec3& point, double best,
                           double floor) const;

  struct Entry {
    std::shared_ptr<const ChunkTree> tree;
    uint64_t last_use = 0;
  };
  const Pack& pack_;
  RTCDeviceTy* device_;
  std::vector<Placing> placings_;
  std::vector<Box> placement_boxes_, node_boxes_;
  mutable std::mutex mutex_;
  mutable std::unordered_map<uint32_t, Entry> trees_;
  mutable uint64_t uses_ = 0, kept_triangles_ = 0;
};

}  // namespace triptych
