#include "scene/solid_objects.hpp"

#include "scene/pack_objects.hpp"

#include <vector>

namespace triptych {

SolidCounts count_solids(const Pack& pack) {
  const Skeleton& skeleton = pack.skeleton();
  const PackObjects objects = pack.read_objects();
  std::vector<uint8_t> shown(objects.source().objects.size(), 0), open(shown.size(), 0);
  SolidCounts counts;
  for (SceneNodeId id = 0; id < skeleton.scene_nodes.size(); ++id) {
    const SceneNode& node = skeleton.scene_nodes[id];
    if (node.child_count > 0) continue;
    const Drawable& finest = skeleton.drawables[node.first_drawable];
    const auto is_solid_at = [&](uint32_t i) {
      const uint32_t chunk = skeleton.placements[finest.first_placement + i].chunk;
      return skeleton.closed.are_all_of(chunk, skeleton.chunks[chunk]);
    };
    counts.placements += finest.placement_count;
    for (uint32_t i = 0; i < finest.placement_count; ++i) counts.solid_placements += is_solid_at(i);
    uint32_t next = 0;
    for (const ObjectRun& run : objects.runs_of(id)) {
      for (uint32_t i = next; i < next + run.placements && run.object != no_id; ++i) {
        shown[run.object] = 1;
        if (!is_solid_at(i)) open[run.object] = 1;
      }
      next += run.placements;
    }
  }
  for (size_t i = 0; i < shown.size(); ++i) {
    counts.objects += shown[i];
    counts.solid_objects += shown[i] != 0 && open[i] == 0;
  }
  return counts;
}

}  // namespace triptych
