#include "scene/expand_motion.hpp"

#include <glm/common.hpp>
#include <glm/mat4x4.hpp>
#include <utility>

namespace triptych {

namespace {

/// Of a sub-hierarchy within a moving one: what rounding in its transform moves is far less than a step of
/// any lattice.
Box within(const Affine& transform, const Box& box, const Box& parent) {
  const Box placed = placed_box(transform, box);
  constexpr double rounding = 1e-12;
  const glm::dvec3 margin = glm::max(glm::abs(placed.lo), glm::abs(placed.hi)) * rounding;
  const Box inner{glm::max(placed.lo - margin, parent.lo), glm::min(placed.hi + margin, parent.hi)};
  return inner.empty() ? parent : inner;
}

}  // namespace

MovingExpansion::MovingExpansion(StoredMotion motion, const Skeleton& skeleton)
    : moving_(skeleton.instances.size(), no_id) {
  parts_->motion = std::move(motion.motion);
  parts_->node_of.resize(skeleton.scene_nodes.size(), no_id);
  parts_->transform_of.resize(skeleton.transforms.size(), no_id);
  for (const StoredMotion::Instance& moving : motion.instances) {
    moving_[moving.instance] = static_cast<uint32_t>(parts_->instances.size());
    parts_->instances.push_back({.joint = moving.joint,
                                 .scene_node = skeleton.instances[moving.instance].scene_node,
                                 .box = {},
                                 .inner = {}});
  }
}

void MovingExpansion::add_node(SceneNodeId node, uint32_t moving, const Box& box) {
  if (node >= parts_->node_of.size()) parts_->node_of.resize(size_t{node} + 1, no_id);
  parts_->node_of[node] = static_cast<uint32_t>(parts_->nodes.size());
  parts_->nodes.push_back({moving, box});
}

bool MovingExpansion::begin(size_t index, const ExpandedInstance& instance, uint32_t first_transform,
                            const SubHierarchy& hierarchy, const Lattice& lattice) {
  uint32_t moving = no_id;
  Affine to_instance(1);
  if (index < moving_.size()) {
    moving = moving_[index];
    if (moving == no_id) return false;
    parts_->instances[moving].box = lattice.box(hierarchy.scene_nodes.front().box);
    add_node(instance.scene_node, moving, parts_->instances[moving].box);
  } else {
    if (instance.scene_node >= parts_->node_of.size()) return false;
    const uint32_t outer = parts_->node_of[instance.scene_node];
    if (outer == no_id) return false;
    moving = parts_->nodes[outer].instance;
    to_instance = parts_->transforms[parts_->transform_of[instance.transform]].to_instance;
  }
  if (parts_->transform_of.size() < first_transform) parts_->transform_of.resize(first_transform, no_id);
  for (const Affine& inner : hierarchy.transforms) {
    const auto added = static_cast<uint32_t>(parts_->transforms.size());
    parts_->instances[moving].inner.push_back(added);
    parts_->transform_of.push_back(added);
    parts_->transforms.push_back({moving, to_instance * glm::dmat4(inner)});
  }
  SceneNodeId node = instance.first_scene_node;
  for (const SceneNode& local : hierarchy.scene_nodes) {
    const SceneNodeId parent =
        local.parent == no_id ? instance.scene_node : instance.first_scene_node + local.parent;
    const Box box = lattice.box(local.box);
    const Box& around = parts_->nodes[parts_->node_of[parent]].box;
    add_node(node++, moving, index < moving_.size() ? box : within(to_instance, box, around));
  }
  return true;
}

std::shared_ptr<const MovingParts> MovingExpansion::finish(const Skeleton& skeleton) {
  parts_->node_of.resize(skeleton.scene_nodes.size(), no_id);
  parts_->transform_of.resize(skeleton.transforms.size(), no_id);
  return std::move(parts_);
}

}  // namespace triptych
