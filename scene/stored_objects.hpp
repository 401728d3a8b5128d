// The pack's section OBJS: the source objects, and which placements belong to them. docs/pack-format.md
// describes every byte.
#pragma once

#include "base/bytes.hpp"
#include "scene/source_objects.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace triptych {

/// So many placements of a drawable, one after the other, belong to this object; no_id: to none.
struct ObjectRun {
  uint32_t placements = 0;
  SourceObjectId object = no_id;
  bool operator==(const ObjectRun&) const = default;
};

/// What belongs to which object in one hierarchy, with its local ids of scene nodes. In a sub-hierarchy ids
/// of objects are local too: each of its places has its own objects.
struct HierarchyObjects {
  std::vector<SceneNodeId> leaves;   ///< ascending; those that are left out belong to no object
  std::vector<uint32_t> first_runs;  ///< of each leaf: index into `runs`; up to the next one's
  /// Of each leaf, over the placements of a drawable: all its drawables have the same ones in the same order.
  std::vector<ObjectRun> runs;
  /// For each HierarchyInstance what the ids of objects in it count from; no_id: what is in it has none.
  std::vector<SourceObjectId> instances;
  /// Drawables of inner scene nodes, ascending, whose triangles belong to several objects.
  std::vector<DrawableId> drawables;
  std::vector<uint64_t> first_bytes;  ///< of each of them: index into `triangles`; up to the next one's
  /// Of each drawable, which places one chunk: runs of triangles in the chunk's order. each_run() reads them.
  std::vector<std::byte> triangles;

  void add_leaf(SceneNodeId leaf, std::span<const ObjectRun> of_placements);
  std::span<const ObjectRun> runs_of(size_t leaf) const;
  void add_drawable(DrawableId drawable, std::span<const std::byte> of_triangles);
  std::span<const std::byte> triangles_of(size_t drawable) const;
};

/// The first number of a run of triangles holds the count less 1 in its lowest bits, where it is less than
/// all of them set; otherwise how much more it is follows.
inline constexpr int run_count_bits = 3;
inline constexpr uint64_t long_run = (1u << run_count_bits) - 1;

/// Calls take(count, object) for each run of triangles. Error (place) for bytes that are none.
template <typename Take>
void each_run(std::span<const std::byte> triangles, const std::string& place, const Take& take) {
  ByteReader reader(triangles, place);
  SourceObjectId object = 0;
  while (reader.left() > 0) {
    const uint64_t first = reader.read_varint();
    const uint64_t more = (first & long_run) == long_run ? reader.read_varint() : 0;
    if (more > no_id) fail(place, "a run of {} triangles", more);
    const uint64_t count = (first & long_run) + 1 + more;
    const auto step = static_cast<uint32_t>(first >> run_count_bits);
    object += step >> 1 ^ (~(step & 1) + 1);
    take(count, object);
  }
}

/// The section as it is stored.
struct StoredObjects {
  SourceObjects objects;
  std::vector<HierarchyObjects> hierarchies;  ///< the surrounding one, then the sub-hierarchies
};

/// Reads back what encode_objects() (preprocess/encode_objects.hpp) wrote. Error (place) for bytes that do
/// not decode, end too soon or too late, or hold numbers that name nothing.
StoredObjects decode_objects(std::span<const std::byte> bytes, const std::string& place);

}  // namespace triptych
