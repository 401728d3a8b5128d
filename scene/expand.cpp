#include "scene/expand.hpp"

#include "base/error.hpp"

#include <cmath>
#include <glm/common.hpp>
#include <glm/mat4x4.hpp>
#include <limits>

namespace triptych {

namespace {

/// How many elements of each array there are in a hierarchy and all that it holds, as far as 64 bits go.
struct Extent {
  uint64_t scene_nodes = 0, drawables = 0, placements = 0, transforms = 0, instances = 0;

  void add(const Extent& other) {
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
Extent own_extent(const Hierarchy& hierarchy) {
  return {hierarchy.scene_nodes.size(), hierarchy.drawables.size(), hierarchy.placements.size(),
          hierarchy.transforms.size(), 0};
}

/// Of the expanded skeleton; before anything is allocated for it.
Extent expanded_extent(const StoredSkeleton& stored) {
  std::vector<Extent> extents;
  const auto add_instances = [&](Extent& extent, const std::vector<HierarchyInstance>& instances) {
    extent.add({.instances = instances.size()});
    for (const HierarchyInstance& instance : instances) extent.add(extents[instance.sub_hierarchy]);
  };
  for (const SubHierarchy& hierarchy : stored.sub_hierarchies) {
    Extent extent = own_extent(hierarchy);
    add_instances(extent, hierarchy.instances);
    extents.push_back(extent);
  }
  Extent whole = own_extent(stored.surrounding);
  add_instances(whole, stored.instances);
  return whole;
}

void check_extent(const Extent& extent, uint64_t max_bytes, const std::string& place) {
  constexpr uint64_t max_ids = no_id - 1;  // no_id and the one before it mean something else
  const auto check = [&](uint64_t count, const char* what) {
    if (count > max_ids) fail(place, "its instances come to {} {}, more than 32 bits can name", count, what);
  };
  check(extent.scene_nodes, "scene nodes");
  check(extent.drawables, "drawables");
  check(extent.placements, "placements");
  check(extent.transforms, "transforms");
  check(extent.instances, "instances");
  const uint64_t bytes = extent.scene_nodes * sizeof(SceneNode) + extent.drawables * sizeof(Drawable) +
                         extent.placements * sizeof(Placement) + extent.transforms * sizeof(Affine) +
                         extent.instances * (sizeof(ExpandedInstance) + sizeof(Affine));
  if (bytes > max_bytes) {
    fail(place,
         "its {} instances come to {} bytes of skeleton, more than the {} that are allowed: build it "
         "with --flat",
         extent.instances, bytes, max_bytes);
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
  // Within the parent's box before they are converted: numbers may be beyond all lattices. The parent's side
  // stands where the transform leaves no number.
  placed = {glm::max(outer.lo, placed.lo), glm::min(outer.hi, placed.hi)};
  if (placed.empty()) return parent;
  const LatticeBox enclosing = to.enclosing(placed);
  return {glm::max(parent.lo, enclosing.lo - 1), glm::min(parent.hi, enclosing.hi + 1)};
}

class Expansion {
 public:
  Expansion(StoredSkeleton stored, const std::string& place)
      : stored_(std::move(stored)), place_(place), skeleton_(std::move(stored_.surrounding)) {}

  Skeleton run(const Extent& extent) {
    skeleton_.scene_nodes.reserve(extent.scene_nodes);
    skeleton_.drawables.reserve(extent.drawables);
    skeleton_.placements.reserve(extent.placements);
    skeleton_.transforms.reserve(extent.transforms);
    skeleton_.instances.reserve(extent.instances);
    stretches_.reserve(extent.instances);
    for (const HierarchyInstance& instance : stored_.instances) enqueue(instance, 0, 0, 1);
    for (size_t i = 0; i < skeleton_.instances.size(); ++i) append(i);
    skeleton_.sub_hierarchies = static_cast<uint32_t>(stored_.sub_hierarchies.size());
    return std::move(skeleton_);
  }

 private:
  /// The instance's hierarchy has these first ids, and lengths in it were stretched so much at most.
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
    instance.transform = first_transform;  // the identity of the sub-hierarchy: its space to the model's
    skeleton_.instances[index] = instance;
    for (const Affine& inner : hierarchy.transforms) {
      skeleton_.transforms.push_back(outer * glm::dmat4(inner));
      if (!is_finite(skeleton_.transforms.back()))
        fail(place_, "an instance has a transform that is not finite");
    }
    const Lattice& lattice = skeleton_.lattices[hierarchy.lattice];
    for (const SceneNode& local : hierarchy.scene_nodes) {
      SceneNode node = local;
      node.parent = local.parent == no_id ? instance.scene_node : first_node + local.parent;
      if (node.child_count > 0) node.first_child += first_node;
      node.first_drawable += first_drawable;
      node.box =
          place_box(local.box, lattice, outer, skeleton_.lattices[0], skeleton_.scene_nodes[node.parent].box);
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
};

}  // namespace

Skeleton expand(StoredSkeleton stored, const std::string& place, uint64_t max_bytes) {
  if (stored.instances.empty()) return std::move(stored.surrounding);
  const Extent extent = expanded_extent(stored);
  check_extent(extent, max_bytes, place);
  return Expansion(std::move(stored), place).run(extent);
}

}  // namespace triptych
