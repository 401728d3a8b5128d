// The pack reader behind its checksums, which a fuzzer cannot guess: first byte 0, then the length of a
// skeleton, the skeleton, and the geometry that its chunks are in. First byte 1: a pack file as it stands.
// First byte 2: the length of a skeleton, the skeleton, and the section of sub-hierarchies. First byte 3: the
// section of objects. First byte 4: the section of options.
#include "base/error.hpp"
#include "fuzz_target.hpp"
#include "scene/expand.hpp"
#include "scene/pack.hpp"
#include "scene/pack_objects.hpp"
#include "scene/pack_options.hpp"
#include "scene/pack_skeleton.hpp"

#include <algorithm>
#include <cstdlib>
#include <cstring>

namespace triptych {

namespace {

void read_parts(std::span<const std::byte> bytes) {
  uint32_t length = 0;
  if (bytes.size() < sizeof(length)) return;
  std::memcpy(&length, bytes.data(), sizeof(length));
  bytes = bytes.subspan(sizeof(length));
  if (length > bytes.size()) return;
  const auto geometry = bytes.subspan(length);
  const Skeleton skeleton = decode_skeleton(bytes.first(length), geometry.size(), "skeleton");
  for (uint32_t i = 0; i < skeleton.chunks.size(); ++i) {
    const ChunkInfo& info = skeleton.chunks[i];
    const auto pieces = skeleton.pieces_of(i);
    const Chunk chunk = decode_chunk(geometry.subspan(info.offset, info.size), info, pieces,
                                     skeleton.palette.size(), "chunk");
    for (const uint32_t index : chunk.indices) {
      if (index >= chunk.vertices.size()) std::abort();
    }
    for (const ChunkVertex& vertex : chunk.vertices) {
      if (vertex.color >= skeleton.palette.size() || vertex.piece >= pieces.size()) std::abort();
    }
  }
}

void expand_parts(std::span<const std::byte> bytes) {
  uint32_t length = 0;
  if (bytes.size() < sizeof(length)) return;
  std::memcpy(&length, bytes.data(), sizeof(length));
  bytes = bytes.subspan(sizeof(length));
  if (length > bytes.size()) return;
  constexpr uint64_t geometry_size = 1000, most = 64 << 20;
  const Skeleton skeleton = expand(decode_skeleton({bytes.first(length), "skeleton"},
                                                   {bytes.subspan(length), "sub-hierarchies"}, geometry_size),
                                   "sub-hierarchies", most);
  for (size_t i = 1; i < skeleton.scene_nodes.size(); ++i) {
    const SceneNode& node = skeleton.scene_nodes[i];
    if (node.parent >= i || node.box.empty()) std::abort();
    for (int axis = 0; axis < 3; ++axis) {
      if (node.box.lo[axis] < -Lattice::limit || node.box.hi[axis] > Lattice::limit) std::abort();
    }
  }
  for (const Placement& placement : skeleton.placements) {
    if (placement.transform >= skeleton.transforms.size()) std::abort();
  }
}

/// Of a skeleton of one scene node with two drawables of three placements and five triangles.
void read_objects(std::span<const std::byte> bytes) {
  Skeleton skeleton;
  skeleton.scene_nodes = {{.box = {}, .drawable_count = 2}};
  skeleton.drawables = {{.placement_count = 3, .triangles = 5}, {.placement_count = 3, .triangles = 5}};
  const PackObjects objects(decode_objects(bytes, "objects"), skeleton, "objects");
  const SourceObjects& source = objects.source();
  for (SourceObjectId id = 0; id < source.objects.size(); ++id) {
    source.path_of(id);
    for (const uint32_t set : source.sets_of(id)) {
      for (const SourceProperty& property : source.properties_of(set))
        if (source.texts[property.value].size() > TextTable::max_bytes) std::abort();
    }
    for (const SceneNodeId node : objects.nodes_of(id)) {
      if (node != 0) std::abort();
    }
  }
  for (const SourceObjectId object : objects.objects_below(0)) {
    if (object >= source.objects.size()) std::abort();
  }
  for (const DrawableId drawable : {0u, 1u}) {
    const SourceObjectId object = objects.object_at(drawable, 2, 4);
    if (object != no_id && object >= source.objects.size()) std::abort();
  }
}

/// What was read is written as it was.
void read_options(std::span<const std::byte> bytes) {
  const std::vector<std::byte> again = encode_pack_options(decode_pack_options(bytes, "options"));
  if (!std::equal(bytes.begin(), bytes.end(), again.begin(), again.end())) std::abort();
}

void read_file_of(std::span<const uint8_t> bytes) {
  const Pack pack(fuzz::file_of(bytes));
  for (uint32_t i = 0; i < pack.skeleton().chunks.size(); ++i) pack.read_chunk(i);
  pack.read_objects();
  pack.read_options();
}

}  // namespace

}  // namespace triptych

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  if (size == 0) return 0;
  const std::span<const uint8_t> rest(data + 1, size - 1);
  try {
    if (data[0] == 0) triptych::read_parts(std::as_bytes(rest));
    if (data[0] == 1) triptych::read_file_of(rest);
    if (data[0] == 2) triptych::expand_parts(std::as_bytes(rest));
    if (data[0] == 3) triptych::read_objects(std::as_bytes(rest));
    if (data[0] == 4) triptych::read_options(std::as_bytes(rest));
  } catch (const triptych::Error&) {
  }
  return 0;
}
