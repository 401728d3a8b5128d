#include "lod/sectioned.hpp"

namespace triptych {

SectionedCounts count_sectioned(const Hierarchy& hierarchy, const FrameView& view,
                                std::span<const DrawableId> drawn) {
  SectionedCounts counts;
  if (view.section_space.keeps_all()) return counts;
  const Skeleton& skeleton = hierarchy.skeleton();
  const HiddenObjects* const hidden = view.state.hiding.objects.get();
  for (const DrawableId id : drawn) {
    const SceneNodeId node = skeleton.drawables[id].scene_node;
    if (view.section_place(view.box(node)).inside()) continue;
    const std::span<const Placement> placements = hierarchy.placements_of(id);
    const std::span<const LatticeBox> boxes = hierarchy.placed(id, view.poses.get()).placements;
    for (uint32_t i = 0; i < placements.size(); ++i) {
      const SectionPlace place = view.section_place(boxes[i]);
      if (place.outside || place.inside() || (hidden && hidden->hides(node, i))) continue;
      ++counts.placements;
      const uint32_t chunk = placements[i].chunk;
      counts.open += skeleton.closed.are_all_of(chunk, skeleton.chunks[chunk]) ? 0 : 1;
    }
  }
  return counts;
}

}  // namespace triptych
