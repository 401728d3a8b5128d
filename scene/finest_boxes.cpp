#include "scene/finest_boxes.hpp"

#include "scene/hidden_objects.hpp"

#include <glm/common.hpp>
#include <glm/vec4.hpp>

namespace triptych {

namespace {

/// Of a chunk where it is placed.
Box placed_box(const Skeleton& skeleton, const Placement& placement) {
  const ChunkInfo& chunk = skeleton.chunks[placement.chunk];
  const Lattice& lattice = skeleton.lattices[chunk.lattice];
  if (placement.transform == 0) return lattice.box(chunk.box);
  Box placed;
  for (int corner = 0; corner < 8; ++corner)
    placed.extend(skeleton.transforms[placement.transform] *
                  glm::dvec4(lattice.position(chunk.box.corner(corner)), 1));
  return placed;
}

Box within(const Box& box, const Box& all) { return {glm::max(box.lo, all.lo), glm::min(box.hi, all.hi)}; }

}  // namespace

Box placement_box(const Skeleton& skeleton, SceneNodeId leaf, uint32_t placement) {
  const SceneNode& node = skeleton.scene_nodes[leaf];
  const Drawable& finest = skeleton.drawables[node.first_drawable];
  return within(placed_box(skeleton, skeleton.placements[finest.first_placement + placement]),
                skeleton.lattice().box(node.box));
}

std::vector<Box> finest_boxes(const Skeleton& skeleton, const HiddenObjects* hidden) {
  const auto& nodes = skeleton.scene_nodes;
  std::vector<Box> boxes(nodes.size());
  for (size_t i = nodes.size(); i-- > 0;) {  // children come after their parents
    const SceneNode& node = nodes[i];
    Box& own = boxes[i];
    if (node.child_count == 0) {
      const Drawable& finest = skeleton.drawables[node.first_drawable];
      for (uint32_t k = 0; k < finest.placement_count; ++k) {
        if (hidden != nullptr && hidden->hides(static_cast<SceneNodeId>(i), k)) continue;
        own.extend(placed_box(skeleton, skeleton.placements[finest.first_placement + k]));
      }
      own = within(own, skeleton.lattice().box(node.box));
    }
    if (node.parent != no_id) boxes[node.parent].extend(own);
  }
  return boxes;
}

Box model_box(const Skeleton& skeleton, const HiddenObjects* hidden) {
  return skeleton.scene_nodes.empty() ? Box() : finest_boxes(skeleton, hidden).front();
}

}  // namespace triptych
