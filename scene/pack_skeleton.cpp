#include "scene/pack_skeleton.hpp"

#include "base/record.hpp"
#include "scene/chunk.hpp"

#include <cmath>

namespace triptych {

template <>
inline constexpr auto record_members<ImportReport> = std::tuple(&ImportReport::dropped_triangles,
                                                                &ImportReport::welded_vertices,
                                                                &ImportReport::repaired_edges,
                                                                &ImportReport::stuck_groups,
                                                                &ImportReport::warnings);
/// All but the pieces, which come last and may be written from elsewhere.
template <>
inline constexpr auto record_members<Skeleton> = std::tuple(
    &Skeleton::source_triangles, &Skeleton::placed_triangles, &Skeleton::objects, &Skeleton::import,
    &Skeleton::effects, &Skeleton::lattices, &Skeleton::palette, &Skeleton::transforms,
    &Skeleton::scene_nodes, &Skeleton::drawables, &Skeleton::placements, &Skeleton::chunks);

namespace {

// The arrays are written as they stand in memory; these sizes are the format.
static_assert(sizeof(SceneNode) == 44 && sizeof(Drawable) == 24 && sizeof(Placement) == 8);
static_assert(sizeof(Affine) == 96 && sizeof(Lattice) == 32 && sizeof(ChunkInfo) == 64 &&
              sizeof(LatticeBox) == 24 && sizeof(ObjectCounts) == 32);

using Write = std::function<void(std::span<const std::byte>)>;

/// What write_record() writes to, where the bytes go on as they come.
struct Sink {
  const Write& write;
  template <typename Value>
  void write_all(std::span<const Value> values) {
    write(std::as_bytes(values));
  }
};

bool in_range(uint64_t first, uint64_t count, uint64_t size) {
  return first <= size && count <= size - first;
}

void check_scene_nodes(const Skeleton& skeleton, const std::string& place) {
  const auto& nodes = skeleton.scene_nodes;
  if (nodes.empty() || nodes[0].parent != no_id) fail(place, "has no root scene node");
  for (size_t i = 0; i < nodes.size(); ++i) {
    const SceneNode& node = nodes[i];
    const std::string here = fmt::format("{}: scene node {}", place, i);
    if (i > 0 && node.parent >= i) fail(here, "comes before its parent");
    if (node.box.empty()) fail(here, "has an empty box");
    for (int axis = 0; axis < 3; ++axis) {
      if (node.box.lo[axis] < -Lattice::limit || node.box.hi[axis] > Lattice::limit)
        fail(here, "leaves the lattice");
    }
    if (!in_range(node.first_drawable, node.drawable_count, skeleton.drawables.size()))
      fail(here, "names drawables that do not exist");
    if (node.child_count == 0 && node.drawable_count == 0) fail(here, "is a leaf without a drawable");
    if (node.child_count == 0) continue;
    if (node.first_child <= i || !in_range(node.first_child, node.child_count, nodes.size()))
      fail(here, "names children that do not exist");
    for (uint32_t child = 0; child < node.child_count; ++child) {
      if (nodes[node.first_child + child].parent != i) fail(here, "names a child of another parent");
    }
  }
}

void check_drawables(const Skeleton& skeleton, const std::string& place) {
  for (size_t i = 0; i < skeleton.placements.size(); ++i) {
    const Placement& placement = skeleton.placements[i];
    if (placement.chunk >= skeleton.chunks.size() || placement.transform >= skeleton.transforms.size()) {
      fail(place, "placement {} names a chunk or a transform that does not exist", i);
    }
  }
  for (size_t i = 0; i < skeleton.drawables.size(); ++i) {
    const Drawable& drawable = skeleton.drawables[i];
    const std::string here = fmt::format("{}: drawable {}", place, i);
    if (!(drawable.error >= 0) || !std::isfinite(drawable.error)) fail(here, "has no error bound");
    if (drawable.scene_node >= skeleton.scene_nodes.size()) fail(here, "belongs to no scene node");
    const SceneNode& node = skeleton.scene_nodes[drawable.scene_node];
    if (i - node.first_drawable >= node.drawable_count) fail(here, "is not its scene node's");
    if (!in_range(drawable.first_placement, drawable.placement_count, skeleton.placements.size()))
      fail(here, "names placements that do not exist");
    uint64_t triangles = 0;
    for (uint32_t placement = 0; placement < drawable.placement_count; ++placement)
      triangles +=
          skeleton.chunks[skeleton.placements[drawable.first_placement + placement].chunk].triangle_count;
    if (triangles != drawable.triangles)
      fail(here, "says {} triangles, its chunks hold {}", drawable.triangles, triangles);
  }
}

void check_pieces(const Skeleton& skeleton, const std::string& place) {
  size_t end = skeleton.pieces.size();
  for (size_t i = skeleton.chunks.size(); i-- > 0;) {
    const ChunkInfo& chunk = skeleton.chunks[i];
    const std::string here = fmt::format("{}: chunk {}", place, i);
    if (chunk.first_piece > end) fail(here, "names pieces that do not exist");
    const size_t count = end - chunk.first_piece;
    if (count == 1 || count > most_chunk_pieces) fail(here, "has {} pieces", count);
    for (size_t piece = chunk.first_piece; piece < end; ++piece) {
      const LatticeBox& box = skeleton.pieces[piece];
      if (box.empty() || !chunk.box.contains(box)) fail(here, "has a piece outside its box");
    }
    end = chunk.first_piece;
  }
  if (end != 0) fail(place, "has pieces of no chunk");
}

void check_chunks(const Skeleton& skeleton, uint64_t geometry_size, const std::string& place) {
  for (size_t i = 0; i < skeleton.chunks.size(); ++i) {
    const ChunkInfo& chunk = skeleton.chunks[i];
    const std::string here = fmt::format("{}: chunk {}", place, i);
    if (!in_range(chunk.offset, chunk.size, geometry_size)) fail(here, "leaves the geometry section");
    if (chunk.lattice >= skeleton.lattices.size()) fail(here, "names a lattice that does not exist");
    // A codec needs at least a byte for every 64 values: more is promised than the bytes can hold.
    if (chunk.vertex_count > chunk.size * 64 || chunk.triangle_count > chunk.size * 64)
      fail(here, "promises more than its bytes hold");
    if (chunk.box.empty()) fail(here, "has an empty box");
    for (int axis = 0; axis < 3; ++axis) {
      if (chunk.box.lo[axis] < -Lattice::limit || chunk.box.hi[axis] > Lattice::limit)
        fail(here, "leaves the lattice");
    }
  }
  for (const Lattice& lattice : skeleton.lattices) {
    const glm::dvec3& origin = lattice.origin;
    if (!(lattice.step > 0) || !std::isfinite(lattice.step + origin.x + origin.y + origin.z))
      fail(place, "has a lattice without a step");
  }
  for (const Affine& transform : skeleton.transforms) {
    for (int column = 0; column < 4; ++column) {
      const glm::dvec3& v = transform[column];
      if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z))
        fail(place, "has a transform that is not finite");
    }
  }
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

Skeleton decode_skeleton(std::span<const std::byte> bytes, uint64_t geometry_size, const std::string& place) {
  ByteReader reader(bytes, place);
  auto skeleton = read_record<Skeleton>(reader);
  skeleton.pieces = read_record<std::vector<LatticeBox>>(reader);
  reader.expect_end();
  if (skeleton.lattices.empty() || skeleton.transforms.empty() || skeleton.palette.empty()) {
    fail(place, "lacks its lattice, transform or palette");
  }
  check_scene_nodes(skeleton, place);
  check_chunks(skeleton, geometry_size, place);
  check_pieces(skeleton, place);
  check_drawables(skeleton, place);
  return skeleton;
}

}  // namespace triptych
