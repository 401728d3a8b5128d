#include "scene/expand.hpp"

#include "base/error.hpp"
#include "scene/expand_motion.hpp"

#include <cmath>
#include <glm/common.hpp>
#include <glm/mat4x4.hpp>
#include <limits>
#include <optional>

namespace triptych {

namespace {

/// How many elements of each array there are in a hierarchy and in all instances within it; saturates at 64
/// bits.
struct ElementCounts {
  uint64_t scene_nodes = 0, drawables = 0, placements = 0, transforms = 0, instances = 0;

  void add(const ElementCounts& other) {
    const auto add = [](uint64_t& sum, uint64_t more) {
      sum = more > std::numeric_limits<uint64_t>::max() - sum ? std::numeric_limits<uint64_t>::max()
                                                              : sum + more;
    };
    add(scene_nodes, other.scene_nodes);
    add(drawables, other.drawables);
    add(placements, other.placements);
    add(transforms, other.transforms);
    add(instances, other.instances);
  }
};

template <typename Hierarchy>
ElementCounts own_counts(const Hierarchy& hierarchy) {
  return {hierarchy.scene_nodes.size(), hierarchy.drawables.size(), hierarchy.placements.size(),
          hierarchy.transforms.size(), 0};
}

/// The counts of the expanded skeleton, before anything is allocated for it.
ElementCounts expanded_counts(const StoredSkeleton& stored) {
  std::vector<ElementCounts> counts_of;
  const auto add_instances = [&](ElementCounts& counts, const std::vector<HierarchyInstance>& instances) {
    counts.add({.instances = instances.size()});
    for (const HierarchyInstance& instance : instances) counts.add(counts_of[instance.sub_hierarchy]);
  };
  for (const SubHierarchy& hierarchy : stored.sub_hierarchies) {
    ElementCounts counts = own_counts(hierarchy);
    add_instances(counts, hierarchy.instances);
    counts_of.push_back(counts);
  }
  ElementCounts whole = own_counts(stored.surrounding);
  add_instances(whole, stored.instances);
  return whole;
}

void check_counts(const ElementCounts& counts, uint64_t max_bytes, const std::string& place) {
  constexpr uint64_t max_ids = no_id - 1;  // no_id and the id before it mean something else
  const auto check = [&](uint64_t count, const char* what) {
    if (count > max_ids) fail(place, "its instances come to {} {}, more than 32 bits can name", count, what);
  };
  check(counts.scene_nodes, "scene nodes");
  check(counts.drawables, "drawables");
  check(counts.placements, "placements");
  check(counts.transforms, "transforms");
  check(counts.instances, "instances");
  const uint64_t bytes = counts.scene_nodes * sizeof(SceneNode) + counts.drawables * sizeof(Drawable) +
                         counts.placements * sizeof(Placement) + counts.transforms * sizeof(Affine) +
                         counts.instances * (sizeof(ExpandedInstance) + sizeof(Affine));
  if (bytes > max_bytes) {
    fail(place,
         "its {} instances come to {} bytes of skeleton, more than the {} that are allowed: build it "
         "with --flat",
         counts.instances, bytes, max_bytes);
  }
}

bool is_finite(const Affine& transform) {
  for (int column = 0; column < 4; ++column) {
    const glm::dvec3& v = transform[column];
    if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z)) return false;
  }
  return true;
}

/// A box on the lattice `to` that holds the box, of the lattice `from`, under the transform; within `parent`.
LatticeBox place_box(const LatticeBox& box, const Lattice& from, const Affine& transform, const Lattice& to,
                     const LatticeBox& parent) {
  const Box local = from.box(box), outer = to.box(parent);
  Box placed;
  for (int i = 0; i < 8; ++i) placed.extend(transform * glm::dvec4(local.corner(i), 1));
  // Clipped to the parent's box before the conversion to integers, since numbers may be beyond every lattice.
  // Where the transform's result is not a number, the parent's side is kept.
  placed = {glm::max(outer.lo, placed.lo), glm::min(outer.hi, placed.hi)};
  if (placed.empty()) return parent;
  const LatticeBox enclosing = to.enclosing(placed);
  return {glm::max(parent.lo, enclosing.lo - 1), glm::min(parent.hi, enclosing.hi + 1)};
}

class Expansion {
 public:
  Expansion(StoredSkeleton stored, const std::string& place)
      : stored_(std::move(stored)), place_(place), skeleton_(std::move(stored_.surrounding)) {}

