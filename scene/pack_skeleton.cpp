#include "scene/pack_skeleton.hpp"

#include "base/record.hpp"
#include "scene/check_skeleton.hpp"

namespace triptych {

template <>
inline constexpr auto record_members<ImportReport> = std::tuple(&ImportReport::dropped_triangles,
                                                                &ImportReport::welded_vertices,
                                                                &ImportReport::repaired_edges,
                                                                &ImportReport::stuck_groups,
                                                                &ImportReport::warnings);
/// All members but the pieces, which come last and may be written by the caller.
template <>
inline constexpr auto record_members<Skeleton> = std::tuple(
    &Skeleton::source_triangles, &Skeleton::placed_triangles, &Skeleton::objects, &Skeleton::import,
    &Skeleton::effects, &Skeleton::lattices, &Skeleton::palette, &Skeleton::transforms,
    &Skeleton::scene_nodes, &Skeleton::drawables, &Skeleton::placements, &Skeleton::chunks);
template <>
inline constexpr auto record_members<HierarchyInstance> = std::tuple(&HierarchyInstance::scene_node,
                                                                     &HierarchyInstance::sub_hierarchy,
                                                                     &HierarchyInstance::transform,
                                                                     &HierarchyInstance::stretch);
template <>
inline constexpr auto record_members<SubHierarchy> =
    std::tuple(&SubHierarchy::lattice, &SubHierarchy::transforms, &SubHierarchy::scene_nodes,
               &SubHierarchy::drawables, &SubHierarchy::placements, &SubHierarchy::instances);
/// What a section of sub-hierarchies holds.
template <>
inline constexpr auto record_members<StoredSkeleton> = std::tuple(&StoredSkeleton::instances,
                                                                  &StoredSkeleton::sub_hierarchies);

namespace {

// The arrays are written as they lie in memory; these sizes are part of the format.
static_assert(sizeof(SceneNode) == 44 && sizeof(Drawable) == 24 && sizeof(Placement) == 8);
static_assert(sizeof(Affine) == 96 && sizeof(Lattice) == 32 && sizeof(ChunkInfo) == 64 &&
              sizeof(LatticeBox) == 24 && sizeof(ObjectCounts) == 32);

using Write = std::function<void(std::span<const std::byte>)>;

/// What write_record() writes to; passes the bytes on as they come.
struct Sink {
  const Write& write;
  template <typename Value>
  void write_all(std::span<const Value> values) {
    write(std::as_bytes(values));
  }
};

Skeleton read_skeleton(std::span<const std::byte> bytes, const std::string& place) {
  ByteReader reader(bytes, place);
  auto skeleton = read_record<Skeleton>(reader);
  skeleton.pieces = read_record<std::vector<LatticeBox>>(reader);
  reader.expect_end();
  return skeleton;
}

}  // namespace

void write_skeleton(const Skeleton& skeleton, uint64_t piece_count, const Write& write) {
  Sink sink{write};
  write_record(sink, skeleton);
  write(std::as_bytes(std::span(&piece_count, 1)));
}

std::vector<std::byte> encode_skeleton(const Skeleton& skeleton) {
  ByteWriter writer;
  write_skeleton(skeleton, skeleton.pieces.size(),
                 [&](std::span<const std::byte> bytes) { writer.write_all(bytes); });
  writer.write_all(std::span<const LatticeBox>(skeleton.pieces));
  return std::move(writer.bytes());
}

std::vector<std::byte> encode_sub_hierarchies(const StoredSkeleton& stored) { return record_bytes(stored); }

Skeleton decode_skeleton(std::span<const std::byte> bytes, uint64_t geometry_size, const std::string& place) {
  StoredSkeleton stored;
  stored.surrounding = read_skeleton(bytes, place);
  check_skeleton(stored, geometry_size, place, place);
  return std::move(stored.surrounding);
}

StoredSkeleton decode_skeleton(const SectionBytes& skeleton, const SectionBytes& sub_hierarchies,
                               uint64_t geometry_size) {
  auto stored = record_of<StoredSkeleton>(sub_hierarchies.bytes, sub_hierarchies.place);
  stored.surrounding = read_skeleton(skeleton.bytes, skeleton.place);
  check_skeleton(stored, geometry_size, skeleton.place, sub_hierarchies.place);
  return stored;
}

}  // namespace triptych
