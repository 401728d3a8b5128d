// A set of hidden source objects, applied to the scene nodes of one pack.
#pragma once

#include "scene/hiding.hpp"
#include "scene/pack_objects.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace triptych {

/// Ids, ascending, each once.
using ObjectSet = std::vector<SourceObjectId>;

/// These and all that is in them (SourceObject::parent). In any order, also several times.
ObjectSet with_contents(const SourceObjects& source, std::span<const SourceObjectId> objects);
/// All the others.
ObjectSet all_but(const SourceObjects& source, const ObjectSet& objects);
/// In either.
ObjectSet united(const ObjectSet& one, const ObjectSet& other);

/// How much of what a scene node shows is hidden.
enum class HiddenShare : uint8_t { nothing, some, all };

/// Placements of a drawable, one after the other, counted from its first one.
struct PlacementRun {
  uint32_t first = 0, end = 0;
  bool operator==(const PlacementRun&) const = default;
};

/// Made once for each set that a person makes, and the same for all frames that name it; then any number of
/// threads may ask it. What belongs to no object is never hidden.
class HiddenObjects {
 public:
  /// The skeleton must outlive it. Error (place) where the ids are not ascending, or not of this pack. Takes
  /// time for each object and each leaf that shows one, and sets all scene nodes to a number.
  HiddenObjects(const Skeleton& skeleton, const PackObjects& of_pack, ObjectSet objects,
                const std::string& place);

  const ObjectSet& objects() const { return objects_; }
  HiddenShare share(SceneNodeId node) const {
    return marks_[node] == shown  ? HiddenShare::nothing
           : marks_[node] == gone ? HiddenShare::all
                                  : HiddenShare::some;
  }
  /// The hidden placements of each drawable of a leaf, ascending; empty unless the leaf's share is `some`.
  std::span<const PlacementRun> hidden_placements(SceneNodeId leaf) const;
  bool hides(SceneNodeId leaf, uint32_t placement) const;
  /// Whether the box, on the model's lattice, meets the box of a leaf of which something is hidden. Goes down
  /// the hierarchy where both meet, and no further than to the first such leaf.
  bool touches(const LatticeBox& box) const;

 private:
  /// Of a scene node's mark; a leaf of which some is hidden has its place in leaves_ instead, behind these.
  static constexpr uint32_t shown = 0, gone = 1, mixed = 2, first_leaf = 3;

  void mark_leaves(const PackObjects& of_pack);
  void mark_leaf(const PackObjects& of_pack, SceneNodeId leaf, const std::vector<bool>& is_hidden);
  void mark_parents(const std::vector<SceneNodeId>& leaves);

  const Skeleton& skeleton_;
  ObjectSet objects_;
  std::vector<uint32_t> marks_;  ///< of each scene node
  std::vector<uint32_t> ends_;   ///< of each leaf of which some is hidden: in runs_
  std::vector<PlacementRun> runs_;
};

/// As the frame state has it; for no objects the one of nothing hidden. Errors as of HiddenObjects.
Hiding hide(const Skeleton& skeleton, const PackObjects& of_pack, ObjectSet objects,
            const std::string& place);

}  // namespace triptych