  Skeleton run(const ElementCounts& counts) {
    skeleton_.scene_nodes.reserve(counts.scene_nodes);
    skeleton_.drawables.reserve(counts.drawables);
    skeleton_.placements.reserve(counts.placements);
    skeleton_.transforms.reserve(counts.transforms);
    skeleton_.instances.reserve(counts.instances);
    stretches_.reserve(counts.instances);
    for (const HierarchyInstance& instance : stored_.instances) enqueue(instance, 0, 0, 1);
    if (!stored_.motion.empty()) moving_.emplace(std::move(stored_.motion), skeleton_);
    for (size_t i = 0; i < skeleton_.instances.size(); ++i) append(i);
    if (moving_) skeleton_.moving = moving_->finish(skeleton_);
    skeleton_.sub_hierarchies = static_cast<uint32_t>(stored_.sub_hierarchies.size());
    return std::move(skeleton_);
  }

 private:
  /// first_node, first_transform: what local ids of the instance count from. stretch: by how much lengths
  /// around it are stretched at most.
  void enqueue(const HierarchyInstance& instance, SceneNodeId first_node, uint32_t first_transform,
               double stretch) {
    skeleton_.instances.push_back({.scene_node = first_node + instance.scene_node,
                                   .sub_hierarchy = instance.sub_hierarchy,
                                   .transform = first_transform + instance.transform});
    stretches_.push_back(stretch * instance.stretch);
  }

  void append(size_t index) {
    ExpandedInstance instance = skeleton_.instances[index];
    const double stretch = stretches_[index];
    const SubHierarchy& hierarchy = stored_.sub_hierarchies[instance.sub_hierarchy];
    const auto first_node = static_cast<SceneNodeId>(skeleton_.scene_nodes.size());
    const auto first_drawable = static_cast<DrawableId>(skeleton_.drawables.size());
    const auto first_placement = static_cast<uint32_t>(skeleton_.placements.size());
    const auto first_transform = static_cast<uint32_t>(skeleton_.transforms.size());
    instance.first_scene_node = first_node;
    instance.scene_node_count = static_cast<uint32_t>(hierarchy.scene_nodes.size());
    instance.first_drawable = first_drawable;
    instance.drawable_count = static_cast<uint32_t>(hierarchy.drawables.size());
    skeleton_.scene_nodes[instance.scene_node].first_child = first_node;
    skeleton_.scene_nodes[instance.scene_node].child_count = 1;
    const Affine outer = skeleton_.transforms[instance.transform];
    const Lattice& lattice = skeleton_.lattices[hierarchy.lattice];
    const bool moves = moving_ && moving_->begin(index, instance, first_transform, hierarchy, lattice);
    instance.transform = first_transform;  // the identity of the sub-hierarchy: its space to the model's
    skeleton_.instances[index] = instance;
    for (const Affine& inner : hierarchy.transforms) {
      skeleton_.transforms.push_back(outer * glm::dmat4(inner));
      if (!is_finite(skeleton_.transforms.back()))
        fail(place_, "an instance has a transform that is not finite");
    }
    for (const SceneNode& local : hierarchy.scene_nodes) {
      SceneNode node = local;
      node.parent = local.parent == no_id ? instance.scene_node : first_node + local.parent;
      if (node.child_count > 0) node.first_child += first_node;
      node.first_drawable += first_drawable;
      const LatticeBox& around = skeleton_.scene_nodes[node.parent].box;
      // What moves is anywhere in the box of the scene node that stands for it.
      node.box = moves ? around : place_box(local.box, lattice, outer, skeleton_.lattices[0], around);
      skeleton_.scene_nodes.push_back(node);
    }
    for (const Drawable& local : hierarchy.drawables) {
      Drawable drawable = local;
      drawable.error *= stretch;
      if (!std::isfinite(drawable.error)) fail(place_, "an instance has a drawable without an error bound");
      drawable.scene_node += first_node;
      drawable.first_placement += first_placement;
      skeleton_.drawables.push_back(drawable);
    }
    for (const Placement& local : hierarchy.placements)
      skeleton_.placements.push_back({local.chunk, first_transform + local.transform});
    for (const HierarchyInstance& inner : hierarchy.instances)
      enqueue(inner, first_node, first_transform, stretch);
  }

  StoredSkeleton stored_;
  const std::string& place_;
  Skeleton skeleton_;
  std::vector<double> stretches_;  ///< of each of the skeleton's instances
  std::optional<MovingExpansion> moving_;
};

}  // namespace

Skeleton expand(StoredSkeleton stored, const std::string& place, uint64_t max_bytes) {
  if (stored.instances.empty()) return std::move(stored.surrounding);
  const ElementCounts counts = expanded_counts(stored);
  check_counts(counts, max_bytes, place);
  return Expansion(std::move(stored), place).run(counts);
}

}  // namespace triptych
