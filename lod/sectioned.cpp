#include "lod/sectioned.hpp"

#include "scene/solid_objects.hpp"

namespace triptych {

bool SectionedCounter::is_solid(uint32_t chunk) {
  Known& known = known_[chunk];
  if (known == Known::nothing)
    known = triptych::is_solid(pack_.read_chunk(chunk)) ? Known::solid : Known::open;
  return known == Known::solid;
}

SectionedCounts SectionedCounter::count(const FrameView& view, std::span<const DrawableId> drawn) {
  SectionedCounts counts;
  if (view.section_space.keeps_all()) return counts;
  const Skeleton& skeleton = hierarchy_.skeleton();
  const HiddenObjects* const hidden = view.state.hiding.objects.get();
  for (const DrawableId id : drawn) {
    const SceneNodeId node = skeleton.drawables[id].scene_node;
    if (view.section_place(skeleton.scene_nodes[node].box).inside()) continue;
    const std::span<const Placement> placements = hierarchy_.placements_of(id);
    const std::span<const LatticeBox> boxes = hierarchy_.placed(id).placements;
    for (uint32_t i = 0; i < placements.size(); ++i) {
      const SectionPlace place = view.section_place(boxes[i]);
      if (place.outside || place.inside() || (hidden && hidden->hides(node, i))) continue;
      ++counts.placements;
      counts.open += is_solid(placements[i].chunk) ? 0 : 1;
    }
  }
  return counts;
}

}  // namespace triptych
