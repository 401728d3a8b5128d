// The surfaces of an open pack: nearest distances, and what lines meet first. Shares nothing with the build.
#pragma once

#include "preprocess/check/chunk_tree.hpp"
#include "scene/hidden_objects.hpp"
#include "scene/pack.hpp"

#include <array>
#include <memory>
#include <mutex>
#include <unordered_map>
#include <vector>

namespace triptych {

class PackSurfaces;

/// The trees that one thread has used last: who asks at many points need not share PackSurfaces' own list,
/// and wait for others, at each of them. For one thread; must not outlive the surfaces.
class HeldTrees {
 public:
  const ChunkTree& of(const PackSurfaces& surfaces, uint32_t chunk);

 private:
  struct Entry {
    uint32_t chunk = 0;
    std::shared_ptr<const ChunkTree> tree;
  };
  std::array<Entry, 64> entries_;
};

/// The surfaces of a pack's drawables and of their sources. Safe to use from several threads; keeps the trees
/// that were used last. Error for a chunk that is damaged.
class PackSurfaces {
 public:
  explicit PackSurfaces(const Pack& pack);
  ~PackSurfaces();

  /// The finest leaf drawable below a scene node that is nearest to a point, and how far it is.
  struct NearestSource {
    double distance;
    SceneNodeId leaf = no_id;
  };
  /// `without`: what is below this one does not count, nor what is hidden.
  NearestSource nearest_source(SceneNodeId scene_node, const glm::dvec3& point, double floor,
                               HeldTrees* held = nullptr, SceneNodeId without = no_id,
                               const HiddenObjects* hidden = nullptr) const;
  /// The distance to the finest leaf drawables below a scene node, and to one drawable. `floor`: as
  /// ChunkTree::distance has it.
  double distance_to_source(SceneNodeId scene_node, const glm::dvec3& point, double floor,
                            HeldTrees* held = nullptr) const {
    return nearest_source(scene_node, point, floor, held).distance;
  }
  double distance_to_drawable(DrawableId drawable, const glm::dvec3& point, double floor,
                              HeldTrees* held = nullptr, const HiddenObjects* hidden = nullptr) const;

  /// Where a line first meets what is not hidden of a drawable; as ChunkTree::first_hit.
  struct Hit {
    double along = 0;
    uint32_t placement = 0;  ///< of the drawable's, counted from its first one
    uint32_t triangle = 0;   ///< of the chunk that it places
    uint32_t color = 0;      ///< of the triangle: index into the palette
  };
  std::optional<Hit> first_hit(DrawableId drawable, const glm::dvec3& origin, const glm::dvec3& direction,
                               double from, const HiddenObjects* hidden = nullptr) const;

  /// Whether nobody outside sees the point, or sees something else about there: by the finest leaf drawables
  /// of the whole model, of lines in 26 directions all but one at most meet something further than `from`
  /// from it, model units; or one of them comes within `reach` to what is not below the scene node before it
  /// meets anything else, or that lies as near as `from`.
  bool is_enclosed(SceneNodeId scene_node, const glm::dvec3& point, double from, double reach) const;

  /// The placements of the finest leaf drawables below a scene node.
  std::vector<uint32_t> source_placements(SceneNodeId scene_node) const;
  std::shared_ptr<const ChunkTree> tree(uint32_t chunk) const;
  const Skeleton& skeleton() const { return pack_.skeleton(); }
  const Placing& placing(uint32_t transform) const { return placings_[transform]; }

 private:
  /// Adds the children of a scene node that a line may meet, the nearest last.
  void open_children(SceneNodeId id, const glm::dvec3& origin, const glm::dvec3& direction,
                     std::vector<SceneNodeId>& open) const;
  bool meets_source(const glm::dvec3& origin, const glm::dvec3& direction, double from) const;
  /// Whether what a line meets first, up to `reach`, is not below the scene node.
  bool meets_another(SceneNodeId scene_node, const glm::dvec3& origin, const glm::dvec3& direction,
                     double from, double reach) const;
  double nearest_placement(const Drawable& drawable, const glm::dvec3& point, double best, double floor,
                           HeldTrees* held, const HiddenObjects* hidden) const;

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
