#include "scene/solid_objects.hpp"

#include "base/threads.hpp"
#include "scene/chunk.hpp"
#include "scene/pack_objects.hpp"

#include <algorithm>
#include <vector>

namespace triptych {

namespace {

constexpr uint8_t unknown = 0, asked = 1, solid = 2;

/// For each chunk that a leaf shows at full detail whether it is solid.
std::vector<uint8_t> find_solid_chunks(const Pack& pack) {
  const Skeleton& skeleton = pack.skeleton();
  std::vector<uint8_t> marks(skeleton.chunks.size(), unknown);
  std::vector<uint32_t> chunks;
  for (const SceneNode& node : skeleton.scene_nodes) {
    if (node.child_count > 0) continue;
    const Drawable& finest = skeleton.drawables[node.first_drawable];
    for (uint32_t i = 0; i < finest.placement_count; ++i) {
      const uint32_t chunk = skeleton.placements[finest.first_placement + i].chunk;
      if (marks[chunk] == unknown) chunks.push_back(chunk);
      marks[chunk] = asked;
    }
  }
  parallel_for(chunks.size(), [&](size_t i) {
    if (is_solid(pack.read_chunk(chunks[i]))) marks[chunks[i]] = solid;
  });
  return marks;
}

}  // namespace

bool is_solid(const Chunk& chunk) {
  const std::vector<bool> outward = chunk.outward();
  return std::find(outward.begin(), outward.end(), false) == outward.end();
}

SolidCounts count_solids(const Pack& pack) {
  const Skeleton& skeleton = pack.skeleton();
  const std::vector<uint8_t> marks = find_solid_chunks(pack);
  const PackObjects objects = pack.read_objects();
  std::vector<uint8_t> shown(objects.source().objects.size(), 0), open(shown.size(), 0);
  SolidCounts counts;
  for (SceneNodeId id = 0; id < skeleton.scene_nodes.size(); ++id) {
    const SceneNode& node = skeleton.scene_nodes[id];
    if (node.child_count > 0) continue;
    const Drawable& finest = skeleton.drawables[node.first_drawable];
    const auto is_solid_at = [&](uint32_t i) {
      return marks[skeleton.placements[finest.first_placement + i].chunk] == solid;
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
