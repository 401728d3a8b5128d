#include "scene/skeleton_memory.hpp"

#include "scene/moving_parts.hpp"

namespace triptych {

namespace {

template <typename Item>
ArrayMemory memory_of(std::string_view name, const std::vector<Item>& items) {
  return {name, items.size(), items.capacity() * sizeof(Item)};
}

/// The section's arrays, and those that ClosedSurfaces::find_reach() makes of them.
ArrayMemory memory_of_closed(const Skeleton& skeleton) {
  const ClosedSurfaces& closed = skeleton.closed;
  const uint64_t stored = closed.in_chunks.capacity() * sizeof(uint32_t) +
                          closed.bodies.capacity() * sizeof(DividedBody) +
                          closed.runs.capacity() * sizeof(ClosedRun);
  if (closed.bodies.empty()) return {"closed surfaces", 0, stored};
  const uint64_t by_chunk = (skeleton.chunks.size() + 1 + closed.runs.size()) * sizeof(uint32_t);
  const uint64_t reach = skeleton.scene_nodes.size() * sizeof(LatticeBox);
  return {"closed surfaces", closed.bodies.size(), stored + by_chunk + reach};
}

ArrayMemory memory_of_moving(const MovingParts& parts) {
  uint64_t bytes = (parts.node_of.capacity() + parts.transform_of.capacity()) * sizeof(uint32_t) +
                   parts.nodes.capacity() * sizeof(MovingNode) +
                   parts.transforms.capacity() * sizeof(MovingTransform) +
                   parts.instances.capacity() * sizeof(MovingInstance) +
                   parts.motion.joints.capacity() * sizeof(MotionJoint);
  for (const MotionTrack& track : parts.motion.tracks)
    bytes += sizeof(track) + (track.times.capacity() + track.values.capacity()) * sizeof(double);
  return {"moving instances", parts.instances.size(), bytes};
}

}  // namespace

std::vector<ArrayMemory> skeleton_memory(const Skeleton& skeleton) {
  std::vector<ArrayMemory> arrays = {
      memory_of("drawables", skeleton.drawables),
      memory_of("scene nodes", skeleton.scene_nodes),
      memory_of("placements", skeleton.placements),
      memory_of("chunks", skeleton.chunks),
      memory_of("pieces", skeleton.pieces),
      memory_of("transforms", skeleton.transforms),
      memory_of("lattices", skeleton.lattices),
      memory_of("instances", skeleton.instances),
      {"seen from outside", skeleton.seen_from_outside.size(), skeleton.seen_from_outside.capacity() / 8},
      memory_of_closed(skeleton)};
  if (skeleton.moving) arrays.push_back(memory_of_moving(*skeleton.moving));
  return arrays;
}

uint64_t skeleton_bytes(const Skeleton& skeleton) {
  uint64_t bytes = 0;
  for (const ArrayMemory& array : skeleton_memory(skeleton)) bytes += array.bytes;
  return bytes;
}

}  // namespace triptych
