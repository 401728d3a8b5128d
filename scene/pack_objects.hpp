// The source objects of an open pack: what they are called, and which scene nodes show them.
#pragma once

#include "scene/skeleton.hpp"
#include "scene/stored_objects.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace triptych {

/// What placements of a leaf belong to, as stored: ids of objects count from the first one (object_in()).
struct LeafRuns {
  std::span<const ObjectRun> runs;
  SourceObjectId first_object = no_id;
};

/// In ids of the expanded skeleton. A scene node shows several objects, and an object is shown by several
/// scene nodes; leaves show objects placement by placement, inner scene nodes those of their leaves.
class PackObjects {
 public:
  /// Of a pack without objects. The skeleton must outlive it.
  explicit PackObjects(const Skeleton& skeleton) : PackObjects({}, skeleton, "") {}
  /// Error (place) where the section does not fit the skeleton.
  PackObjects(StoredObjects stored, const Skeleton& skeleton, const std::string& place);

  const SourceObjects& source() const { return source_; }
  /// The leaves with a placement of the object, ascending.
  std::span<const SceneNodeId> nodes_of(SourceObjectId object) const;
  /// The objects of the leaves below a scene node, or its own, ascending, each once.
  std::vector<SourceObjectId> objects_below(SceneNodeId node) const;
  /// Over the placements of each of a leaf's drawables; empty for an inner scene node, and for a leaf of no
  /// object.
  std::vector<ObjectRun> runs_of(SceneNodeId leaf) const;
  /// The same without a copy, for callers that look at many.
  LeafRuns stored_runs_of(SceneNodeId leaf) const;
  /// The object of a triangle of a drawable: of its `placement`, counted from the drawable's first one, the
  /// `triangle` of the chunk. no_id where it belongs to none.
  SourceObjectId object_at(DrawableId drawable, uint32_t placement, uint32_t triangle) const;

 private:
  /// A hierarchy in one of its places: what ids there count from.
  struct Place {
    SceneNodeId first_scene_node = 0;
    SceneNodeId end_scene_node = 0;
    DrawableId first_drawable = 0, end_drawable = 0;
    uint32_t hierarchy = 0;  ///< index into hierarchies_
    SourceObjectId first_object = 0;
  };
  void find_places(const std::string& place);
  uint64_t check_hierarchy(const Place& place, const std::string& name) const;
  void check_places(const std::string& name) const;
  const Place* place_of(SceneNodeId node) const;
  void index_nodes();
  template <typename Take>
  void each_leaf(const Take& take) const;

  const Skeleton& skeleton_;
  SourceObjects source_;
  std::vector<HierarchyObjects> hierarchies_;
  std::vector<Place> places_;          ///< ascending by scene node
  std::vector<uint32_t> first_nodes_;  ///< for each object, and the end: index into nodes_
  std::vector<SceneNodeId> nodes_;
};

}  // namespace triptych
